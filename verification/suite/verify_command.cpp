// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/verify_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "app/backend_choice.hpp"
#include "app/machine_info.hpp"
#include "app/signals.hpp"
#include "generated/build_info.hpp"
#include "solver/base/error.hpp"
#include "verification/suite/peers.hpp"
#include "verification/suite/report_folder.hpp"
#include "verification/suite/report_html.hpp"
#include "verification/suite/report_json.hpp"
#include "verification/suite/report_text.hpp"
#include "verification/suite/suite.hpp"

namespace scree::verify {
namespace {

/// The cases of these names, each once, in the order of the list.
std::vector<PlannedCase> chosen_cases(const VerifyOptions& options,
                                      const std::vector<CaseCode>& known, bool on_device) {
  std::vector<std::string> names, faults;
  for (const CaseCode& code : known) names.push_back(code.name);
  for (const std::string& wanted : options.cases) {
    if (std::find(names.begin(), names.end(), wanted) != names.end()) continue;
    const std::string near = did_you_mean(wanted, names);
    faults.push_back("there is no case \"" + wanted + "\"" +
                     (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  }
  if (!faults.empty())
    throw UserError(join(faults, "; ") + " (scree verify --list names all cases)");
  std::vector<PlannedCase> cases;
  for (const CaseCode& code : known) {
    const auto& wanted = options.cases;
    const bool chosen =
        wanted.empty() || std::find(wanted.begin(), wanted.end(), code.name) != wanted.end();
    if (chosen) cases.push_back(plan_case(code, options.full));
  }
  // Some builds have a choice of laws (SCREE_MATERIALS).
  std::erase_if(cases, [](const PlannedCase& planned) {
    const std::string law = missing_law(planned);
    if (!law.empty())
      fmt::print("{}: left out of this build, which lacks {}\n", planned.code->name, law);
    return !law.empty();
  });
  std::erase_if(cases, [&](const PlannedCase& planned) {
    const std::string reason = on_device ? processor_only(planned) : "";
    if (!reason.empty())
      fmt::print("{}: left out, for {} is computed by the processor\n", planned.code->name, reason);
    return !reason.empty();
  });
  if (cases.empty()) return cases;
  // A case may have runs in the full variant only.
  std::erase_if(cases, [](const PlannedCase& planned) { return planned.sweep.runs.empty(); });
  if (cases.empty()) throw UserError("these cases have runs in the full variant only; add --full");
  return cases;
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

ReportHead head_of(const VerifyOptions& options, const std::string& backend, int threads,
                   double seconds) {
  const MachineInfo machine = machine_info();
  return {build_info::version,
          build_info::commit,
          machine.compiler,
          machine.instruction_set,
          machine.cpu,
          options.full ? "full" : "ci",
          now(),
          threads,
          seconds,
          backend};
}

void print_progress(const CaseResult& result, int done, int all) {
  fmt::print("{:<28} {} in {:.1f} s ({} of {} runs done)\n", result.name,
             result.passed ? "passed" : "FAILED", result.seconds, done, all);
  std::fflush(stdout);
}

void print_summary(const std::vector<CaseResult>& results, double seconds,
                   const ReportFolder& folder) {
  fmt::print("\n{}\n", table_text(results));
  const std::string peers = peers_text(results);
  if (!peers.empty()) fmt::print("{}\n", peers);
  const auto failed = std::count_if(results.begin(), results.end(),
                                    [](const CaseResult& result) { return !result.passed; });
  double work = 0;
  for (const CaseResult& result : results) work += result.seconds;
  fmt::print("{} of {} cases passed in {:.0f} s ({:.0f} core seconds) -> {}\n",
             results.size() - static_cast<std::size_t>(failed), results.size(), seconds, work,
             (folder.path() / "report.html").string());
}

}  // namespace

int verify_command(const VerifyOptions& options) { return verify_cases(options, all_cases()); }

int verify_cases(const VerifyOptions& options, const std::vector<CaseCode>& known) {
  if (options.list) {
    fmt::print("{}", list_text(known));
    return 0;
  }
  const BackendChoice backend = choose_backend(options.backend);
  const bool on_device = backend.device != nullptr;
  if (options.backend != "cpu") fmt::print("backend: {}\n", backend_text(backend));
  const std::vector<PlannedCase> cases = chosen_cases(options, known, on_device);
  if (cases.empty()) return 0;
  const std::string standard = options.full ? "runs/verify-full" : "runs/verify";
  ReportFolder folder(options.output.empty() ? standard : options.output);
  const int threads = on_device && options.threads == 0 ? 1 : thread_count(options.threads);
  const StopSignals signals;
  const auto start = std::chrono::steady_clock::now();
  std::vector<CaseResult> results;
  try {
    results = run_cases(
        cases, threads, backend.device, [] { return StopSignals::received() != 0; },
        print_progress);
  } catch (const RunFault&) {
    if (StopSignals::received() == 0) throw;
    fmt::print(stderr, "scree: stopped by a signal; no report was written\n");
    return 128 + StopSignals::received();
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const ReportHead head = head_of(options, backend_text(backend), threads, seconds);
  folder.write(report_html(head, results), report_json(head, results), results);
  print_summary(results, seconds, folder);
  const bool passed = std::all_of(results.begin(), results.end(),
                                  [](const CaseResult& result) { return result.passed; });
  return passed ? 0 : 1;
}

}  // namespace scree::verify

// SPDX-License-Identifier: Apache-2.0
#include "app/info_command.hpp"

#include <fmt/format.h>

#include <CLI/Version.hpp>
#include <string>

#include "app/machine_info.hpp"
#include "generated/build_info.hpp"
#include "materials/registry.hpp"
#include "postproc/project/petsc_solver.hpp"
#include "solver/base/problems.hpp"
#include "solver/deck/library_versions.hpp"
#include "solver/device/gpus.hpp"
#include "solver/io/library_versions.hpp"

namespace scree {
namespace {

std::string options_text() {
  std::vector<std::string> options;
#ifdef SCREE_STRICT
  options.push_back("strict backend");
#endif
#ifdef SCREE_FP_TRAPS
  options.push_back("floating-point traps");
#endif
#ifdef SCREE_ASSERTIONS
  options.push_back("assertions");
#endif
  const std::string sanitizers = build_info::sanitize;
  if (!sanitizers.empty()) options.push_back("sanitizers " + sanitizers);
  return options.empty() ? "none" : join(options);
}

std::string cuda_text(const GpuList& found) {
  if (!found.compiled) return found.problem;
  if (found.gpus.empty()) return fmt::format("{}; no GPU: {}", found.build, found.problem);
  std::vector<std::string> gpus;
  for (const Gpu& gpu : found.gpus) {
    gpus.push_back(fmt::format("{} ({}.{}, {:.1f} GB, {} multiprocessors)", gpu.name, gpu.major,
                               gpu.minor, double(gpu.memory) * 1e-9, gpu.processors));
  }
  return fmt::format("{}; {}", found.build, join(gpus));
}

void line(const std::string& name, const std::string& value) {
  fmt::print("{:<12} {}\n", name, value);
}

std::string fmt_version() {
  return fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
}

}  // namespace

int info_command() {
  const std::string commit = build_info::commit;
  line("scree", commit.empty() ? std::string(build_info::version)
                               : fmt::format("{} (commit {})", build_info::version, commit));
  line("build", fmt::format("{}, {}, -march={} ({})", build_info::build_type, build_info::compiler,
                            build_info::march, instruction_set()));
  line("options", options_text());
  std::vector<std::string> models;
  for (const MaterialEntry& model : material_registry()) models.push_back(model.name);
  line("materials", join(models));
  const GpuList found = find_gpus();
  line("backends", found.compiled ? "cpu, cuda" : "cpu");
  line("cpu", fmt::format("{} threads", thread_count(0)));
  line("cuda", cuda_text(found));
  for (const auto& [name, version] : deck_library_versions()) line(name, version);
  line("CLI11", CLI11_VERSION);
  line("fmt", fmt_version());
  for (const auto& [name, version] : io_library_versions()) line(name, version);
  line("PETSc", petsc_version());
  return 0;
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#include "app/bench_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/backend_choice.hpp"
#include "app/bench_materials.hpp"
#include "app/bench_measure.hpp"
#include "app/bench_suite.hpp"
#include "app/memory_info.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

/// What the timed steps of the case took without its water, measured by turns with it.
struct DryTwin {
  bool there = false;
  bool fused = false;
  StepTime time;
};

struct BenchResult {
  BenchOptions options;  ///< a deck's own dimension, kernel and precision
  std::int64_t particles = 0;
  bool fused = false;
  int steps = 0;
  int threads = 1;
  StepTime time;
  DryTwin dry;
  PhaseTimes phases;  ///< of the timed steps
  MemoryReport memory;
  std::int64_t max_rss_bytes = 0;

  double updates_per_second() const { return double(particles) * steps / time.seconds; }
  /// Of processor time, which other programs of the machine disturb least.
  double dry_ratio() const { return time.cpu_seconds / dry.time.cpu_seconds; }
  double bytes_per_particle() const { return double(memory.total()) / double(particles); }
};

StepTime operator+(const StepTime& a, const StepTime& b) {
  return {a.seconds + b.seconds, a.cpu_seconds + b.cpu_seconds};
}

/// The steps by turns with those of the dry twin, so that a disturbance meets both.
void time_by_turns(BenchRun& run, BenchRun& dry, BenchResult& result) {
  constexpr int turns = 5;
  dry.warm_up(0, 0);
  result.dry.there = true;
  result.dry.fused = dry.simulation().fused();
  for (int turn = 0; turn < turns; ++turn) {
    const int steps = result.steps * (turn + 1) / turns - result.steps * turn / turns;
    result.time = result.time + run.time_steps(steps);
    result.dry.time = result.dry.time + dry.time_steps(steps);
  }
}

BenchResult measure(const BenchOptions& options) {
  constexpr double wanted_seconds = 3;
  constexpr int least_steps = 10;
  BenchRun run(options);
  BenchResult result;
  result.options = run.options();
  result.threads = run.threads();
  result.fused = run.simulation().fused();
  const int enough = run.warm_up(wanted_seconds, least_steps);
  result.steps = options.steps > 0 ? run.whole_strides(options.steps) : enough;
  const PhaseTimes before = run.simulation().phases();
  if (run.simulation().coupled() && options.deck.empty()) {
    BenchOptions dry = options;
    dry.dry = true;
    dry.path = "automatic";
    BenchRun twin(dry);
    time_by_turns(run, twin, result);
  } else {
    result.time = run.time_steps(result.steps);
  }
  result.phases = run.simulation().phases();
  for (std::size_t i = 0; i < before.size(); ++i) result.phases[i].second -= before[i].second;
  result.particles = run.simulation().particle_count();
  result.memory = run.simulation().memory();
  result.max_rss_bytes = peak_memory();
  return result;
}

const char* path_name(bool fused) { return fused ? "fused" : "split"; }

void print_json(const BenchOptions& options, const BenchResult& r) {
  nlohmann::ordered_json phases;
  for (const auto& [name, seconds] : r.phases) phases[name] = seconds / r.steps;
  nlohmann::ordered_json out{{"case", options.case_name},
                             {"dimension", options.dimension},
                             {"particles", r.particles},
                             {"steps", r.steps},
                             {"precision", options.precision},
                             {"kernel", options.kernel},
                             {"path", path_name(r.fused)},
                             {"backend", options.backend},
                             {"threads", r.threads},
                             {"particle_updates_per_second", r.updates_per_second()},
                             {"seconds_per_step", r.time.seconds / r.steps},
                             {"busy", r.time.busy(r.threads)},
                             {"bytes_per_particle", r.bytes_per_particle()},
                             {"phases", phases},
                             {"max_rss_bytes", r.max_rss_bytes}};
  if (r.dry.there) {
    out["dry"] = {{"path", path_name(r.dry.fused)},
                  {"seconds_per_step", r.dry.time.seconds / r.steps},
                  {"ratio", r.dry_ratio()}};
  }
  fmt::print("{}\n", out.dump(2));
}

void print_text(const BenchOptions& options, const BenchResult& r) {
  const double per_particle = 1e9 * r.time.seconds / (double(r.particles) * r.steps);
  fmt::print("{} {}D, {} {}, {} path, {}, {} thread{}: {} particles, {} steps\n", options.case_name,
             options.dimension, options.kernel, options.precision, path_name(r.fused),
             options.backend, r.threads, r.threads == 1 ? "" : "s", r.particles, r.steps);
  fmt::print("  particle updates   {:9.2f} million/s ({:.2f} a thread)\n",
             r.updates_per_second() / 1e6, r.updates_per_second() / 1e6 / r.threads);
  fmt::print("  step               {:9.3f} ms, {:.0f} % of the threads' time at work\n",
             1e3 * r.time.seconds / r.steps, 100 * r.time.busy(r.threads));
  fmt::print("  per particle       {:9.2f} ns\n", per_particle);
  if (r.dry.there) {
    fmt::print("  without its water  {:9.2f} ns, {} path; ratio of the processor times {:.2f}\n",
               1e9 * r.dry.time.seconds / (double(r.particles) * r.steps), path_name(r.dry.fused),
               r.dry_ratio());
  }
  for (const auto& [name, seconds] : r.phases) {
    fmt::print("    {:<16} {:9.2f} ns\n", name, 1e9 * seconds / (double(r.particles) * r.steps));
  }
  fmt::print(
      "  memory             {:9.1f} bytes a particle (particles {:.1f}, grid {:.1f}, other "
      "{:.1f})\n",
      r.bytes_per_particle(), double(r.memory.particles) / double(r.particles),
      double(r.memory.grid) / double(r.particles), double(r.memory.other) / double(r.particles));
  fmt::print("  peak resident      {:9.1f} MB\n", double(r.max_rss_bytes) / 1e6);
}

}  // namespace

int bench_command(const BenchOptions& options) {
  BenchOptions chosen = options;
  chosen.backend = choose_backend(options.backend).name;
  if (options.material_only) {
    if (chosen.backend != "cpu") {
      throw UserError("--material-only measures laws on the processor; use --backend cpu");
    }
    print_material_costs(options.json);
    return 0;
  }
  if (options.suite) {
    run_bench_suite(chosen);
    return 0;
  }
  const BenchResult result = measure(chosen);
  if (options.json) {
    print_json(result.options, result);
  } else {
    print_text(result.options, result);
  }
  return 0;
}

}  // namespace scree

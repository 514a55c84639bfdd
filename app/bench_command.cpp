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

struct BenchResult {
  std::int64_t particles = 0;
  int steps = 0;
  int threads = 1;
  StepTime time;
  PhaseTimes phases;  ///< of the timed steps
  MemoryReport memory;
  std::int64_t max_rss_bytes = 0;

  double updates_per_second() const { return double(particles) * steps / time.seconds; }
  double bytes_per_particle() const { return double(memory.total()) / double(particles); }
};

BenchResult measure(const BenchOptions& options) {
  constexpr double wanted_seconds = 3;
  constexpr int least_steps = 10;
  BenchRun run(options);
  BenchResult result;
  result.threads = run.threads();
  const int enough = run.warm_up(wanted_seconds, least_steps);
  result.steps = options.steps > 0 ? options.steps : enough;
  const PhaseTimes before = run.simulation().phases();
  result.time = run.time_steps(result.steps);
  result.phases = run.simulation().phases();
  for (std::size_t i = 0; i < before.size(); ++i) result.phases[i].second -= before[i].second;
  result.particles = run.simulation().particle_count();
  result.memory = run.simulation().memory();
  result.max_rss_bytes = peak_memory();
  return result;
}

void print_json(const BenchOptions& options, const BenchResult& r) {
  nlohmann::ordered_json phases;
  for (const auto& [name, seconds] : r.phases) phases[name] = seconds / r.steps;
  const nlohmann::ordered_json out{{"case", options.case_name},
                                   {"dimension", options.dimension},
                                   {"particles", r.particles},
                                   {"steps", r.steps},
                                   {"precision", options.precision},
                                   {"kernel", options.kernel},
                                   {"path", options.path},
                                   {"backend", options.backend},
                                   {"threads", r.threads},
                                   {"particle_updates_per_second", r.updates_per_second()},
                                   {"seconds_per_step", r.time.seconds / r.steps},
                                   {"busy", r.time.busy(r.threads)},
                                   {"bytes_per_particle", r.bytes_per_particle()},
                                   {"phases", phases},
                                   {"max_rss_bytes", r.max_rss_bytes}};
  fmt::print("{}\n", out.dump(2));
}

void print_text(const BenchOptions& options, const BenchResult& r) {
  const double per_particle = 1e9 * r.time.seconds / (double(r.particles) * r.steps);
  fmt::print("{} {}D, {} {}, {} path, {}, {} thread{}: {} particles, {} steps\n", options.case_name,
             options.dimension, options.kernel, options.precision, options.path, options.backend,
             r.threads, r.threads == 1 ? "" : "s", r.particles, r.steps);
  fmt::print("  particle updates   {:9.2f} million/s ({:.2f} a thread)\n",
             r.updates_per_second() / 1e6, r.updates_per_second() / 1e6 / r.threads);
  fmt::print("  step               {:9.3f} ms, {:.0f} % of the threads' time at work\n",
             1e3 * r.time.seconds / r.steps, 100 * r.time.busy(r.threads));
  fmt::print("  per particle       {:9.2f} ns\n", per_particle);
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
    print_json(chosen, result);
  } else {
    print_text(chosen, result);
  }
  return 0;
}

}  // namespace scree

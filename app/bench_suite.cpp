// SPDX-License-Identifier: Apache-2.0
#include "app/bench_suite.hpp"

#include <algorithm>
#include <cstdio>

#include "app/bench_suite_json.hpp"
#include "app/bench_suite_text.hpp"
#include "app/memory_info.hpp"

namespace scree {
namespace {

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);  // the suite takes minutes: what is measured is to be seen
}

void make_quick(SuitePlan& plan) {
  constexpr std::int64_t table_particles = 512;
  plan.quick = true;
  plan.table.particles = std::min(plan.table.particles, table_particles);
  plan.sweep.particles = {64, 512};
  plan.sweep.flat_from = 64;
  plan.array_bytes = 1 << 16;
  plan.bandwidth_repeats = 3;
  plan.table.repeats = plan.sweep.repeats = {3, 2, 0.0};
}

}  // namespace

SuitePlan suite_plan(const BenchOptions& options, const MachineInfo& machine) {
  SuitePlan plan;
  const int all = options.threads > 0 ? options.threads : machine.threads;
  // A GPU's rate does not hang on the threads of the processor, nor on its memory.
  const bool one_row = all == 1 || options.backend != "cpu";
  plan.table.threads = one_row ? std::vector<int>{all} : std::vector<int>{1, all};
  plan.table.backend = plan.sweep.backend = options.backend;
  plan.table.particles = options.particles;
  plan.sweep.threads = plan.table.threads;
  plan.sweep.particles = {10'000, 100'000, 1'000'000, 10'000'000};
  constexpr std::int64_t unknown = std::int64_t(4) << 30;
  plan.array_bytes = bandwidth_array_bytes(machine.cache_bytes, free_memory().value_or(unknown));
  if (options.quick) make_quick(plan);
  return plan;
}

std::optional<double> bandwidth_share(const StepCost& cost,
                                      const std::vector<Bandwidth>& bandwidth) {
  for (const Bandwidth& memory : bandwidth) {
    if (memory.threads != cost.threads) continue;
    const double used = cost.traffic_per_particle() * 1e9 / cost.ns_per_particle.best;
    return used / memory.update.best;
  }
  return {};
}

void run_bench_suite(const BenchOptions& options) {
  const auto say = [&](const std::string& text) {
    if (!options.json) print(text);
  };
  SuiteResult result;
  result.machine = machine_info();
  const SuitePlan plan = suite_plan(options, result.machine);
  say(machine_text(result.machine));
  if (plan.quick) say("quick: sizes so small that the figures mean nothing\n");
  if (options.backend == "cpu") say(bandwidth_head(plan));
  for (const int threads : plan.table.threads) {
    if (options.backend != "cpu") break;
    result.bandwidth.push_back(
        measure_bandwidth(threads, plan.array_bytes, plan.bandwidth_repeats));
    say(bandwidth_text(result.bandwidth.back()));
  }
  say(table_head(plan.table));
  result.table = measure_table(plan.table, [&](const TableRow& row) {
    say(table_text(row, bandwidth_share(row.compact, result.bandwidth)));
  });
  say(sweep_head(plan.sweep));
  result.sweep =
      measure_sweep(plan.sweep, [&](const SweepPoint& point) { say(sweep_text(point)); });
  for (const LeftOut& left : result.sweep.left_out) say(left_out_text(left));
  say(verdict_text(plan.sweep, result.sweep));
  if (options.json) print(suite_json(plan, result));
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#include "app/bench_measure.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/backend_choice.hpp"
#include "app/bench_case.hpp"
#include "app/bench_deck.hpp"
#include "app/machine_info.hpp"
#include "solver/simulation/simulation_on_device.hpp"

namespace scree {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Time that the process's threads have computed so far.
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

BenchRun::BenchRun(const BenchOptions& options) : options_(options) {
  const auto start = Clock::now();
  SimulationSetup setup =
      options.deck.empty() ? build_bench_case(options) : build_bench_deck(options_);
  threads_ = setup.threads = thread_count(options.threads);
  const int stride = setup.coupling ? setup.coupling->stride : 1;
  simulation_ = create_on_device(std::move(setup), choose_backend(options.backend).device);
  if (simulation_->fused()) stride_ = stride;
  set_up_seconds_ = seconds_since(start);
}

StepTime BenchRun::time_steps(int steps) {
  const double cpu_before = cpu_seconds();
  const auto start = Clock::now();
  for (int i = 0; i < steps; ++i) simulation_->step();
  const double seconds = seconds_since(start);
  return {seconds, cpu_seconds() - cpu_before};
}

int BenchRun::warm_up(double seconds, int least) {
  constexpr int steps = 3;
  const double spent = time_steps(steps).seconds;
  const int wanted =
      std::clamp(int(std::min(seconds / spent * steps, 1e6)), least, std::max(least, 2000));
  return whole_strides(wanted);
}

BestMedian best_and_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values[0], 0.5 * (values[(n - 1) / 2] + values[n / 2])};
}

std::vector<StepCost> measure_by_turns(const std::vector<BenchRun*>& runs, const RepeatPlan& plan) {
  std::vector<StepCost> costs(runs.size());
  std::vector<std::vector<double>> ns(runs.size());
  std::vector<StepTime> total(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    costs[i].steps = runs[i]->warm_up(plan.seconds, plan.least_steps);
  }
  for (int repeat = 0; repeat < plan.repeats; ++repeat) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const double updates =
          double(runs[i]->simulation().particle_count()) * double(costs[i].steps);
      const StepTime time = runs[i]->time_steps(costs[i].steps);
      ns[i].push_back(1e9 * time.seconds / updates);
      total[i].seconds += time.seconds;
      total[i].cpu_seconds += time.cpu_seconds;
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Simulation& simulation = runs[i]->simulation();
    costs[i].particles = simulation.particle_count();
    costs[i].threads = runs[i]->threads();
    costs[i].ns_per_particle = best_and_median(ns[i]);
    costs[i].busy = total[i].busy(costs[i].threads);
    costs[i].bytes_per_particle = double(simulation.memory().total()) / double(costs[i].particles);
    costs[i].traffic = simulation.traffic();
  }
  return costs;
}

}  // namespace scree

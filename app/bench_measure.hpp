// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "app/bench_options.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// Time that some steps took.
struct StepTime {
  double seconds = 0;      ///< of the clock
  double cpu_seconds = 0;  ///< that the process computed, all threads together

  /// Share of its threads' time that the process really had: below 1 where it waited, for other
  /// programs on the machine or for its own slowest thread.
  double busy(int threads) const { return cpu_seconds / (seconds * threads); }
};

/// A case of a benchmark in memory, ready to step.
class BenchRun {
 public:
  /// Builds the case; throws UserError for options that make none.
  explicit BenchRun(const BenchOptions& options);

  const BenchOptions& options() const { return options_; }
  const Simulation& simulation() const { return *simulation_; }
  int threads() const { return threads_; }
  double set_up_seconds() const { return set_up_seconds_; }  ///< particles, blocks, first stress

  /// What so many steps take.
  StepTime time_steps(int steps);
  /// Steps untimed at first; returns how many steps take about `seconds`, at least `least`, in
  /// whole strides.
  int warm_up(double seconds, int least);
  /// So many steps or more that strides of pore water are measured whole: their steps share work
  /// of the first one.
  int whole_strides(int steps) const { return (steps + stride_ - 1) / stride_ * stride_; }

 private:
  BenchOptions options_;
  int threads_ = 1;
  int stride_ = 1;  ///< steps
  double set_up_seconds_ = 0;
  std::unique_ptr<Simulation> simulation_;
};

/// How often and how long to measure.
struct RepeatPlan {
  int repeats = 5;
  int least_steps = 20;  ///< of a repeat: enough that binning is in it
  double seconds = 0.3;  ///< of a repeat
};

/// The least and the median of repeated measurements; the distance shows the noise.
struct BestMedian {
  double best = 0;
  double median = 0;
};

/// values: at least one; the best is the least.
BestMedian best_and_median(std::vector<double> values);

/// What the steps of a case cost.
struct StepCost {
  std::int64_t particles = 0;
  int threads = 1;
  int steps = 0;                  ///< of one repeat
  BestMedian ns_per_particle;     ///< wall time of a step over particles
  double busy = 0;                ///< StepTime::busy of all repeats; shows a disturbed measurement
  double bytes_per_particle = 0;  ///< of memory, as the program counts it
  StepTraffic traffic;            ///< of the last step

  /// Particle updates per second of one thread.
  BestMedian rate_per_thread() const {
    return {1e9 / ns_per_particle.best / threads, 1e9 / ns_per_particle.median / threads};
  }
  double traffic_per_particle() const { return double(traffic.total()) / double(particles); }
};

/// Measures several runs by turns, repeat after repeat, so that a disturbance of the machine meets
/// all of them and the ratios between them stay fair.
std::vector<StepCost> measure_by_turns(const std::vector<BenchRun*>& runs, const RepeatPlan& plan);

}  // namespace scree

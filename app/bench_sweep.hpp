// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/bench_measure.hpp"

namespace scree {

/// The elastic case with the compact kernel at one size.
struct SweepPoint {
  std::string precision;
  StepCost cost;
  double set_up_seconds = 0;
  /// Growth of the resident memory's peak over set-up and steps [bytes]; nothing where the system
  /// does not let the peak begin anew.
  std::optional<std::int64_t> peak_growth;
};

/// A size that was not measured for want of memory.
struct LeftOut {
  std::string precision;
  int threads = 1;
  std::int64_t particles = 0;
  std::int64_t needed_bytes = 0;
  std::int64_t free_bytes = 0;
};

struct SweepPlan {
  std::vector<std::int64_t> particles;  ///< increasing
  std::int64_t flat_from = 100'000;     ///< sizes from here on must cost the same a particle
  double allowed_spread = 0.15;         ///< of them, (largest - least)/least
  std::vector<int> threads;             ///< increasing
  std::string backend = "cpu";
  RepeatPlan repeats;
};

/// How far the cost of a particle varies over the sizes of one series.
struct SweepSpread {
  std::string precision;
  int threads = 1;
  double spread = 0;
};

struct Sweep {
  std::vector<SweepPoint> points;
  std::vector<LeftOut> left_out;
};

using SweepReport = std::function<void(const SweepPoint&)>;

/// Sizes x single, double x threads; `report` is told each point as it is done.
Sweep measure_sweep(const SweepPlan& plan, const SweepReport& report);

/// One entry for each precision and number of threads with two or more sizes from plan.flat_from
/// on. The size asked for counts, a lattice of particles may have a few less.
std::vector<SweepSpread> sweep_spreads(const SweepPlan& plan,
                                       const std::vector<SweepPoint>& points);

/// The series that varies most; null for no series.
const SweepSpread* worst_spread(const std::vector<SweepSpread>& spreads);

/// Memory that a size takes while it is set up [bytes], with a margin.
std::int64_t sweep_memory(std::int64_t particles, const std::string& precision);

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/bench_measure.hpp"

namespace scree {

/// Both kernels on one case, measured by turns.
struct TableRow {
  std::string case_name;
  int dimension = 3;
  std::string precision;
  int threads = 1;
  StepCost compact;
  StepCost quadratic;

  /// Rate of the compact kernel over that of the quadratic one, from the best repeats.
  double compact_to_quadratic() const {
    return quadratic.ns_per_particle.best / compact.ns_per_particle.best;
  }
};

struct TablePlan {
  std::int64_t particles = 1'000'000;
  std::vector<int> threads;  ///< increasing
  std::string backend = "cpu";
  RepeatPlan repeats;
};

/// elastic, sand, fluid x 3D, 2D x single, double x threads; `report` is told each row as it is
/// done.
std::vector<TableRow> measure_table(const TablePlan& plan,
                                    const std::function<void(const TableRow&)>& report);

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/bench_bandwidth.hpp"
#include "app/bench_options.hpp"
#include "app/bench_sweep.hpp"
#include "app/bench_table.hpp"
#include "app/machine_info.hpp"

namespace scree {

/// All that `scree bench --suite` measures.
struct SuitePlan {
  TablePlan table;
  SweepPlan sweep;
  std::int64_t array_bytes = 0;  ///< of the bandwidth
  int bandwidth_repeats = 10;
  bool quick = false;  ///< sizes that only show that the suite works
};

struct SuiteResult {
  MachineInfo machine;
  std::vector<Bandwidth> bandwidth;  ///< one for each number of threads
  std::vector<TableRow> table;
  Sweep sweep;
};

/// The whole suite, or with options.quick one of tiny sizes whose figures mean nothing.
SuitePlan suite_plan(const BenchOptions& options, const MachineInfo& machine);

/// Share of the memory's in-place update rate that a case's steps use, counting what the program
/// loads and stores; nothing where the bandwidth of that many threads was not measured.
std::optional<double> bandwidth_share(const StepCost& cost,
                                      const std::vector<Bandwidth>& bandwidth);

/// Measures and prints; as text, each figure when it is there, or as one JSON object.
void run_bench_suite(const BenchOptions& options);

}  // namespace scree

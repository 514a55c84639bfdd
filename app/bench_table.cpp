// SPDX-License-Identifier: Apache-2.0
#include "app/bench_table.hpp"

namespace scree {
namespace {

/// The rows of one case and precision, one for each number of threads.
std::vector<TableRow> measure_case(const TablePlan& plan, const std::string& case_name,
                                   int dimension, const std::string& precision) {
  std::vector<std::unique_ptr<BenchRun>> owned;
  std::vector<BenchRun*> runs;
  for (const int threads : plan.threads) {
    for (const char* kernel : {"compact", "quadratic"}) {
      BenchOptions options;
      options.case_name = case_name;
      options.dimension = dimension;
      options.particles = plan.particles;
      options.precision = precision;
      options.kernel = kernel;
      options.threads = threads;
      options.backend = plan.backend;
      owned.push_back(std::make_unique<BenchRun>(options));
      runs.push_back(owned.back().get());
    }
  }
  const std::vector<StepCost> costs = measure_by_turns(runs, plan.repeats);
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < plan.threads.size(); ++i) {
    rows.push_back(
        {case_name, dimension, precision, plan.threads[i], costs[2 * i], costs[2 * i + 1]});
  }
  return rows;
}

}  // namespace

std::vector<TableRow> measure_table(const TablePlan& plan,
                                    const std::function<void(const TableRow&)>& report) {
  std::vector<TableRow> table;
  for (const int dimension : {3, 2}) {
    for (const char* case_name : {"elastic", "sand", "fluid"}) {
      for (const char* precision : {"single", "double"}) {
        for (TableRow& row : measure_case(plan, case_name, dimension, precision)) {
          report(row);
          table.push_back(std::move(row));
        }
      }
    }
  }
  return table;
}

}  // namespace scree

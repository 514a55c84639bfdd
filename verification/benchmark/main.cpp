// SPDX-License-Identifier: Apache-2.0
#include "solver/exec/flush_subnormals.hpp"
#include "verification/benchmark/benchmarks.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  scree::benchmarks::add_transfers();
  scree::benchmarks::add_staging();
  scree::benchmarks::add_elastic_blocks();
  scree::benchmarks::add_sand_blocks();
  scree::benchmarks::add_materials();
  scree::benchmarks::add_algebra();
  const scree::FlushSubnormals as_in_the_solver;
  const bool some = benchmark::RunSpecifiedBenchmarks() > 0;
  benchmark::Shutdown();
  return some ? 0 : 1;
}

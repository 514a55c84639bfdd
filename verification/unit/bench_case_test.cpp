// SPDX-License-Identifier: Apache-2.0
#include "app/bench_case.hpp"

#include <gtest/gtest.h>

namespace scree::testing {
namespace {

TEST(BenchCase, coupled_has_water_and_its_dry_twin_has_none) {
  for (const int dimension : {2, 3}) {
    BenchOptions options;
    options.case_name = "coupled";
    options.dimension = dimension;
    options.particles = 1000;
    const auto wet = Simulation::create(build_bench_case(options));
    options.dry = true;
    const auto dry = Simulation::create(build_bench_case(options));
    EXPECT_TRUE(wet->coupled());
    EXPECT_FALSE(dry->coupled());
    EXPECT_EQ(wet->particle_count(), dry->particle_count());
    for (int i = 0; i < 3; ++i) wet->step();
    double solve = 0;
    for (const auto& [name, seconds] : wet->phases()) solve += name == "pore_solve" ? seconds : 0;
    EXPECT_GT(solve, 0);
  }
}

}  // namespace
}  // namespace scree::testing

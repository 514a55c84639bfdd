// SPDX-License-Identifier: Apache-2.0
//
// Single precision follows double, and the fused step follows the split one, over a whole
// collision.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/support/effort.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

struct Outcome {
  State state;
  HistoryRow row;
};

/// Two jellies collide and part; 300 steps.
Outcome collide(int dimension, const Method& method) {
  const double dx = 0.1;
  SimulationSetup setup = make_setup(dimension, method, dx, {24, 12, 10});
  for (int b = 0; b < 2; ++b) {
    const Vector lower(0.4 + 0.8 * b, 0.3 + 0.1 * b, 0.3);
    const auto points = lattice(lower, lower + Vector(0.5, 0.4, 0.3), dx / 3, dimension);
    set_velocity(add_jelly(setup, points, dx / 3, {1e5, 0.3, 1000}), Vector(b == 0 ? 2 : -2, 0, 0));
  }
  set_steps(setup, slow_build && dimension == 3 ? 60 : 300, 1e-3);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  return {state_of(*simulation), simulation->history()};
}

class PrecisionTest : public ::testing::TestWithParam<int> {};  // the dimension

TEST_P(PrecisionTest, single_follows_double) {
  for (PathType path : {PathType::fused, PathType::split}) {
    Method method;
    method.path = path;
    const Outcome in_double = collide(GetParam(), method);
    method.precision = Precision::single_;
    const Outcome in_single = collide(GetParam(), method);
    // 300 steps of rounding 6e-8 in positions of up to 4 cells of 0.1 m, amplified by the contact.
    EXPECT_LT(distance(in_double.state.x, in_single.state.x), 2e-4);
    EXPECT_NEAR(in_single.row.kinetic_energy / in_double.row.kinetic_energy, 1, 1e-4);
    EXPECT_NEAR(in_single.row.center[0], in_double.row.center[0], 1e-5);
    EXPECT_GT(distance(in_double.state.x, in_single.state.x), 1e-9) << "both ran in one precision";
  }
}

TEST_P(PrecisionTest, fused_equals_split_to_rounding) {
  for (KernelType kernel : {KernelType::compact, KernelType::quadratic}) {
    Method method;
    method.kernel = kernel;
    method.path = PathType::fused;
    const Outcome fused = collide(GetParam(), method);
    method.path = PathType::split;
    const Outcome split = collide(GetParam(), method);
    EXPECT_LT(distance(fused.state.x, split.state.x), 1e-11);
    EXPECT_LT(distance(fused.state.F, split.state.F), 1e-9);
    EXPECT_NEAR(fused.row.kinetic_energy / split.row.kinetic_energy, 1, 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(dimensions, PrecisionTest, ::testing::Values(2, 3));

}  // namespace
}  // namespace scree::testing

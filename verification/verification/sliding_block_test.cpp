// SPDX-License-Identifier: Apache-2.0
//
// A block on a frictional floor under inclined gravity (case V26 a): the mean of x follows
// a = g (sin theta - mu cos theta) to 1e-3; below the friction angle it stays.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/reference/closed_forms.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double theta = std::numbers::pi / 6;

/// Mean displacement along the floor after 1 s.
double slide(const Method& method, double friction) {
  const double dx = 0.025;
  SimulationSetup setup = make_setup(2, method, dx, {64, 12, 1});
  setup.gravity = [](double) {
    return std::array<double, 3>{9.81 * std::sin(theta), -9.81 * std::cos(theta), 0};
  };
  setup.faces[1][0] = FaceType::friction;
  setup.face_friction[1][0] = friction;
  const auto points = lattice(Vector(0.1, 0, 0), Vector(0.3, 0.1, 0), dx / 3, 2);
  add_jelly(setup, points, dx / 3, {1e6, 0.3, 1000});
  setup.schedule = Schedule(1.0, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const double start = simulation->history().center[0];
  run(*simulation, schedule);
  return simulation->history().center[0] - start;
}

TEST(sliding_block, slides_as_a_point_mass) {
  const double exact = reference::SlidingBlock(theta, 0.3).displacement(1.0);
  for (KernelType kernel : {KernelType::compact, KernelType::quadratic}) {
    Method method;
    method.kernel = kernel;
    EXPECT_NEAR(slide(method, 0.3) / exact, 1, 1e-3);
  }
}

TEST(sliding_block, stays_below_the_friction_angle) {
  EXPECT_LT(std::abs(slide({}, 0.6)), 1e-3 * 0.025);  // tan 30 deg = 0.577; creep in cells
}

}  // namespace
}  // namespace scree::testing

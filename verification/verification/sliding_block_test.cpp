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

/// Mean displacement along the floor at the times 0.5 and 1 s. The block is stiff (it hops less);
/// `settle` lets gravity grow in 0.2 s and damps.
struct Slide {
  double half, whole;
};
Slide slide(KernelType kernel, double friction, bool settle) {
  const double dx = 0.025;
  Method method;
  method.kernel = kernel;
  SimulationSetup setup = make_setup(2, method, dx, {64, 12, 1});
  setup.gravity = [settle](double t) {
    const double g = 9.81 * (settle ? std::min(t / 0.2, 1.0) : 1.0);
    return std::array<double, 3>{g * std::sin(theta), -g * std::cos(theta), 0};
  };
  if (settle) setup.damping = DampingType::mass, setup.damping_value = 100;
  setup.faces[1][0] = FaceType::friction;
  setup.face_friction[1][0] = friction;
  const auto points = lattice(Vector(0.1, 0, 0), Vector(0.3, 0.1, 0), dx / 3, 2);
  add_jelly(setup, points, dx / 3, {1e7, 0.3, 1000});
  setup.schedule = Schedule(1.0, 0.5, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const auto rows = run_with_history(*simulation, schedule);
  return {rows.at(1).center[0] - rows[0].center[0], rows.at(2).center[0] - rows[0].center[0]};
}

TEST(SlidingBlock, slides_as_a_point_mass) {
  const double exact = reference::SlidingBlock(theta, 0.3).displacement(1.0);
  for (KernelType kernel : {KernelType::compact, KernelType::quadratic})
    EXPECT_NEAR(slide(kernel, 0.3, false).whole / exact, 1, 1e-3);
}

TEST(SlidingBlock, stays_below_the_friction_angle) {
  const Slide held = slide(KernelType::compact, 0.6, true);  // tan 30 deg = 0.577
  EXPECT_LT(std::abs(held.whole - held.half), 1e-3 * 0.025) << "creep";
  EXPECT_LT(held.whole, 1e-2 * 0.025) << "elastic shear: rho g sin(theta) h^2/(2 G) = 6e-6 m";
}

}  // namespace
}  // namespace scree::testing

// SPDX-License-Identifier: Apache-2.0
//
// The closed forms against numbers of an independent implementation and against the equations that
// they solve.
#include "verification/reference/closed_forms.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scree::reference {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(ClosedForms, symplectic_fall_is_the_sum_of_its_steps) {
  double x = 0, v = 0.3;
  for (int n = 0; n < 17; ++n) {
    v += 0.02 * -9.81;
    x += 0.02 * v;
  }
  const Fall fall = symplectic_euler_fall(17, 0.02, -9.81, 0.3);
  EXPECT_NEAR(fall.position, x, 1e-14);
  EXPECT_NEAR(fall.velocity, v, 1e-14);
}

TEST(ClosedForms, sliding_block) {
  EXPECT_NEAR(SlidingBlock(30 * degree, 0.3).acceleration, 2.356287, 1e-6);
  EXPECT_NEAR(SlidingBlock(30 * degree, 0.3).displacement(1), 1.178144, 1e-6);
  EXPECT_EQ(SlidingBlock(30 * degree, 0.6).displacement(1), 0);
  EXPECT_LT(SlidingBlock(30 * degree, 0.6, 9.81, 1).acceleration, 0);
}

TEST(ClosedForms, infinite_slope) {
  EXPECT_NEAR(infinite_slope_safety(5e3, 30 * degree, 18e3, 3, 25 * degree), 1.47987, 1e-5);
  // The outer cone of 30 degrees holds up to 34.72 degrees in plane strain.
  const double M = cone_slope_compression(30 * degree);
  EXPECT_NEAR(infinite_slope_acceleration(std::atan(0.692820), M), 0, 1e-5);
}

TEST(ClosedForms, cones) {
  EXPECT_NEAR(cone_slope_compression(30 * degree), 1.2, 1e-15);
  EXPECT_NEAR(cone_slope_extension(30 * degree), 0.8571, 5e-5);
  EXPECT_NEAR(cone_slope_plane_strain(30 * degree), 0.8660, 5e-5);
  EXPECT_NEAR(cone_alpha(cone_slope_compression(20 * degree)), 0.210128, 1e-6);
  const OedometerStress stress = sand_oedometer(0.9, 1e7, 0.2, 30 * degree);
  EXPECT_NEAR(stress.axial, 1170672.3961980697, 1e-6);
  EXPECT_NEAR(stress.lateral, 390224.13206602336, 1e-6);
}

TEST(ClosedForms, run_out_and_hydrostatic_pressure) {
  EXPECT_NEAR(column_runout(0.5), 0.6, 1e-15);
  EXPECT_NEAR(column_runout(3), 3.95, 5e-3);
  EXPECT_NEAR(column_runout(7), 6.95, 5e-3);
  EXPECT_NEAR(hydrostatic_pressure(0.5, 1000, 9.81, 5e4, 7), 4938.597, 1e-3);
  EXPECT_NEAR(hydrostatic_pressure(1.0, 1000, 9.81, 5e4, 7), 9941.510, 1e-3);
}

}  // namespace
}  // namespace scree::reference

// SPDX-License-Identifier: Apache-2.0
//
// The closed forms of cases of scree verify against numbers of an independent implementation and
// against the equations that they solve.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "verification/cases/angular_momentum/exact.hpp"
#include "verification/cases/manufactured_solution/exact.hpp"
#include "verification/cases/rigid_motion/exact.hpp"
#include "verification/cases/self_weight_column/exact.hpp"
#include "verification/cases/thick_cylinder/exact.hpp"

namespace scree::verify::cases {
namespace {

TEST(CaseForms, rod_of_the_paper) {
  EXPECT_NEAR(angular_momentum::shearing_rod(1000, 12.8, 5.0 / 256, 40.0 / 256), -4.876394e-3,
              1e-9);
}

TEST(CaseForms, symplectic_fall_is_the_sum_of_its_steps) {
  double x = 0, v = 0;
  for (int n = 0; n < 17; ++n) {
    v += 0.02 * -9.81;
    x += 0.02 * v;
  }
  EXPECT_NEAR(rigid_motion::symplectic_euler_fall(17, 0.02, -9.81), x, 1e-14);
}

TEST(CaseForms, column_of_every_law) {
  const double top[] = {-0.500000, -0.455777, -0.483358};
  const double base[] = {0.900000, 0.912765, 0.904988};
  const char* const models[] = {"fixed_corotated", "hencky", "neo_hookean"};
  for (int i = 0; i < 3; ++i) {
    const self_weight_column::Column column{models[i], 10, 1000, 10, 1e6};
    EXPECT_NEAR(column.displacement(10), top[i], 1e-6) << models[i];
    EXPECT_NEAR(column.stretch(0), base[i], 1e-6) << models[i];
    const double h = 1e-4;
    for (const double X : {1.0, 4.0, 9.0}) {
      EXPECT_NEAR((column.displacement(X + h) - column.displacement(X - h)) / (2 * h),
                  column.stretch(X) - 1, 1e-8);
      EXPECT_NEAR((column.stress(X + h) - column.stress(X - h)) / (2 * h), 1000 * 10.0, 1e-6);
    }
  }
}

TEST(CaseForms, cylinder_is_in_balance_and_compatible) {
  const thick_cylinder::Cylinder cylinder{1e5, 1e8, 0.3};
  EXPECT_NEAR(cylinder.radial(1), -1e5, 1e-6);
  EXPECT_NEAR(cylinder.radial(2), 0, 1e-6);
  EXPECT_NEAR(cylinder.radial(1.5), -25925.9, 0.1);
  EXPECT_NEAR(cylinder.hoop(1.5), 92592.6, 0.1);
  const double r = 1.3, h = 1e-4;
  const double slope = (cylinder.radial(r + h) - cylinder.radial(r - h)) / (2 * h);
  EXPECT_NEAR(slope, (cylinder.hoop(r) - cylinder.radial(r)) / r, 1e-2);
  // Hoop strain u/r of plane strain.
  const double strain = (1 + 0.3) / 1e8 * ((1 - 0.3) * cylinder.hoop(r) - 0.3 * cylinder.radial(r));
  EXPECT_NEAR(cylinder.displacement(r) / r, strain, 1e-12);
}

/// Momentum of the manufactured motion, in the square and in the cube: rho u_tt = dP/dX + rho b
/// with the body force of case.toml.
TEST(CaseForms, manufactured_body_force_balances_momentum) {
  const double E = 1e7, nu = 0.3, rho = 1e3, A = 0.05, pi = std::numbers::pi;
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const manufactured_solution::Motion motion{A, pi * std::sqrt(E / rho)};
  const double X[3] = {0.3, 0.2, 0.8}, t = 0.0013, e = 1e-5;
  const auto u = [&](int a, double x, double time) { return motion.displacement(a, x, time); };
  const auto stretch = [&](int a, double x) {
    return 1 + (u(a, x + e, t) - u(a, x - e, t)) / (2 * e);
  };
  constexpr std::pair<int, int> dimensions_and_axes[] = {{2, 0}, {2, 1}, {3, 0}, {3, 1}, {3, 2}};
  for (const auto& [dimension, a] : dimensions_and_axes) {
    double other = 1;
    for (int axis = 0; axis < dimension; ++axis) {
      if (axis != a) other *= stretch(axis, X[axis]);
    }
    const auto P = [&, a = a](double x) {
      const double F = stretch(a, x);
      return mu * (F - 1 / F) + lambda * std::log(F * other) / F;
    };
    const double tau = 1e-6;
    const double acceleration =
        (u(a, X[a], t + tau) - 2 * u(a, X[a], t) + u(a, X[a], t - tau)) / (tau * tau);
    const double F = stretch(a, X[a]), lnJ = std::log(F * other);
    const double b = pi * pi * u(a, X[a], t) / rho * ((lambda * (1 - lnJ) + mu) / (F * F) + mu - E);
    const double slope = (P(X[a] + 1e-4) - P(X[a] - 1e-4)) / 2e-4;
    EXPECT_NEAR((rho * acceleration - slope) / (rho * b), 1, 1e-4) << dimension << ' ' << a;
  }
}

}  // namespace
}  // namespace scree::verify::cases

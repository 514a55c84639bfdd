// SPDX-License-Identifier: Apache-2.0
// The fluid law against its formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/conformance/samples/j_fluid.hpp"

namespace scree {
namespace {

using Law = JFluid;

constexpr double kBulk = 2e5, kGamma = 7, kViscosity = 0.7;

Law::Params<double> water(double initial_j) {
  return Law::params<double>({kBulk, kGamma, kViscosity, initial_j}, testing::density, 3);
}

TEST(JFluidTest, PressureFollowsTheVolumeRatio) {
  for (const double J : {0.8, 0.97, 0.999999, 1.0, 1.02, 1.3}) {
    const auto p = water(J);
    auto state = Law::initial<double>(p);
    const Sym3<double> tau = Law::kirchhoff(p, state, zero3<double>(), 1e-3);
    const double pressure = kBulk * (std::pow(J, -kGamma) - 1);
    // J - 1 carries the rounding of J.
    EXPECT_NEAR(tau.xx, -J * pressure, 1e-14 * kBulk * (1 + std::abs(pressure) / kBulk)) << J;
    EXPECT_EQ(tau.xx, tau.zz);
    EXPECT_EQ(tau.xy, 0);
    EXPECT_NEAR(Law::volume_ratio(p, state), J, 1e-15);
    // Sound, and tension as in a string.
    const double stiffness =
        kBulk * kGamma * std::pow(J, 1 - kGamma) + std::max(-J * pressure, 0.0);
    EXPECT_NEAR(Law::wave_speed(p, state), std::sqrt(stiffness / testing::density), 1e-12 * 100);
  }
}

TEST(JFluidTest, SmallChangesOfVolumeKeepTheirRelativeAccuracy) {
  const auto p = Law::params<float>({kBulk, kGamma, 0, 1}, testing::density, 3);
  auto state = Law::initial<float>(p);
  Mat3<float> L = zero3<float>();
  L(0, 0) = 1e-10f;  // far below the resolution of J = 1 in single precision
  Sym3<float> tau{};
  for (int n = 0; n < 1000; ++n) tau = Law::kirchhoff(p, state, L, 1e-3f);
  EXPECT_NEAR(tau.xx / (kBulk * kGamma * 1e-7), 1, 1e-4);
}

TEST(JFluidTest, ViscousStressAndItsOutput) {
  const auto p = water(0.98);
  auto state = Law::initial<double>(p);
  const double dt = 1e-3;
  testing::MatrixSource source(51);
  const Eigen::Matrix3d gradient = source.entries(3.0);
  const Sym3<double> tau = Law::kirchhoff(p, state, testing::from_eigen<double>(dt * gradient), dt);
  const double J = 0.98 * (1 + dt * gradient.trace());
  const double pressure = kBulk * (std::pow(J, -kGamma) - 1);
  const Eigen::Matrix3d expected =
      J * (kViscosity * (gradient + gradient.transpose()) - pressure * Eigen::Matrix3d::Identity());
  EXPECT_LE((testing::to_eigen(tau) - expected).norm(), 1e-12 * kBulk);
  EXPECT_NEAR(Law::volume_ratio(p, state), J, 1e-15);
  // Output evaluates the stress of the last step.
  const Sym3<double> again = Law::kirchhoff(p, state, zero3<double>(), 0.0);
  EXPECT_LE(testing::distance(tau, again), 1e-15 * kBulk);
}

TEST(JFluidTest, EnergyIsTheWorkOfThePressure) {
  for (const double gamma : {1.0, 1.0 + 1e-9, 4.4, 7.0}) {
    for (const double J : {0.7, 0.99, 1.2}) {
      const auto p = Law::params<double>({kBulk, gamma, 0, J}, testing::density, 3);
      // Simpson's rule for the integral of -p dJ from 1 to J: error below 1e-12 with 2000
      // intervals.
      const int n = 2000;
      double integral = 0;
      for (int i = 0; i <= n; ++i) {
        const double x = 1 + (J - 1) * i / n, weight = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
        integral -= weight * kBulk * (std::pow(x, -gamma) - 1) * (J - 1) / (3 * n);
      }
      EXPECT_NEAR(Law::energy_density(p, Law::initial<double>(p)), integral, 1e-9 * kBulk);
    }
  }
}

TEST(JFluidTest, ImpossibleCompressionIsRefused) {
  const auto schema = Law::schema();
  const auto refused = [&](const Law::Input& input) {
    for (const auto& check : schema.checks()) {
      if (check.test(&input, SchemaContext{})) return true;
    }
    return false;
  };
  EXPECT_FALSE(refused({kBulk, 7, 0, 0.5}));
  EXPECT_TRUE(refused({kBulk, 7, 0, std::exp(-41.0 / 7)}));
}

}  // namespace
}  // namespace scree

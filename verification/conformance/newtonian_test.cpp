// SPDX-License-Identifier: Apache-2.0
// The Newtonian fluid against its formulas.
#include "materials/newtonian.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/conformance/samples/newtonian.hpp"
#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using Law = Newtonian;
using testing::from_eigen;
using testing::to_eigen;
constexpr double kBulk = 2e6, kViscosity = 0.7, kDensity = 1000;

Law::Params<double> fluid(double gamma, bool tension = true) {
  return Law::params<double>({kBulk, kViscosity, gamma, tension}, kDensity, 3);
}

/// A state of volume ratio J at rest.
Law::State<double> compressed(const Law::Params<double>& p, double J) {
  auto state = Law::initial<double>(p);
  state.volume_strain = J - 1;
  return state;
}

TEST(NewtonianTest, PressureAndSoundFollowTheVolumeRatio) {
  for (const double gamma : {1.0, 4.4, 7.0}) {
    const auto p = fluid(gamma);
    for (const double J : {0.8, 0.97, 0.999999, 1.0, 1.02, 1.3}) {
      auto state = compressed(p, J);
      const Sym3<double> tau = Law::kirchhoff(p, state, zero3<double>(), 1e-3);
      const double pressure = kBulk / gamma * (std::pow(J, -gamma) - 1);
      EXPECT_NEAR(tau.xx, -J * pressure, 1e-14 * (kBulk + std::abs(pressure)));
      EXPECT_EQ(tau.xy, 0);
      const double c = Law::wave_speed(p, state);
      const double sound = kBulk * std::pow(J, 1 - gamma);
      const double tension = std::max(-J * pressure, 0.0);
      EXPECT_NEAR(c * c * kDensity / (sound + tension), 1, 1e-13);
      const auto parting = fluid(gamma, false);
      const double still = Law::wave_speed(parting, compressed(parting, J));
      EXPECT_NEAR(still * still * kDensity / sound, 1, 1e-13);
    }
  }
}

TEST(NewtonianTest, GammaOneIsLinearInTheDensity) {
  const auto p = fluid(1);
  for (const double compression : {-0.2, 0.01, 0.4}) {
    auto state = compressed(p, 1 / (1 + compression));
    const Sym3<double> tau = Law::kirchhoff(p, state, zero3<double>(), 1e-3);
    EXPECT_NEAR(-tau.yy * (1 + compression), kBulk * compression, 1e-14 * kBulk);
  }
}

TEST(NewtonianTest, ViscousStressIsDeviatoricAndIsOutput) {
  const auto p = fluid(7);
  auto state = compressed(p, 0.98);
  const double dt = 1e-4;
  testing::MatrixSource source(61);
  const Eigen::Matrix3d gradient = source.entries(3.0), one = Eigen::Matrix3d::Identity();
  const Sym3<double> tau = Law::kirchhoff(p, state, from_eigen<double>(dt * gradient), dt);
  const double J = 0.98 * (one + dt * gradient).determinant();
  const double pressure = kBulk / 7 * (std::pow(J, -7) - 1);
  const Eigen::Matrix3d rate = gradient + gradient.transpose();
  const Eigen::Matrix3d expected =
      J * (kViscosity * (rate - rate.trace() / 3 * one) - pressure * one);
  EXPECT_LE((to_eigen(tau) - expected).norm(), 1e-13 * kBulk);
  EXPECT_NEAR(-trace(tau) / 3, J * pressure, 1e-14 * kBulk) << "viscosity must not add pressure";
  EXPECT_NEAR(Law::volume_ratio(p, state), J, 1e-15);
  const Sym3<double> again = Law::kirchhoff(p, state, zero3<double>(), 0.0);
  EXPECT_LE(norm(tau - again), 1e-15 * kBulk);
}

TEST(NewtonianTest, EnergyIsTheWorkOfThePressure) {
  for (const double gamma : {1.0, 1.0 + 1e-9, 4.4, 7.0}) {
    for (const double J : {0.7, 0.99, 1.2}) {
      const auto p = fluid(gamma);
      // Simpson's rule for the integral of -p dJ from 1 to J: error below 1e-12 with 2000
      // intervals.
      const int n = 2000;
      double integral = 0;
      for (int i = 0; i <= n; ++i) {
        const double x = 1 + (J - 1) * i / n, weight = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
        integral -= weight * kBulk / gamma * (std::pow(x, -gamma) - 1) * (J - 1) / (3 * n);
      }
      EXPECT_NEAR(Law::energy_density(p, compressed(p, J)), integral, 1e-9 * kBulk);
      const double without_tension = J < 1 ? integral : 0;
      const auto parting = fluid(gamma, false);
      EXPECT_NEAR(Law::energy_density(parting, compressed(parting, J)), without_tension,
                  1e-9 * kBulk);
    }
  }
}

TEST(NewtonianTest, PartsWithoutTensionAndCloses) {
  const auto p = Law::params<double>({kBulk, 0, 7, false}, kDensity, 3);
  auto state = Law::initial<double>(p);
  const auto grow = [&](double factor) {
    Mat3<double> L = zero3<double>();
    L(1, 1) = factor - 1;
    return Law::kirchhoff(p, state, L, 1e-3);
  };
  EXPECT_EQ(norm(grow(1.25)), 0);
  EXPECT_EQ(norm(grow(1 / 1.2)), 0);
  const double pressure = kBulk / 7 * (std::pow(0.99, -7) - 1);
  EXPECT_NEAR(grow(0.99 * 1.2 / 1.25).xx, -0.99 * pressure, 1e-13 * kBulk);
}

/// The space between drops is not viscous: else the step would shrink as they fly apart.
TEST(NewtonianTest, OnlyTheLiquidOfPartedFluidIsViscous) {
  for (const double J : {0.9, 1.0, 3.0, 500.0}) {
    const auto p = fluid(7, false);
    auto state = compressed(p, J);
    Mat3<double> shear = zero3<double>();
    const double dt = 1e-3, rate = 40, liquid = std::min(J, 1.0);
    shear(0, 1) = rate * dt;
    const Sym3<double> tau = Law::kirchhoff(p, state, shear, dt);
    EXPECT_NEAR(tau.xy, liquid * kViscosity * rate, 1e-13 * kViscosity * rate);
    EXPECT_NEAR(Law::momentum_diffusivity(p, state), 4.0 / 3.0 * kViscosity * liquid / kDensity,
                1e-18);
    const auto holding = fluid(7);
    EXPECT_NEAR(Law::momentum_diffusivity(holding, state), 4.0 / 3.0 * kViscosity * J / kDensity,
                1e-18 * J);
  }
}

TEST(NewtonianTest, SmallChangesOfVolumeKeepTheirRelativeAccuracy) {
  const auto p = Law::params<float>({kBulk, 0, 7, true}, kDensity, 3);
  auto state = Law::initial<float>(p);
  Mat3<float> L = zero3<float>();
  L(0, 0) = 1e-10f;  // far below the resolution of J = 1 in single precision
  Sym3<float> tau{};
  for (int n = 0; n < 1000; ++n) tau = Law::kirchhoff(p, state, L, 1e-3f);
  EXPECT_NEAR(tau.xx / (kBulk * 1e-7), 1, 1e-4);
}

TEST(NewtonianTest, KinematicViscosityIsThatOfThePresentDensity) {
  const auto p = fluid(7);
  EXPECT_NEAR(Law::momentum_diffusivity(p, compressed(p, 0.9)),
              4.0 / 3.0 * kViscosity * 0.9 / kDensity, 1e-18);
}

}  // namespace
}  // namespace scree

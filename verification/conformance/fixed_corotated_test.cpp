// SPDX-License-Identifier: Apache-2.0
// Fixed-corotated elasticity against its closed forms.
#include <gtest/gtest.h>

#include "verification/conformance/samples/fixed_corotated.hpp"

namespace scree {
namespace {

using Law = FixedCorotated;

TEST(FixedCorotatedTest, ConfinedUniaxialStressIsExactlyLinear) {
  const auto p = Law::params<double>({1e7, 0.3}, testing::density, 3);
  for (const double s : {0.2, 0.5, 0.9, 0.999999, 1.0, 1.1, 2.0, 5.0}) {
    auto state = Law::initial<double>(p);
    Mat3<double> L = zero3<double>();
    L(0, 0) = s - 1;
    const Sym3<double> tau = Law::kirchhoff(p, state, L, 1e-3);
    // P = tau F^-T
    EXPECT_NEAR(tau.xx / s, (p.lambda + 2 * p.mu) * (s - 1), 1e-13 * p.mu * (s + 1 / s)) << s;
    EXPECT_NEAR(tau.yy, p.lambda * s * (s - 1), 1e-13 * p.mu * (s + 1) * (s + 1)) << s;
    EXPECT_EQ(tau.xy, 0);
  }
}

TEST(FixedCorotatedTest, PrincipalStressesOfARotatedBody) {
  const auto p = Law::params<double>({1e7, 0.45}, testing::density, 3);
  testing::MatrixSource source(41);
  for (int n = 0; n < 1000; ++n) {
    const Eigen::Vector3d s(source.uniform(0.3, 3), source.uniform(0.3, 3), source.uniform(0.3, 3));
    const Eigen::Matrix3d u = source.rotation(), v = source.rotation();
    const Eigen::Matrix3d f = u * s.asDiagonal() * v.transpose();
    auto state = Law::initial<double>(p);
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const Sym3<double> tau = Law::kirchhoff(p, state, testing::from_eigen<double>(f - one), 1e-3);
    const double J = s.prod();
    const Eigen::Vector3d principal =
        2 * p.mu * (s.array() - 1) * s.array() + p.lambda * J * (J - 1);
    const Eigen::Matrix3d expected = u * principal.asDiagonal() * u.transpose();
    EXPECT_LE((testing::to_eigen(tau) - expected).norm(), 1e-12 * (p.mu + expected.norm()));
    const double energy = p.mu * (s.array() - 1).square().sum() + p.lambda / 2 * (J - 1) * (J - 1);
    EXPECT_NEAR(Law::energy_density(p, state), energy, 1e-12 * (p.mu + energy));
    EXPECT_NEAR(Law::volume_ratio(p, state), J, 1e-13 * J);
  }
}

TEST(FixedCorotatedTest, WaveSpeedAtRestIsThatOfLinearElasticity) {
  const auto p = Law::params<double>({1e7, 0.3}, testing::density, 3);
  EXPECT_NEAR(Law::wave_speed(p, Law::initial<double>(p)),
              std::sqrt((p.lambda + 2 * p.mu) / testing::density), 1e-12);
}

TEST(FixedCorotatedTest, StrongDeformationStaysFinite) {
  const auto p = Law::params<float>({1e7, 0.3}, testing::density, 3);
  testing::MatrixSource source(42);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  for (int n = 0; n < 1000; ++n) {
    const auto size = [&] { return std::pow(10.0, source.uniform(-3, 2)); };
    const Eigen::Matrix3d f = source.with_stretches(size(), size(), size());
    auto state = Law::initial<float>(p);
    const testing::FloatingPointTraps traps;
    const Sym3<float> tau = Law::kirchhoff(p, state, testing::from_eigen<float>(f - one), 1e-3f);
    ASSERT_TRUE(std::isfinite(trace(tau))) << f;
  }
}

}  // namespace
}  // namespace scree

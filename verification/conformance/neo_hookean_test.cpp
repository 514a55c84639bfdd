// SPDX-License-Identifier: Apache-2.0
// The neo-Hookean law against its formulas and the exact acoustic tensor.
#include "materials/neo_hookean.hpp"

#include <gtest/gtest.h>

#include "verification/conformance/samples/neo_hookean.hpp"
#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using Law = NeoHookean;
constexpr double kYoung = 1e7, kPoisson = 0.3, kDensity = 1200;
const LameConstants kLame = lame_constants(kYoung, kPoisson);

Law::Params<double> rubber() { return Law::params<double>({kYoung, kPoisson}, kDensity, 3); }

TEST(NeoHookeanTest, UniaxialStrain) {
  for (const double s : {0.4, 0.9, 1.0, 1.3, 2.5}) {
    const auto p = rubber();
    auto state = Law::initial<double>(p);
    Mat3<double> L = zero3<double>();
    L(0, 0) = s - 1;
    const Sym3<double> tau = Law::kirchhoff(p, state, L, 1e-3);
    // P_11 = mu (s - 1/s) + lambda ln(s)/s, tau_11 = s P_11; sideways lambda ln s.
    const double along = kLame.mu * (s * s - 1) + kLame.lambda * std::log(s);
    EXPECT_NEAR(tau.xx, along, 1e-14 * kYoung * (1 + s * s));
    EXPECT_NEAR(tau.yy, kLame.lambda * std::log(s), 1e-14 * kYoung);
    EXPECT_EQ(tau.xy, 0);
    EXPECT_NEAR(Law::volume_ratio(p, state), s, 1e-15);
    const double energy = kLame.mu * (0.5 * (s * s - 1) - std::log(s)) +
                          0.5 * kLame.lambda * std::log(s) * std::log(s);
    EXPECT_NEAR(Law::energy_density(p, state), energy, 1e-14 * kYoung);
  }
}

TEST(NeoHookeanTest, SimpleShear) {
  const auto p = rubber();
  auto state = Law::initial<double>(p);
  Mat3<double> L = zero3<double>();
  const double shear = 0.7;
  L(0, 1) = shear;
  const Sym3<double> tau = Law::kirchhoff(p, state, L, 1e-3);
  EXPECT_NEAR(tau.xy, kLame.mu * shear, 1e-14 * kYoung);
  EXPECT_NEAR(tau.xx, kLame.mu * shear * shear, 1e-14 * kYoung);  // Poynting effect
  EXPECT_NEAR(tau.zz, 0, 1e-14 * kYoung);
}

TEST(NeoHookeanTest, WaveSpeedIsExactAlongTheLargestStretch) {
  const auto p = rubber();
  for (const double s : {0.5, 1.0, 1.8}) {
    auto state = Law::initial<double>(p);
    Mat3<double> L = zero3<double>();
    L(0, 0) = s - 1;
    Law::kirchhoff(p, state, L, 1e-3);
    // rho0 c^2 of the wave along n = e_x is mu s^2 + mu + lambda (1 - ln s).
    const double along = kLame.mu * (s * s + 1) + kLame.lambda * (1 - std::log(s));
    const double c = Law::wave_speed(p, state);
    EXPECT_GE(kDensity * c * c, along * (1 - 1e-14));
    // The bound of the eigenvalues from invariants is exact for one large value.
    if (s >= 1) {
      EXPECT_NEAR(kDensity * c * c / along, 1, 1e-12);
    }
  }
}

}  // namespace
}  // namespace scree

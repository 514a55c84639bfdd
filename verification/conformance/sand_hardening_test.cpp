// SPDX-License-Identifier: Apache-2.0
// drucker_prager: friction hardening, the tip under dilation, the paths of the triaxial and the
// shear box.
#include <gtest/gtest.h>

#include "verification/conformance/principal_paths.hpp"
#include "verification/conformance/samples/drucker_prager.hpp"

namespace scree {
namespace {

using testing::degree;
using testing::findings;
using testing::mean_pressure;
using testing::shear_stress;
using testing::stretch;
using Law = DruckerPrager;
using Params = Law::Params<double>;
using State = Law::State<double>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Params sand(const Law::Input& in) { return Law::params<double>(in, testing::density, 3); }

Law::Input fixed(double friction, double cohesion = 0, double dilation = 0) {
  return {1e7, 0.3, friction, cohesion, dilation, Match::compression};
}
/// The values of Klar et al. 2016.
Law::Input hardening(double dilation = 0, double cohesion = 0) {
  return {1e7,         0.3,        kNone, cohesion,   dilation, Match::compression,
          35 * degree, 9 * degree, 0.2,   10 * degree};
}

State compressed(const Params& p, double pressure) {
  State s = Law::initial<double>(p);
  const double e = -pressure / (3 * p.lambda + 2 * p.mu);
  stretch<Law>(p, s, e, e, e);
  return s;
}

double outer_cone(double phi) { return 6 * std::sin(phi) / (3 - std::sin(phi)); }

TEST(SandPathTest, DrainedTriaxialFailure) {
  // q = 3 M sigma_3/(3 - M); 30 deg: sigma_1 = 3 sigma_3.
  const Params p = sand(fixed(30 * degree));
  State s = compressed(p, 1e5);
  Sym3<double> tau{};
  for (int n = 0; n < 100; ++n) tau = testing::triaxial_step<Law>(p, s, -1e-3, -1e5);
  EXPECT_NEAR(shear_stress(tau), 3 * 1.2 * 1e5 / (3 - 1.2), 1e-4);
  EXPECT_NEAR(-tau.xx, 3e5, 1e-4);
}

TEST(SandPathTest, UndrainedAndSimpleShearKeepThePressure) {
  const double p0 = 2e5;
  const Params p = sand(fixed(30 * degree));
  State s = compressed(p, p0);
  Sym3<double> tau{};
  for (int n = 0; n < 100; ++n) tau = stretch<Law>(p, s, -2e-3, 1e-3, 1e-3);
  EXPECT_NEAR(mean_pressure(tau), p0, 1e-9 * p0);
  EXPECT_NEAR(shear_stress(tau), 1.2 * p0, 1e-9 * p0);
  State simple = compressed(p, p0);
  Mat3<double> L = zero3<double>();
  L(0, 1) = 1e-3;
  for (int n = 0; n < 100; ++n) tau = Law::kirchhoff(p, simple, L, 1e-3);
  EXPECT_NEAR(mean_pressure(tau), p0, 1e-9 * p0);
  EXPECT_NEAR(shear_stress(tau) / mean_pressure(tau), 1.2, 1e-11);
}

TEST(FrictionHardeningTest, CurveOfThePaper) {
  const FrictionHardening h = hardening().hardening();
  EXPECT_NEAR(h.angle(0), 25 * degree, 1e-15);
  const double q = 1 / 0.2 + 10.0 / 9;  // the peak, 6.111
  EXPECT_NEAR(h.angle(q), h.highest_angle(), 1e-15);
  EXPECT_GT(h.angle(q), h.angle(q * 0.99));
  EXPECT_GT(h.angle(q), h.angle(q * 1.01));
  EXPECT_NEAR(h.highest_angle() / degree, 35 + 45 * std::exp(-1 - 0.2 * 10 / 9), 1e-12);
  EXPECT_NEAR(h.highest_angle() / degree, 48.26, 5e-3);
  // The steepest loss by a difference of the curve.
  const double x = 2 / 0.2 + 10.0 / 9, step = 1e-4;
  EXPECT_NEAR((h.angle(x) - h.angle(x + step)) / step, h.steepest_loss(), 1e-7);
}

TEST(FrictionHardeningTest, StressFollowsTheCurveOverThePlasticShearStrain) {
  // Undrained shear: q/p = M(phi(q)) with q the length of the plastic strain; over the peak and
  // down the other side.
  for (const double dilation : {0.0, 5 * degree}) {
    const Params p = sand(hardening(dilation));
    const FrictionHardening h = hardening().hardening();
    State s = compressed(p, 1e5);
    double plastic = 0, total = 0, highest = 0;
    for (int n = 0; n < 1300; ++n) {
      const double step = 5e-3, before = std::log(s.F(0, 0)) - std::log(s.F(1, 1));
      const auto tau = stretch<Law>(p, s, -step, step / 2, step / 2);
      const double after = std::log(s.F(0, 0)) - std::log(s.F(1, 1));
      // Deviators along (-1, 1/2, 1/2): their length is sqrt(2/3) of the difference.
      plastic += std::sqrt(2.0 / 3.0) * (after - before + 1.5 * step);
      total = s.equivalent_plastic_strain * std::sqrt(1.5);
      ASSERT_NEAR(plastic, total, 1e-9 * (1 + total)) << n;
      const double ratio = shear_stress(tau) / mean_pressure(tau);
      if (n > 20) {
        ASSERT_NEAR(ratio, outer_cone(h.angle(total)), 1e-10);
      }
      highest = std::max(highest, ratio);
    }
    if (dilation > 0) continue;  // the pressure grows without end, and elasticity with it
    EXPECT_GT(total, 7.9);
    EXPECT_NEAR(highest, outer_cone(h.highest_angle()), 1e-5);
  }
}

TEST(FrictionHardeningTest, OpeningDoesNotHarden) {
  const Params p = sand(hardening());
  State s = Law::initial<double>(p);
  for (int n = 0; n < 10; ++n) stretch<Law>(p, s, 0.01, 0.01, 0.01);
  EXPECT_NEAR(s.equivalent_plastic_strain, 0, 1e-14);
  EXPECT_NEAR(s.volume_correction, 0.3, 1e-13);
}

TEST(FrictionHardeningTest, TipStaysAtThatOfTheFirstAngle) {
  const double c = 1e4;
  const Params p = sand(hardening(0, c));
  State s = compressed(p, 1e5);
  for (int n = 0; n < 200; ++n) stretch<Law>(p, s, -1e-2, 5e-3, 5e-3);
  const auto tau = stretch<Law>(p, s, 0.1, 0.1, 0.1);
  EXPECT_NEAR(-mean_pressure(tau), c / std::tan(25 * degree), 1e-8 * c);
}

// The return must not jump where cone and tip meet. Along strains that pass the meeting point the
// stress and the volume correction are Lipschitz: halving the distance halves the difference.
TEST(SandTipTest, ContinuousUnderDilation) {
  for (const double psi : {0.0, 10 * degree, 30 * degree}) {
    const Params p = sand(fixed(35 * degree, 1e4, psi));
    const double tip = p.cohesion_strain;
    for (const double length : {0.005, 0.02}) {
      // ehat = length (1, -1, 0)/sqrt 2; cone and tip meet at a mean of a length.
      const auto at = [&](double offset) {
        State s = Law::initial<double>(p);
        const double mean = tip + p.dilation * length + offset, x = length / std::sqrt(2.0);
        const auto tau = stretch<Law>(p, s, mean + x, mean - x, mean);
        return std::tuple{tau, s.volume_correction, s.equivalent_plastic_strain};
      };
      for (const double h : {1e-5, 1e-7, 1e-9}) {
        const auto [below, gap_below, strain_below] = at(-h);
        const auto [above, gap_above, strain_above] = at(h);
        // Slopes: at most a few P-wave moduli for the stress, 6 for the gap.
        EXPECT_LE(norm(below - above), 2e8 * h + 1e-6) << psi << " " << length << " " << h;
        EXPECT_LE(std::abs(gap_above - gap_below), 7 * h + 1e-14);
        EXPECT_LE(std::abs(strain_above - strain_below), 20 * h + 1e-14);
      }
      // Far beyond, what dilation does not explain opens a gap.
      EXPECT_NEAR(std::get<1>(at(0.01)), 0.03, 1e-13);
    }
  }
}

TEST(SandTipTest, DilatantReturnAtZeroMeanEndsUnderPressure) {
  // Shear at the tip without room to dilate presses the grains together.
  const Params p = sand(fixed(35 * degree, 0, 20 * degree));
  State s = Law::initial<double>(p);
  const auto tau = stretch<Law>(p, s, 0.01, -0.01, 0);
  EXPECT_GT(mean_pressure(tau), 1e4);
  EXPECT_EQ(s.volume_correction, 0);
}

TEST(FrictionHardeningTest, DeckErrors) {
  const auto found = [](const Law::Input& in) {
    const auto list = findings<Law>(in);
    return list.size() == 1 ? list[0].key : std::to_string(list.size()) + " findings";
  };
  EXPECT_TRUE(findings<Law>(hardening()).empty());
  EXPECT_TRUE(findings<Law>(hardening(25 * degree)).empty());
  EXPECT_EQ(found(fixed(kNone)), "friction_angle");
  auto in = hardening();
  in.friction_angle = 0.5;
  EXPECT_EQ(found(in), "friction_angle");
  EXPECT_EQ(found(hardening(26 * degree)), "dilation_angle");
  in = hardening();
  in.h2 = kNone;
  EXPECT_EQ(found(in), "h2");
  in = hardening();
  in.h3 = in.h0;
  EXPECT_EQ(found(in), "h3");
  in.h3 = 1.2 * in.h0;
  EXPECT_EQ(found(in), "h3");
  in = hardening();
  in.h1 = 90 * degree;
  EXPECT_EQ(found(in), "h1");
}

}  // namespace
}  // namespace scree

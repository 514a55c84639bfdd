// SPDX-License-Identifier: Apache-2.0
// Mohr-Coulomb along the classical paths of soil mechanics, against closed forms; softening; deck
// errors.
#include <gtest/gtest.h>

#include "verification/conformance/principal_paths.hpp"
#include "verification/conformance/samples/mohr_coulomb.hpp"

namespace scree {
namespace {

using testing::degree;
using testing::findings;
using testing::stretch;
using Law = MohrCoulomb;
using Params = Law::Params<double>;
using State = Law::State<double>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Params soil(const Law::Input& in) { return Law::params<double>(in, testing::density, 3); }
double passive(double phi) { return (1 + std::sin(phi)) / (1 - std::sin(phi)); }

/// Isotropic Kirchhoff pressure, elastic.
State compressed(const Params& p, double pressure) {
  State s = Law::initial<double>(p);
  const double e = -pressure / (3 * p.lambda + 2 * p.mu);
  stretch<Law>(p, s, e, e, e);
  return s;
}

TEST(MohrCoulombTest, DrainedTriaxialFailure) {
  // sigma_1 = Kp sigma_3 + 2 c sqrt(Kp): 317.3205 kPa for c = 5 kPa, phi = 30 deg at 100 kPa; at
  // any dilation.
  for (const double psi : {0.0, 10 * degree, 30 * degree}) {
    const double phi = 30 * degree, c = 5e3, lateral = 1e5;
    const Params p = soil({1e7, 0.3, phi, c, psi});
    State s = compressed(p, lateral);
    Sym3<double> tau{};
    for (int n = 0; n < 100; ++n) tau = testing::triaxial_step<Law>(p, s, -1e-3, -lateral);
    const double expected = passive(phi) * lateral + 2 * c * std::sqrt(passive(phi));
    EXPECT_NEAR(-tau.yy, lateral, 1e-9 * lateral);
    EXPECT_NEAR(-tau.zz, lateral, 1e-9 * lateral);
    EXPECT_NEAR(-tau.xx, expected, 1e-9 * expected);
    EXPECT_NEAR(-tau.xx, 317320.5, 0.05);
    // Extension: the axis becomes the smallest stress.
    State e = compressed(p, lateral);
    for (int n = 0; n < 100; ++n) tau = testing::triaxial_step<Law>(p, e, 1e-3, -lateral);
    EXPECT_NEAR(-tau.xx, (lateral - 2 * c * std::sqrt(passive(phi))) / passive(phi),
                1e-9 * lateral);
  }
}

TEST(MohrCoulombTest, UndrainedFailure) {
  // At constant volume and without dilation the mean stress stays:
  // s1 - s3 = (s1 + s3) sin phi + 2 c cos phi with s1 + 2 s3 = 3 p0.
  const double phi = 25 * degree, c = 8e3, p0 = 2e5;
  const Params p = soil({1e7, 0.3, phi, c, 0});
  State s = compressed(p, p0);
  Sym3<double> tau{};
  for (int n = 0; n < 100; ++n) tau = stretch<Law>(p, s, -1e-3, 5e-4, 5e-4);
  EXPECT_NEAR(testing::mean_pressure(tau), p0, 1e-9 * p0);
  const double q = -(tau.xx - tau.yy), M = 6 * std::sin(phi) / (3 - std::sin(phi));
  EXPECT_NEAR(q, M * (p0 + c / std::tan(phi)), 1e-9 * p0);
  EXPECT_NEAR(q, -(tau.xx + tau.yy) * std::sin(phi) + 2 * c * std::cos(phi), 1e-9 * p0);
}

TEST(MohrCoulombTest, UndrainedStrengthOfTresca) {
  // phi = 0, uniaxial: q_f = 2 c (c = 250 Pa: 500 Pa).
  const Params p = soil({1e7, 0.2, 0, 250, 0});
  State s = Law::initial<double>(p);
  Sym3<double> tau{};
  for (int n = 0; n < 50; ++n) {
    const double x = testing::solve(3e-6, 5e-6, 1e3, [&](double y) {
      State trial = s;
      return stretch<Law>(p, trial, -1e-5, y, y).yy;
    });
    tau = stretch<Law>(p, s, -1e-5, x, x);
  }
  EXPECT_NEAR(tau.yy, 0, 1e-6);
  EXPECT_NEAR(-tau.xx, 500, 1e-6);
}

TEST(MohrCoulombTest, SimpleShearAtConstantNormalStress) {
  // Davis 1968: tau/sigma_n = sin phi cos psi/(1 - sin phi sin psi) on the line of no extension:
  // 0.5 for 30 and 0 deg, tan 30 deg for associated flow.
  const double angles[][2] = {{30, 0}, {30, 30}, {40, 12}};
  for (const auto& [friction, dilation] : angles) {
    const double phi = friction * degree, psi = dilation * degree, normal = 1e5;
    const Params p = soil({1e9, 0.3, phi, 0, psi});
    State s = compressed(p, normal);
    Sym3<double> tau{};
    for (int n = 0; n < 400; ++n) tau = testing::shear_step<Law>(p, s, 2e-5, -normal);
    const double expected = std::sin(phi) * std::cos(psi) / (1 - std::sin(phi) * std::sin(psi));
    // Strains of 1e-4 turn the axes of stress by as much.
    EXPECT_NEAR(tau.xy / -tau.yy, expected, 2e-4) << friction << " " << dilation;
    if (friction == dilation) {
      EXPECT_NEAR(expected, std::tan(phi), 1e-15);
    }
  }
}

TEST(MohrCoulombTest, OedometerYieldsWhereElasticityLiesBelowTheActiveLine) {
  const double c = 1e3, phi = 35 * degree, K = passive(phi);
  for (const double nu : {0.1, 0.35}) {
    const Params p = soil({1e7, nu, phi, c, 0});
    State s = Law::initial<double>(p);
    Sym3<double> tau{};
    for (int n = 0; n < 200; ++n) tau = stretch<Law>(p, s, -1e-4, 0, 0);
    const double K0 = nu / (1 - nu), vertical = -tau.xx;
    const bool yields = K * K0 * vertical + 2 * c * std::sqrt(K) < vertical;
    EXPECT_EQ(yields, nu == 0.1);
    const double expected = yields ? (vertical - 2 * c * std::sqrt(K)) / K : K0 * vertical;
    EXPECT_NEAR(-tau.yy, expected, 1e-10 * vertical);
    EXPECT_NEAR(-tau.zz, expected, 1e-10 * vertical);
  }
}

TEST(MohrCoulombTest, TensionEndsAtTheCutoff) {
  const Params p = soil({1e7, 0.3, 30 * degree, 2e4, 0, 5e3});
  State s = Law::initial<double>(p);
  Sym3<double> tau{};
  for (int n = 0; n < 20; ++n) tau = stretch<Law>(p, s, 1e-4, -3e-5, -3e-5);
  EXPECT_NEAR(tau.xx, 5e3, 1e-8 * 5e3);
  State apart = Law::initial<double>(p);
  tau = stretch<Law>(p, apart, 0.1, 0.2, 0.3);
  EXPECT_NEAR(norm(tau - Sym3<double>{5e3, 0, 0, 5e3, 0, 5e3}), 0, 1e-8 * 5e3);
}

Law::Input softening(double strain) {
  return {1e7, 0.3, 38 * degree, 2e4, 10 * degree, kNone, 30 * degree, 5e3, 0.0, strain};
}

TEST(MohrCoulombTest, SofteningFollowsThePlasticStrain) {
  const double strain = 0.05, p0 = 1e5;
  const Params p = soil(softening(strain));
  State s = compressed(p, p0);
  double last = 0, peak = 0;
  for (int n = 0; n < 400; ++n) {
    const Sym3<double> tau = testing::triaxial_step<Law>(p, s, -5e-4, -p0);
    const double part = std::min(s.equivalent_plastic_strain / strain, 1.0);
    const double phi = (38 - 8 * part) * degree, c = 2e4 - 1.5e4 * part;
    const double K = passive(phi), limit = K * p0 + 2 * c * std::sqrt(K);
    ASSERT_LE(-tau.xx, limit * (1 + 1e-9));
    if (s.equivalent_plastic_strain > 0) {
      ASSERT_NEAR(-tau.xx, limit, 1e-9 * limit);
      ASSERT_GT(s.equivalent_plastic_strain, last);
    }
    last = s.equivalent_plastic_strain;
    peak = std::max(peak, -tau.xx);
  }
  const double K = passive(30 * degree);
  EXPECT_GT(last, 2 * strain);
  EXPECT_GT(peak, 1.3 * (K * p0 + 2 * 5e3 * std::sqrt(K)));
}

TEST(MohrCoulombTest, SofteningStepCountsItsWholePlasticStrain) {
  // The stored plastic strain is that of the return with the strength it implies.
  testing::MatrixSource source(81);
  const Params p = soil(softening(0.1));
  for (int n = 0; n < 2000; ++n) {
    State s = compressed(p, 1e5);
    const double e[] = {source.uniform(-0.02, 0), source.uniform(-0.01, 0.01),
                        source.uniform(0, 0.02)};
    const double before[] = {std::log(s.F(0, 0)), std::log(s.F(1, 1)), std::log(s.F(2, 2))};
    stretch<Law>(p, s, e[0], e[1], e[2]);
    Eigen::Vector3d plastic;
    for (int i = 0; i < 3; ++i) plastic[i] = before[i] + e[i] - std::log(s.F(i, i));
    const double shear = std::sqrt(2.0 / 3.0) * (plastic.array() - plastic.mean()).matrix().norm();
    // Three secant steps leave less than 1e-9 of a step of 1 %; kinks between planes and edges
    // more.
    ASSERT_NEAR(s.equivalent_plastic_strain, shear, 1e-6 * (shear + 1e-6));
  }
}

TEST(MohrCoulombTest, DeckErrors) {
  const auto key = [](const Law::Input& in) {
    const auto found = findings<Law>(in);
    return found.size() == 1 ? found[0].key : std::to_string(found.size()) + " findings";
  };
  EXPECT_TRUE(findings<Law>({1e7, 0.3, 0.5, 0, 0.5}).empty());
  EXPECT_TRUE(findings<Law>({1e7, 0.3, 0, 1e3, 0}).empty());
  EXPECT_TRUE(findings<Law>(softening(0.05)).empty());
  EXPECT_EQ(key({1e7, 0.3, 0, 0, 0}), "friction_angle");
  EXPECT_EQ(key({1e7, 0.3, 0.5, 0, 0.51}), "dilation_angle");
  EXPECT_EQ(key({1e7, 0.3, 0.5, 1e3, 0, kNone, 0.6, kNone, kNone, 0.1}), "residual_friction_angle");
  EXPECT_EQ(key({1e7, 0.3, 0.5, 1e3, 0, kNone, 0.0, 0.0, kNone, 0.1}), "residual_friction_angle");
  EXPECT_EQ(key({1e7, 0.3, 0.5, 1e3, 0, kNone, kNone, 2e3, kNone, 0.1}), "residual_cohesion");
  EXPECT_EQ(key({1e7, 0.3, 0.5, 1e3, 0.4, kNone, 0.3, kNone, kNone, 0.1}),
            "residual_dilation_angle");
  EXPECT_EQ(key({1e7, 0.3, 0.5, 1e3, 0, kNone, 0.3, kNone, kNone, kNone}), "softening_strain");
  EXPECT_EQ(key({1e7, 0.3, 0.5, 1e3, 0, kNone, kNone, kNone, kNone, 0.1}), "softening_strain");
  // Cohesion of 1 MPa lost over a strain of 0.1 is an unloading modulus of E.
  EXPECT_EQ(key({1e7, 0.3, 0.5, 2e6, 0, kNone, kNone, 1e6, kNone, 0.1}), "softening_strain");
}

}  // namespace
}  // namespace scree

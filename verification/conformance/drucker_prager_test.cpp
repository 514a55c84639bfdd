// SPDX-License-Identifier: Apache-2.0
// The sand law against its equations: listed returns, cone, tip, volume correction, matches,
// oedometer.
#include <gtest/gtest.h>

#include "verification/conformance/principal_paths.hpp"
#include "verification/conformance/samples/drucker_prager.hpp"

namespace scree {
namespace {

using testing::degree;
using testing::findings;
using testing::MatrixSource;
using testing::mean_pressure;
using testing::shear_stress;
using Law = DruckerPrager;
using Params = Law::Params<double>;
using State = Law::State<double>;

constexpr double kBulk = 1e7 / (3 * (1 - 2 * 0.3));
constexpr double kShear = 1e7 / (2 * (1 + 0.3));

Params sand(double phi, Match match, double cohesion = 0, double psi = 0, double nu = 0.3) {
  return Law::params<double>({1e7, nu, phi, cohesion, psi, match}, testing::density, 3);
}

/// State of elastic principal strains, unrotated.
State strained(double a, double b, double c) {
  State s{zero3<double>(), 0, 0, a + b + c};
  s.F(0, 0) = std::exp(a);
  s.F(1, 1) = std::exp(b);
  s.F(2, 2) = std::exp(c);
  return s;
}

/// Applies the principal logarithmic strain increments, axes fixed.
Sym3<double> stretch(const Params& p, State& s, double a, double b, double c) {
  return testing::stretch<Law>(p, s, a, b, c);
}

double cone_of(const Params& p) { return p.cone * 2 * p.mu / (3 * p.lambda + 2 * p.mu); }

TEST(DruckerPragerTest, ListedReturnOnTheOuterCone) {
  const Params p = sand(30 * degree, Match::compression);
  EXPECT_NEAR(cone_of(p), std::sqrt(2.0 / 3.0) * 2 * 0.5 / (3 - 0.5), 1e-15);
  State s = strained(0, 0, 0);
  const Sym3<double> tau = stretch(p, s, -0.02, 0.006, 0.004);
  // Return by hand: e' = e - dg ehat/|ehat|, dg = |ehat| + (3 lambda + 2 mu)/(2 mu) tr(e) alpha.
  const Eigen::Vector3d e(-0.02, 0.006, 0.004), ehat = e.array() - e.sum() / 3;
  const double dg = ehat.norm() + 3 * kBulk / (2 * kShear) * e.sum() * cone_of(p);
  const Eigen::Vector3d expected = e - dg * ehat.normalized();
  EXPECT_NEAR(dg, 0.009846890, 1e-8);
  const double listed[] = {-0.011979274, 0.001508391, 0.000470883};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::log(s.F(i, i)), expected[i], 1e-15);
    EXPECT_NEAR(std::log(s.F(i, i)), listed[i], 1e-8);
  }
  EXPECT_NEAR(shear_stress(tau) / mean_pressure(tau), 1.2, 1e-12);
  EXPECT_NEAR(std::log(det(s.F)), -0.010, 1e-15);
  EXPECT_NEAR(s.equivalent_plastic_strain, std::sqrt(2.0 / 3.0) * dg, 1e-15);
  EXPECT_NEAR(s.log_volume_ratio, -0.010, 1e-15);
}

TEST(DruckerPragerTest, StressIsHenckysLaw) {
  const Params p = sand(30 * degree, Match::compression);
  State s = strained(0, 0, 0);
  const Sym3<double> tau = stretch(p, s, -0.010, -0.009, -0.008);  // inside the cone
  const double lambda = kBulk - 2 * kShear / 3;
  EXPECT_NEAR(tau.xx, 2 * kShear * -0.010 + lambda * -0.027, 1e-7);
  EXPECT_NEAR(tau.yy, 2 * kShear * -0.009 + lambda * -0.027, 1e-7);
  EXPECT_NEAR(tau.zz, 2 * kShear * -0.008 + lambda * -0.027, 1e-7);
  EXPECT_EQ(s.equivalent_plastic_strain, 0);
}

TEST(DruckerPragerTest, ElasticStepKeepsTheGradientToTheBit) {
  const Params p = sand(30 * degree, Match::compression);
  MatrixSource source(31);
  for (int n = 0; n < 100; ++n) {
    State s = testing::elastic_state<Law>(p, source, 0.02, 0.002);
    const Mat3<double> L = testing::from_eigen<double>(source.entries(1e-3));
    const Mat3<double> expected = s.F + L * s.F;
    Law::kirchhoff(p, s, L, 1e-3);
    EXPECT_LE(norm(s.F - expected), 4e-16);  // roundings of the product only
  }
}

TEST(DruckerPragerTest, ReturnedStressIsInsideTheConeForAllMatches) {
  MatrixSource source(32);
  int flowing = 0;
  for (const auto& input : testing::sample_inputs<Law>()) {
    const Params p = Law::params<double>(input, testing::density, 3);
    const double tip = input.cohesion / std::tan(input.friction_angle);  // at p = -c cot phi
    const double M = std::sqrt(27.0 / 2.0) * cone_of(p);
    for (int n = 0; n < 100000; ++n) {
      State s = Law::initial<double>(p);
      const double a = source.uniform(0.3, 3),
                   b = source.uniform(0, 1) < 0.3 ? a : source.uniform(0.3, 3),
                   c = source.uniform(0, 1) < 0.3 ? a : source.uniform(0.3, 3);
      const Eigen::Matrix3d f = source.with_stretches(a, b, c);
      const auto L = testing::from_eigen<double>(f - Eigen::Matrix3d::Identity());
      const Sym3<double> tau = Law::kirchhoff(p, s, L, 1e-3);
      const double q = shear_stress(tau), pressure = mean_pressure(tau);
      ASSERT_TRUE(std::isfinite(q));
      ASSERT_LE(Law::yield_value(p, s), 1e-12);
      if (!p.hardens) {
        ASSERT_LE(q, M * (pressure + tip) + 1e-9 * (1e7 + pressure));
      }
      ASSERT_NEAR(s.log_volume_ratio, std::log(f.determinant()), 1e-12);
      ASSERT_GE(s.volume_correction, 0);
      flowing += s.equivalent_plastic_strain > 0 && s.volume_correction == 0;
    }
  }
  EXPECT_GT(flowing, 40000);  // an eighth of the samples reaches the cone, not the tip
}

TEST(DruckerPragerTest, VolumeCorrectionCycleEndsStressFree) {
  for (const Match match : {Match::compression, Match::extension, Match::plane_strain}) {
    const Params p = sand(30 * degree, match);
    State s = strained(0, 0, 0);
    Sym3<double> tau = stretch(p, s, 0.01, 0.01, 0.01);
    EXPECT_NEAR(norm(tau), 0, 1e-15 * 1e7);
    EXPECT_NEAR(s.volume_correction, 0.03, 1e-15);
    EXPECT_NEAR(s.log_volume_ratio, 0.03, 1e-15);
    tau = stretch(p, s, -0.01, -0.01, -0.01);
    // Without the correction the pressure would be 3 K 0.01.
    EXPECT_NEAR(norm(tau), 0, 1e-14 * 3 * kBulk);
    EXPECT_NEAR(s.volume_correction, 0, 1e-15);
    EXPECT_NEAR(s.log_volume_ratio, 0, 1e-15);
    tau = stretch(p, s, -0.01, -0.01, -0.01);
    EXPECT_NEAR(mean_pressure(tau), 3 * kBulk * 0.01, 1e-12 * kBulk);
  }
}

TEST(DruckerPragerTest, UnequalExpansionIsAbsorbedByVolume) {
  const Params p = sand(30 * degree, Match::compression);
  State s = strained(0, 0, 0);
  stretch(p, s, 0.03, 0, 0);                                       // gap of volume strain 0.03
  const Sym3<double> tau = stretch(p, s, -0.014, -0.014, -0.014);  // closed by 0.042
  EXPECT_NEAR(mean_pressure(tau), kBulk * 0.012, 1e-12 * kBulk);
  EXPECT_EQ(s.volume_correction, 0);
  EXPECT_NEAR(s.log_volume_ratio, -0.012, 1e-15);
}

TEST(DruckerPragerTest, CohesionMovesTheTip) {
  const double c = 2e4, phi = 35 * degree;
  const Params p = sand(phi, Match::plane_strain, c);
  State s = strained(0, 0, 0);
  EXPECT_NEAR(norm(stretch(p, s, 0, 0, 0)), 0, 1e-15);
  const Sym3<double> tau = stretch(p, s, 0.05, 0.04, 0.045);
  EXPECT_NEAR(mean_pressure(tau), -c / std::tan(phi), 1e-12 * c * 100);
  EXPECT_NEAR(shear_stress(tau), 0, 1e-8 * c);
}

TEST(DruckerPragerTest, MatchesOfTheTable) {
  const double phis[] = {20, 25, 30, 35, 40};
  const double outer[] = {0.7721, 0.9838, 1.2000, 1.4183, 1.6361};
  const double extension[] = {0.6140, 0.7409, 0.8571, 0.9630, 1.0587};
  const double inscribed[] = {0.5812, 0.7111, 0.8321, 0.9431, 1.0438};
  const double isochoric[] = {0.5924, 0.7320, 0.8660, 0.9935, 1.1133};
  for (int i = 0; i < 5; ++i) {
    const double phi = phis[i] * degree, sine = std::sin(phi), m = std::sqrt(27.0 / 2.0);
    const double compressive = m * cone_slopes(Match::compression, phi, 0).alpha;
    const double extensive = m * cone_slopes(Match::extension, phi, 0).alpha;
    const double plane = m * cone_slopes(Match::plane_strain, phi, 0).alpha;
    const double associated = m * cone_slopes(Match::plane_strain, phi, phi).alpha;
    EXPECT_NEAR(compressive, 6 * sine / (3 - sine), 1e-15);
    EXPECT_NEAR(extensive, 6 * sine / (3 + sine), 1e-15);
    EXPECT_NEAR(plane, std::sqrt(3.0) * sine, 1e-15);
    EXPECT_NEAR(associated, 3 * sine / std::sqrt(3 + sine * sine), 1e-15);
    EXPECT_NEAR(compressive, outer[i], 5e-5);  // the table has four decimals
    EXPECT_NEAR(extensive, extension[i], 5e-5);
    EXPECT_NEAR(plane, isochoric[i], 5e-5);
    EXPECT_NEAR(associated, inscribed[i], 5e-5);
  }
}

/// Klar's alpha; the friction angle in plane strain of the outer cone of phi, sin phi_ps = M/sqrt 3
/// (none above 42.22 deg of it); the angle to enter on the outer cone for phi in plane strain,
/// sin phi_F = 3 M/(6 + M) with M = sqrt 3 sin phi.
TEST(DruckerPragerTest, AnglesOfTheTable) {
  const double phis[] = {20, 25, 30, 35, 40};
  const double alpha[] = {0.210128, 0.267765, 0.326599, 0.386019, 0.445300};
  const double in_plane[] = {26.471, 34.612, 43.854, 54.972, 70.843};
  const double to_enter[] = {15.6394, 19.0384, 22.2344, 25.2246, 28.0047};
  const double m = std::sqrt(27.0 / 2.0);
  for (int i = 0; i < 5; ++i) {
    const double outer = cone_slopes(Match::compression, phis[i] * degree, 0).alpha;
    EXPECT_NEAR(outer, alpha[i], 5e-7);  // half a unit of the last listed digit, here and below
    EXPECT_NEAR(std::asin(m * outer / std::sqrt(3.0)) / degree, in_plane[i], 5e-4);
    const double wanted = cone_slopes(Match::plane_strain, phis[i] * degree, 0).alpha;
    const double entered = std::asin(3 * m * wanted / (6 + m * wanted));
    EXPECT_NEAR(entered / degree, to_enter[i], 5e-5);
    EXPECT_NEAR(cone_slopes(Match::compression, entered, 0).alpha, wanted, 1e-15);
  }
}

/// Shears in plane strain at constant volume until the stress is steady; the friction angle in the
/// plane.
double plane_friction_angle(const Params& p) {
  State s = strained(0, 0, 0);
  stretch(p, s, -0.02, -0.02, -0.02);
  Sym3<double> tau{};
  for (int n = 0; n < 4000; ++n) tau = stretch(p, s, 1e-4, -1e-4, 0);
  return std::asin(std::abs(tau.xx - tau.yy) / -(tau.xx + tau.yy));
}

TEST(DruckerPragerTest, PlaneStrainMatchActsAsTheFrictionAngle) {
  for (const double phi : {20 * degree, 33 * degree, 40 * degree}) {
    EXPECT_NEAR(plane_friction_angle(sand(phi, Match::plane_strain)), phi, 1e-6);
  }
  // 30 deg on the outer cone act as 43.854 deg: sin phi_ps = M/sqrt 3.
  EXPECT_NEAR(plane_friction_angle(sand(30 * degree, Match::compression)),
              std::asin(1.2 / std::sqrt(3.0)), 1e-6);
}

TEST(DruckerPragerTest, DilationAngleIsThatOfTheFlowInPlaneStrain) {
  // At failure the flow n + a I has no component out of the plane, sin psi = tr / |difference| in
  // it.
  for (const double psi : {5 * degree, 15 * degree, 30 * degree}) {
    const double phi = 35 * degree;
    const auto [alpha, a] = cone_slopes(Match::plane_strain, phi, psi);
    const double root = std::sqrt(2 - 3 * a * a);
    EXPECT_NEAR(3 * a / root, std::sin(psi), 1e-15);
    EXPECT_NEAR(3 * alpha * root / (2 - 3 * alpha * a), std::sin(phi), 1e-15);
  }
}

TEST(DruckerPragerTest, DilationReturnsAlongTheFlow) {
  const double phi = 40 * degree, psi = 15 * degree;
  const Params p = sand(phi, Match::plane_strain, 0, psi);
  const double a = cone_slopes(Match::plane_strain, phi, psi).a;
  State s = strained(0, 0, 0);
  const Sym3<double> tau = stretch(p, s, -0.03, 0.008, 0.004);
  const double dg = s.equivalent_plastic_strain / std::sqrt(2.0 / 3.0);
  EXPECT_GT(dg, 1e-3);
  // Elastic volume strain shrinks by 3 a dg, the total stays.
  EXPECT_NEAR(std::log(det(s.F)), -0.018 - 3 * a * dg, 1e-15);
  EXPECT_NEAR(s.log_volume_ratio, -0.018, 1e-15);
  const double M = std::sqrt(27.0 / 2.0) * cone_of(p);
  EXPECT_NEAR(shear_stress(tau), M * mean_pressure(tau), 1e-12 * mean_pressure(tau));
}

TEST(DruckerPragerTest, OedometerFollowsTheActiveLineOrElasticity) {
  // Virgin compression of sand. Where 3 (1 - 2 nu)/(1 + nu) > M it flows from the start:
  // sigma_1 = (1 + 2 M/3)(-K ln J)/J, sigma_3 = (1 - M/3)(-K ln J)/J; E = 1e7, nu = 0.2, phi = 30
  // deg.
  const Params p = sand(30 * degree, Match::compression, 0, 0, 0.2);
  const double bulk = 1e7 / (3 * (1 - 2 * 0.2)), M = 1.2, J = 0.9;
  State s = strained(0, 0, 0);
  Sym3<double> tau{};
  const int steps = 1000;
  for (int n = 0; n < steps; ++n) tau = stretch(p, s, std::log(J) / steps, 0, 0);
  const double ratio = Law::volume_ratio(p, s);
  EXPECT_NEAR(ratio, J, 1e-12);
  const double pressure = -bulk * std::log(J) / J;
  EXPECT_NEAR(-tau.xx / ratio, (1 + 2 * M / 3) * pressure, 1e-9 * pressure);
  EXPECT_NEAR(-tau.yy / ratio, (1 - M / 3) * pressure, 1e-9 * pressure);
  EXPECT_NEAR(-tau.xx / ratio, 1170672.4, 0.05);  // published value, one decimal
  EXPECT_NEAR(-tau.yy / ratio, 390224.1, 0.05);
  // nu = 0.35 stays elastic: K0 = nu/(1 - nu).
  const Params elastic = sand(30 * degree, Match::compression, 0, 0, 0.35);
  State e = strained(0, 0, 0);
  tau = stretch(elastic, e, -0.01, 0, 0);
  EXPECT_NEAR(tau.yy / tau.xx, 0.35 / 0.65, 1e-12);
}

TEST(DruckerPragerTest, ZeroFrictionPointsToVonMises) {
  const auto found = findings<Law>({1e7, 0.3, 0, 1e4, 0, Match::compression}, 3);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].key, "friction_angle");
  EXPECT_NE(found[0].repair.find("von_mises"), std::string::npos);
}

TEST(DruckerPragerTest, DilationAboveFrictionIsRefused) {
  EXPECT_TRUE(findings<Law>({1e7, 0.3, 0.5, 0, 0.5, Match::compression}, 3).empty());
  const auto found = findings<Law>({1e7, 0.3, 0.5, 0, 0.51, Match::compression}, 3);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].key, "dilation_angle");
}

TEST(DruckerPragerTest, DefaultMatchDependsOnTheDimension) {
  Law::Input input{1e7, 0.3, 0.5, 0, 0, Match::by_dimension};
  const auto slope = [&](int dimension) {
    return cone_of(Law::params<double>(input, testing::density, dimension));
  };
  EXPECT_NEAR(slope(2), cone_slopes(Match::plane_strain, 0.5, 0).alpha, 1e-15);
  EXPECT_NEAR(slope(3), cone_slopes(Match::compression, 0.5, 0).alpha, 1e-15);
  for (const int dimension : {2, 3}) {
    SchemaContext context;
    context.dimension = dimension;
    Law::schema().reset(&input, context);
    EXPECT_EQ(input.match, dimension == 2 ? Match::plane_strain : Match::compression);
  }
}

}  // namespace
}  // namespace scree

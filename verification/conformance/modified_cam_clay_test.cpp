// SPDX-License-Identifier: Apache-2.0
// Modified Cam clay against the closed forms of critical state soil mechanics (Wood 1990): lines in
// v over ln p, undrained and drained triaxial tests, K0, flow rule.
#include "materials/modified_cam_clay.hpp"

#include <gtest/gtest.h>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using Law = ModifiedCamClay;
using Params = Law::Params<double>;
using State = Law::State<double>;
constexpr double kM = 1.2, kLambda = 0.2, kKappa = 0.05, kPoisson = 0.3, kN = 3.0;
constexpr double kShare = (kLambda - kKappa) / kLambda;  // Lambda of the closed forms

Law::Input keys(double pressure, double ocr) {
  return {kM, kLambda, kKappa, kPoisson, kN - 1, pressure, {}, ocr};
}

Params clay(double pressure, double ocr) {
  return Law::params<double>(keys(pressure, ocr), 1800, 3);
}

struct Stress {
  double axial, radial;  ///< Cauchy, compression positive [Pa]
  double p() const { return (axial + 2 * radial) / 3; }
  double q() const { return axial - radial; }
  double ratio() const { return q() / p(); }
};

/// A step of axial and radial logarithmic strain, compression positive.
Stress squeeze(const Params& p, State& s, double axial, double radial) {
  Mat3<double> L = zero3<double>();
  L(0, 0) = std::expm1(-axial);
  L(1, 1) = L(2, 2) = std::expm1(-radial);
  const Sym3<double> tau = Law::kirchhoff(p, s, L, 1.0);
  const double J = Law::volume_ratio(p, s);
  return {-tau.xx / J, -tau.yy / J};
}

Stress now(const Params& p, State s) { return squeeze(p, s, 0, 0); }
double volume(const Params& p, const State& s) { return 1 + Law::void_ratio(p, s); }

/// A drained triaxial step: the radial strain that keeps the cell pressure, by the secant method.
Stress drained(const Params& p, State& s, double axial, double cell) {
  double a = -0.3 * axial, b = -0.1 * axial;
  const auto excess = [&](double radial) {
    State trial = s;
    return squeeze(p, trial, axial, radial).radial - cell;
  };
  double fa = excess(a), fb = excess(b);
  for (int n = 0; n < 50 && std::abs(fb) > 1e-10 * cell; ++n) {
    const double c = b - fb * (b - a) / (fb - fa);
    a = b, fa = fb, b = c, fb = excess(c);
  }
  return squeeze(p, s, axial, b);
}

TEST(CamClayTest, StartsUnderItsPressureOnTheSwellingLine) {
  const Params p = clay(1e5, 4);
  const State s = Law::initial<double>(p);
  EXPECT_NEAR(now(p, s).axial, 1e5, 1e-9 * 1e5);
  EXPECT_NEAR(now(p, s).q(), 0, 1e-9 * 1e5);
  EXPECT_NEAR(volume(p, s), kN - kLambda * std::log(400) + kKappa * std::log(4), 1e-14);
  EXPECT_NEAR(volume(p, s), 1.871022, 1e-6);  // listed
  EXPECT_NEAR(volume(clay(2e5, 1), Law::initial<double>(clay(2e5, 1))), 1.94034, 1e-5);
}

TEST(CamClayTest, LinesInVolumeOverLogPressureAreExactForAnyStep) {
  for (const int steps : {3, 100}) {
    const Params p = clay(1e5, 2);
    State s = Law::initial<double>(p);
    const auto walk = [&](double strain) {
      const double v = volume(p, s), pressure = now(p, s).p();
      for (int n = 0; n < steps; ++n) squeeze(p, s, strain / steps, strain / steps);
      return -(volume(p, s) - v) / std::log(now(p, s).p() / pressure);
    };
    EXPECT_NEAR(walk(0.003), kKappa, 1e-11);  // reloading up to p = 1.4 initial
    squeeze(p, s, 0.02, 0.02);                // past preconsolidation
    EXPECT_NEAR(walk(0.06), kLambda, 1e-11);  // normal line
    EXPECT_NEAR(volume(p, s), kN - kLambda * std::log(now(p, s).p() / 1000), 1e-12);
    EXPECT_NEAR(walk(-0.03), kKappa, 1e-11);  // swelling
    EXPECT_NEAR(walk(0.03), kKappa, 1e-11);
  }
}

TEST(CamClayTest, UndrainedPathOfNormallyConsolidatedClay) {
  const double p0 = 2e5, step = 1e-4;
  const Params p = clay(p0, 1);
  State s = Law::initial<double>(p);
  Stress stress{};
  for (int n = 1; n <= 10000; ++n) {
    stress = squeeze(p, s, step, -step / 2);
    // p/p0 = (M^2/(M^2 + eta^2))^Lambda, exact whatever the steps.
    const double eta = stress.ratio();
    ASSERT_NEAR(stress.p() / p0, std::pow(kM * kM / (kM * kM + eta * eta), kShare), 1e-11);
    // Listed points, found by Runge-Kutta integration of the rates; 0.1 %: first order in 1e-4.
    const double listed[][3] = {
        {100, 177851, 87841}, {500, 123286, 140830}, {1000, 119112, 142628}};
    for (const auto& row : listed) {
      if (n != row[0]) continue;
      EXPECT_NEAR(stress.p() / row[1], 1, 1e-3);
      EXPECT_NEAR(stress.q() / row[2], 1, 1e-3);
    }
  }
  EXPECT_NEAR(stress.p(), p0 * std::pow(0.5, kShare), 1e-4 * p0);  // critical state
  EXPECT_NEAR(stress.p(), 118921, 30);
  EXPECT_NEAR(stress.q(), 142705, 30);
}

TEST(CamClayTest, UndrainedStrengthGrowsWithOverconsolidation) {
  for (const double ocr : {1.0, 1.5, 2.0, 4.0, 12.0}) {
    const double p0 = 1e5;
    const Params p = clay(p0, ocr);
    State s = Law::initial<double>(p);
    Stress stress{};
    double yielded_at = 0;
    for (int n = 0; n < 20000; ++n) {
      stress = squeeze(p, s, 1e-4, -5e-5);
      if (s.equivalent_plastic_strain == 0) {
        ASSERT_NEAR(stress.p(), p0, 1e-11 * p0) << "elastic shear must not change p";
        yielded_at = stress.q();
      }
    }
    const double failure = p0 * std::pow(ocr / 2, kShare);
    EXPECT_NEAR(stress.p() / failure, 1, 1e-3);
    EXPECT_NEAR(stress.q() / (kM * failure), 1, 1e-3);
    // Yield at q = M sqrt(p0 (pc - p0)), within a step of 3 G 1e-4.
    const double yield = kM * p0 * std::sqrt(ocr - 1);
    if (ocr > 1) {
      EXPECT_NEAR(yielded_at, yield, 0.01 * p0);
    }
  }
}

TEST(CamClayTest, DrainedTriaxialCompressionOfNormallyConsolidatedClay) {
  const double cell = 2e5, step = 1e-4;
  const Params p = clay(cell, 1);
  State s = Law::initial<double>(p);
  const double listed[][4] = {{100, 216880, 50640, 1.91859},
                              {500, 252277, 156832, 1.85825},
                              {1000, 278383, 235149, 1.81385},
                              {3000, 321986, 365957, 1.74906}};
  for (int n = 1; n <= 3000; ++n) {
    const Stress stress = drained(p, s, step, cell);
    ASSERT_NEAR(stress.radial, cell, 1e-8 * cell);
    for (const auto& row : listed) {
      if (n != row[0]) continue;
      EXPECT_NEAR(stress.p() / row[1], 1, 1e-3);  // first order in steps of 1e-4
      EXPECT_NEAR(stress.q() / row[2], 1, 2e-3);
      EXPECT_NEAR(volume(p, s), row[3], 2e-4);
    }
  }
}

TEST(CamClayTest, DrainedCriticalStates) {
  for (const double ocr : {1.0, 4.0}) {
    const double cell = ocr == 1 ? 2e5 : 1e5;
    const Params p = clay(cell, ocr);
    State s = Law::initial<double>(p);
    Stress stress{};
    double peak = 0;
    for (int n = 0; n < 12000; ++n) {
      stress = drained(p, s, 2e-4, cell);
      peak = std::max(peak, stress.q());
    }
    const double failure = 3 * cell / (3 - kM);
    EXPECT_NEAR(stress.p() / failure, 1, 1e-3);
    EXPECT_NEAR(stress.q() / (kM * failure), 1, 1e-3);
    // v on the critical state line, Gamma = N - (lambda - kappa) ln 2: listed 1.734199, 1.872829.
    const double line =
        kN - (kLambda - kKappa) * std::log(2.0) - kLambda * std::log(failure / 1000);
    EXPECT_NEAR(line, ocr == 1 ? 1.734199 : 1.872829, 1e-6);
    EXPECT_NEAR(volume(p, s), line, 5e-4);
    if (ocr > 1) {
      EXPECT_NEAR(peak, 238750, 1500);  // listed; a step of 2e-4 is 0.5 % of q at the elastic slope
    }
  }
}

// The stress ratio of normally consolidated clay in an oedometer solves eta (1 + nu)(1 - L)/(3 (1 -
// 2 nu)) + 3 eta L/(M^2 - eta^2) = 1; K0 = (3 - eta)/(3 + 2 eta).
TEST(CamClayTest, EarthPressureAtRest) {
  double low = 1e-9, high = kM - 1e-9;
  for (int n = 0; n < 200; ++n) {
    const double eta = 0.5 * (low + high);
    const double left = eta * (1 + kPoisson) * (1 - kShare) / (3 * (1 - 2 * kPoisson)) +
                        3 * eta * kShare / (kM * kM - eta * eta);
    (left > 1 ? high : low) = eta;
  }
  EXPECT_NEAR(low, 0.471887, 1e-6);
  EXPECT_NEAR(Law::rest_ratio(keys(2e4, 1)), (3 - low) / (3 + 2 * low), 1e-12);
  const auto error = [&](double step) {
    const Params p = clay(2e4, 1);
    State s = Law::initial<double>(p);
    Stress stress{};
    for (double strain = 0; strain < 0.6; strain += step) stress = squeeze(p, s, step, 0);
    return stress.radial / stress.axial - (3 - low) / (3 + 2 * low);
  };
  EXPECT_NEAR(error(1e-4), 0, 1e-3);
  EXPECT_NEAR(error(4e-4) / error(2e-4), 2, 0.1) << "of first order in the step";
}

// A state under given stresses: on the swelling line of pc = ocr (p + q^2/(M^2 p)), whatever the
// pressure of the keys.
TEST(CamClayTest, GroundHasItsOcrAtEveryDepth) {
  for (const double ocr : {1.0, 1.5, 8.0}) {
    for (const double depth : {0.1, 5.0, 80.0}) {
      const double axial = 9e3 * depth, radial = 0.7 * axial;
      const double p = (axial + 2 * radial) / 3, q = axial - radial;
      const double pc = ocr * (p + q * q / (kM * kM * p));
      const double v = kN - kLambda * std::log(pc / 1e3) + kKappa * std::log(pc / p);
      for (const double keyed : {1e3, 2e5}) {
        const Params params = clay(keyed, ocr);
        const auto s = Law::state_under(keys(keyed, ocr), {-axial, -radial, -radial});
        ASSERT_TRUE(s.has_value());
        const Stress stress = now(params, *s);
        EXPECT_NEAR(stress.axial / axial, 1, 1e-12);
        EXPECT_NEAR(stress.radial / radial, 1, 1e-12);
        EXPECT_NEAR(volume(params, *s), v, 1e-13);
        EXPECT_NEAR(params.preconsolidation * std::exp(s->log_preconsolidation) / pc, 1, 1e-13);
        EXPECT_EQ(Law::volume_ratio(params, *s), 1) << "volume counts from there";
        // f/(M pc)^2 = (p/pc)^2 (1 - ocr) (1 + q^2/(M p)^2)
        const double inside = (1 - ocr) * (p / pc) * (p / pc) * (1 + q * q / (kM * kM * p * p));
        EXPECT_NEAR(Law::yield_value(params, *s), inside, 1e-12);
      }
    }
  }
}

// Normally consolidated ground of one depth is that of another, compressed: the same K0 and void
// ratio. The steps' error is that of EarthPressureAtRest.
TEST(CamClayTest, GroundBuriedDeeperIsGroundOfThatDepth) {
  const Law::Input in = keys(1e5, 1);
  const Params p = clay(1e5, 1);
  const double k0 = Law::rest_ratio(in);
  State s = *Law::state_under(in, {-1e4, -k0 * 1e4, -k0 * 1e4});
  Stress stress = now(p, s);
  while (stress.axial < 2e5) stress = squeeze(p, s, 1e-4, 0);
  EXPECT_NEAR(stress.radial / stress.axial, k0, 1e-3);
  const auto deep = Law::state_under(in, {-stress.axial, -stress.radial, -stress.radial});
  EXPECT_NEAR(volume(p, s), volume(p, *deep), 1e-10) << "both are on the yield surface";
}

TEST(CamClayTest, GroundThatCannotBe) {
  Law::Input in = keys(1e5, 2);
  EXPECT_FALSE(Law::state_under(in, {0, 0, 0})) << "no pressure";
  EXPECT_FALSE(Law::state_under(in, {1e4, 1e4, 1e4})) << "tension";
  // N = 3 at 1 kPa: no voids at v = 3 - lambda ln pc + kappa ln 2 = 1, pc in kPa.
  const double pressure = 1e3 * std::exp((2 + kKappa * std::log(2)) / kLambda) / 2;
  EXPECT_TRUE(Law::state_under(in, {-0.99 * pressure, -0.99 * pressure, -0.99 * pressure}));
  EXPECT_FALSE(Law::state_under(in, {-1.01 * pressure, -1.01 * pressure, -1.01 * pressure}));
  in.ocr.reset();
  in.preconsolidation_pressure = 2e5;  // fixed: the surface stays where it is
  EXPECT_TRUE(Law::state_under(in, {-1.999e5, -1.999e5, -1.999e5}));
  EXPECT_FALSE(Law::state_under(in, {-2.001e5, -2.001e5, -2.001e5}));
}

// Implicit and associated: at the end of a plastic step the increments obey deps_v/deps_q = (M^2 -
// eta^2)/(2 eta), and the state lies on the yield surface.
TEST(CamClayTest, ReturnObeysYieldSurfaceFlowRuleAndHardening) {
  testing::MatrixSource source(65);
  int flowing = 0;
  for (int n = 0; n < 20000; ++n) {
    const Params p = clay(1e5, std::pow(10, source.uniform(0, 1.5)));
    State s = Law::initial<double>(p);
    const double size = std::pow(10, source.uniform(-4, -0.7));
    const Stress stress = squeeze(p, s, source.uniform(-size, size), source.uniform(-size, size));
    if (s.equivalent_plastic_strain == 0) continue;
    ++flowing;
    const double f = Law::yield_value(p, s);
    ASSERT_NEAR(f, 0, 1e-11);
    const double v = volume(p, s), eta = std::abs(stress.ratio());
    const double volumetric = (kLambda - kKappa) * s.log_preconsolidation / v;
    const double left = volumetric * 2 * eta,
                 right = s.equivalent_plastic_strain * (kM * kM - eta * eta);
    ASSERT_NEAR(left, right, 1e-9 * (std::abs(left) + std::abs(right)) + 1e-15);
  }
  EXPECT_GT(flowing, 3000);
}

TEST(CamClayTest, ElasticStepsAreReversible) {
  testing::MatrixSource source(66);
  const Params p = clay(1e5, 20);
  for (int n = 0; n < 100; ++n) {
    State s = Law::initial<double>(p);
    const double a = source.uniform(-0.005, 0.005), r = source.uniform(-0.005, 0.005);
    squeeze(p, s, a, r);
    ASSERT_EQ(s.equivalent_plastic_strain, 0);
    squeeze(p, s, -a, -r);
    ASSERT_NEAR(norm(s.normalized_deviator), 0, 1e-16);
    ASSERT_NEAR(s.log_volume_ratio, 0, 1e-17);
  }
}

TEST(CamClayTest, RotationTurnsTheStress) {
  testing::MatrixSource source(67);
  const Params p = clay(1e5, 4);
  for (int n = 0; n < 50; ++n) {
    State s = Law::initial<double>(p);
    Law::kirchhoff(p, s, testing::from_eigen<double>(source.entries(5e-3)), 1.0);
    const Eigen::Matrix3d q = source.rotation();
    const Eigen::Matrix3d before = testing::to_eigen(Law::kirchhoff(p, s, zero3<double>(), 0.0));
    const auto L = testing::from_eigen<double>(q - Eigen::Matrix3d::Identity());
    const Eigen::Matrix3d after = testing::to_eigen(Law::kirchhoff(p, s, L, 1.0));
    ASSERT_LE((after - q * before * q.transpose()).norm(), 1e-12 * before.norm());
  }
}

TEST(CamClayTest, SmallStepsAccumulateInSinglePrecision) {
  const Law::Input in{kM, kLambda, kKappa, kPoisson, kN - 1, 1e5, {}, 4.0};
  const auto p = Law::params<float>(in, 1800, 3);
  auto s = Law::initial<float>(p);
  Mat3<float> L = zero3<float>();
  const float step = 1e-9f;  // far below the resolution of v
  L(0, 0) = -step;
  Sym3<float> tau{};
  const int steps = 100000;
  for (int n = 0; n < steps; ++n) tau = Law::kirchhoff(p, s, L, 1.0f);
  const double v = kN - kLambda * std::log(400.0) + kKappa * std::log(4.0), strain = steps * 1e-9;
  const double pressure = -trace(tau) / 3 * std::exp(strain);
  // 1e5 roundings of 4e-12 in an increment of 1e-9; p itself to 1e-7.
  EXPECT_NEAR(std::log(pressure / 1e5) / (v * strain / kKappa), 1, 5e-3);
}

TEST(CamClayTest, ImpossibleSoilIsRefused) {
  const auto schema = Law::schema();
  const auto key_of_error = [&](const Law::Input& in) -> std::string {
    for (const auto& check : schema.checks()) {
      if (const auto finding = check.test(&in, SchemaContext{})) return finding->key;
    }
    return "";
  };
  EXPECT_EQ(key_of_error({1.2, 0.2, 0.05, 0.3, 2, 1e5, 2e5, {}}), "");
  EXPECT_EQ(key_of_error({1.2, 0.2, 0.05, 0.3, 2, 1e5, {}, 1.0}), "");
  EXPECT_EQ(key_of_error({1.2, 0.05, 0.05, 0.3, 2, 1e5, 2e5, {}}), "lambda");
  EXPECT_EQ(key_of_error({1.2, 0.2, 0.05, 0.3, 2, 3e5, 2e5, {}}), "initial_pressure");
  EXPECT_EQ(key_of_error({1.2, 0.2, 0.05, 0.3, 2, 1e5, {}, {}}), "preconsolidation_pressure");
  EXPECT_EQ(key_of_error({1.2, 0.2, 0.05, 0.3, 2, 1e5, 2e5, 2.0}), "preconsolidation_pressure");
  EXPECT_EQ(key_of_error({1.2, 0.2, 0.05, 0.3, 1, 1e5, 1e6, {}}), "reference_void_ratio");
}

}  // namespace
}  // namespace scree

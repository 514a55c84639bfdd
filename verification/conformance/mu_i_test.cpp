// SPDX-License-Identifier: Apache-2.0
// mu(I) against Jop, Forterre, Pouliquen 2006: steady shear, the return's quadratic, separation.
#include "materials/mu_i.hpp"

#include <gtest/gtest.h>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using Law = MuI;
constexpr double degree = 3.14159265358979323846 / 180;
constexpr double kYoung = 1e7, kPoisson = 0.3, kDensity = 1500;
constexpr double kBulk = kYoung / (3 * (1 - 2 * kPoisson)), kShear = kYoung / (2 * (1 + kPoisson));
const double kSlow = std::tan(20.9 * degree), kFast = std::tan(32.76 * degree);
constexpr double kI0 = 0.279, kGrain = 1e-3, kGrainDensity = 2500;  // glass beads of Jop et al.

Law::Params<double> beads(double slow = kSlow, double fast = kFast) {
  return Law::params<double>({kYoung, kPoisson, slow, fast, kI0, kGrain, kGrainDensity}, kDensity,
                             3);
}

double friction(double inertial) { return kSlow + (kFast - kSlow) / (1 + kI0 / inertial); }
double shear_of(const Sym3<double>& tau) { return norm(deviator(tau)) / std::sqrt(2.0); }
double pressure_of(const Sym3<double>& tau) { return -trace(tau) / 3; }
double inertial_of(double rate, double pressure) {
  return rate * kGrain / std::sqrt(pressure / kGrainDensity);
}

/// Grains under the pressure p.
Law::State<double> pressed(const Law::Params<double>& p, double pressure) {
  auto state = Law::initial<double>(p);
  Mat3<double> L = zero3<double>();
  for (int i = 0; i < 3; ++i) L(i, i) = std::expm1(-pressure / (3 * kBulk));
  Law::kirchhoff(p, state, L, 1.0);
  return state;
}

/// Simple shear at the rate g until the flow is steady: some hundred elastic strains tau/mu.
Sym3<double> shear_steadily(const Law::Params<double>& p, Law::State<double>& state, double rate,
                            double strain_step = 1e-5) {
  Mat3<double> L = zero3<double>();
  L(0, 1) = strain_step;
  Sym3<double> tau{};
  for (int n = 0; n < 5000; ++n) tau = Law::kirchhoff(p, state, L, strain_step / rate);
  return tau;
}

TEST(MuITest, SteadyShearFollowsTheFrictionLaw) {
  const double pressure = 1000;
  for (const double rate : {1e-3, 1.0, 30.0, 1e3}) {
    const auto p = beads();
    auto state = pressed(p, pressure);
    const Sym3<double> tau = shear_steadily(p, state, rate);
    EXPECT_NEAR(pressure_of(tau), pressure, 1e-9 * pressure) << "flow keeps the volume";
    // Steady: all of the rate is plastic, but for the turning of the elastic strain tau/mu = 1e-4.
    EXPECT_NEAR(state.plastic_shear_rate, rate, 2e-4 * rate);
    const double inertial = inertial_of(state.plastic_shear_rate, pressure);
    EXPECT_NEAR(shear_of(tau) / pressure, friction(inertial), 1e-9);
    EXPECT_NEAR(std::sqrt(1.5) * norm(deviator(tau)), std::sqrt(3.0) * shear_of(tau), 1e-9);
  }
}

// Down a rough plane of angle t the stress ratio is tan t at every depth; Bagnold's profile has the
// inertial number I0 (tan t - mu_s)/(mu_2 - tan t).
TEST(MuITest, ListedInertialNumbersOfBagnoldFlow) {
  const double listed[][2] = {{24, 0.089180}, {26, 0.189665}};
  for (const auto& [angle, inertial] : listed) {
    const double slope = std::tan(angle * degree), pressure = 500;
    EXPECT_NEAR(kI0 * (slope - kSlow) / (kFast - slope), inertial, 1e-6);
    const auto p = beads();
    auto state = pressed(p, pressure);
    const double rate = inertial * std::sqrt(pressure / kGrainDensity) / kGrain;
    const Sym3<double> tau = shear_steadily(p, state, rate);
    EXPECT_NEAR(tau.xy / -tau.yy, slope, 2e-4);  // normal stresses differ by tau^2/mu
    EXPECT_NEAR(shear_of(tau) / pressure, slope, 1e-5);
  }
}

TEST(MuITest, ReturnSolvesTheRateEquationOfOneStep) {
  testing::MatrixSource source(64);
  for (int n = 0; n < 2000; ++n) {
    const auto p = beads();
    const double pressure = std::pow(10, source.uniform(1, 6));
    const double trial = pressure * source.uniform(0, 3), dt = std::pow(10, source.uniform(-7, 0));
    auto state = pressed(p, pressure);
    Mat3<double> L = zero3<double>();  // pure shear in principal axes, at constant volume
    const double strain = trial / (2 * kShear);
    L(0, 0) = std::expm1(strain);
    L(1, 1) = std::expm1(-strain);
    const Sym3<double> tau = Law::kirchhoff(p, state, L, dt);
    // tau = trial - mu dt g, tau = mu(I(g)) p: the difference falls with tau, so bisection finds
    // it.
    double low = std::min(kSlow * pressure, trial), high = trial;
    for (int k = 0; k < 200; ++k) {
      const double t = 0.5 * (low + high), rate = (trial - t) / (kShear * dt);
      const double inertial = std::max(inertial_of(rate, pressure), 1e-300);
      (t > friction(inertial) * pressure ? high : low) = t;
    }
    ASSERT_NEAR(shear_of(tau), high, 1e-9 * (pressure + trial));
    ASSERT_NEAR(state.plastic_shear_rate * kShear * dt, trial - high, 1e-9 * (pressure + trial));
    ASSERT_NEAR(pressure_of(tau), pressure, 1e-12 * (kBulk + pressure));
  }
}

TEST(MuITest, LimitsOfSlowAndFastFlow) {
  const double pressure = 1e4;
  const auto p = beads();
  auto slow = pressed(p, pressure), fast = slow;
  EXPECT_NEAR(shear_of(shear_steadily(p, slow, 1e-8)) / pressure, kSlow, 1e-6);
  EXPECT_NEAR(shear_of(shear_steadily(p, fast, 1e9, 1e-4)) / pressure, kFast, 1e-6);
  EXPECT_LE(Law::yield_value(p, fast), 1e-14);
}

TEST(MuITest, EqualCoefficientsAreCoulombFrictionWithoutRate) {
  const auto p = beads(0.5, 0.5);
  for (const double dt : {1e-9, 1e-3, 1e6}) {
    auto state = pressed(p, 2e4);
    Mat3<double> L = zero3<double>();
    L(0, 1) = 0.02;
    const Sym3<double> tau = Law::kirchhoff(p, state, L, dt);
    EXPECT_NEAR(shear_of(tau) / pressure_of(tau), 0.5, 1e-12);
  }
}

TEST(MuITest, BelowStaticFrictionNothingFlows) {
  const auto p = beads();
  auto state = pressed(p, 1e4);
  Mat3<double> L = zero3<double>();
  L(0, 1) = 0.99 * kSlow * 1e4 / kShear;
  const Sym3<double> tau = Law::kirchhoff(p, state, L, 1e3);
  EXPECT_EQ(state.plastic_shear_rate, 0);
  EXPECT_NEAR(shear_of(tau), 0.99 * kSlow * 1e4, 1e-2 * kSlow * 1e4);
}

TEST(MuITest, SeparatedGrainsAreFreeOfStressUntilTheyTouchAgain) {
  const auto p = beads();
  auto state = Law::initial<double>(p);
  const auto stretch = [&](double strain) {
    Mat3<double> L = zero3<double>();
    for (int i = 0; i < 3; ++i) L(i, i) = std::expm1(strain);
    return Law::kirchhoff(p, state, L, 1e-3);
  };
  EXPECT_NEAR(norm(stretch(0.02)), 0, 1e-14 * kYoung);
  EXPECT_NEAR(state.volume_correction, 0.06, 1e-15);
  EXPECT_NEAR(norm(stretch(-0.01)), 0, 1e-14 * kYoung);
  EXPECT_NEAR(pressure_of(stretch(-0.011)), 3 * kBulk * 0.001, 1e-12 * kBulk);
  EXPECT_NEAR(state.log_volume_ratio, -0.003, 1e-15);
}

TEST(MuITest, SolidFractionIsDensityOverGrainDensity) {
  const auto p = beads();
  auto state = Law::initial<double>(p);
  const double fraction = kDensity / kGrainDensity;
  EXPECT_NEAR(1 / (1 + Law::void_ratio(p, state)), fraction, 1e-15);
  state.log_volume_ratio = std::log(1.2);
  EXPECT_NEAR(1 / (1 + Law::void_ratio(p, state)), fraction / 1.2, 1e-15);
}

TEST(MuITest, FrictionThatFallsWithTheRateIsRefused) {
  const auto schema = Law::schema();
  const Law::Input good{kYoung, kPoisson, 0.4, 0.6, kI0, kGrain, kGrainDensity};
  const Law::Input bad{kYoung, kPoisson, 0.6, 0.4, kI0, kGrain, kGrainDensity};
  for (const auto& check : schema.checks()) {
    EXPECT_FALSE(check.test(&good, SchemaContext{}));
    const auto finding = check.test(&bad, SchemaContext{});
    ASSERT_TRUE(finding);
    EXPECT_EQ(finding->key, "mu_2");
  }
}

}  // namespace
}  // namespace scree

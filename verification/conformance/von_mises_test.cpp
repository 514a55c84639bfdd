// SPDX-License-Identifier: Apache-2.0
// Hencky elasticity and von Mises plasticity against closed forms.
#include <gtest/gtest.h>

#include "verification/conformance/principal_paths.hpp"
#include "verification/conformance/samples/hencky.hpp"
#include "verification/conformance/samples/von_mises.hpp"

namespace scree {
namespace {

using testing::mean_pressure;
using testing::shear_stress;
using testing::stretch;
using Law = VonMises;
using State = Law::State<double>;

constexpr double kYoung = 2e8, kPoisson = 0.3, kYield = 1e6;
constexpr double kBulk = kYoung / (3 * (1 - 2 * kPoisson));
constexpr double kShear = kYoung / (2 * (1 + kPoisson));

Law::Params<double> metal(double hardening = 0) {
  return Law::params<double>({kYoung, kPoisson, kYield, hardening}, testing::density, 3);
}

TEST(HenckyTest, StressAndEnergyOfTheLogarithmicStrain) {
  const auto p = Hencky::params<double>({kYoung, kPoisson}, testing::density, 3);
  const double lambda = kBulk - 2 * kShear / 3;
  auto s = Hencky::initial<double>(p);
  const auto tau = stretch<Hencky>(p, s, 0.5, -1.0, 0.2);
  const double volume = -0.3;
  EXPECT_NEAR(tau.xx, 2 * kShear * 0.5 + lambda * volume, 1e-13 * kYoung);
  EXPECT_NEAR(tau.yy, 2 * kShear * -1.0 + lambda * volume, 1e-13 * kYoung);
  EXPECT_NEAR(tau.zz, 2 * kShear * 0.2 + lambda * volume, 1e-13 * kYoung);
  EXPECT_NEAR(Hencky::energy_density(p, s),
              kShear * (0.25 + 1 + 0.04) + lambda / 2 * volume * volume, 1e-13 * kYoung);
  EXPECT_NEAR(Hencky::volume_ratio(p, s), std::exp(volume), 1e-14);
  // Uniaxial strain: P_11 = (lambda + 2 mu) ln(s)/s.
  auto u = Hencky::initial<double>(p);
  EXPECT_NEAR(stretch<Hencky>(p, u, std::log(0.6), 0, 0).xx, (lambda + 2 * kShear) * std::log(0.6),
              1e-13 * kYoung);
}

TEST(HenckyTest, ClosedPathEndsStressFree) {
  const auto p = Hencky::params<double>({kYoung, kPoisson}, testing::density, 3);
  auto s = Hencky::initial<double>(p);
  testing::MatrixSource source(61);
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  for (int n = 0; n < 20; ++n) {
    const Eigen::Matrix3d L = source.entries(0.1);
    f = (Eigen::Matrix3d::Identity() + L) * f;
    Hencky::kirchhoff(p, s, testing::from_eigen<double>(L), 1e-3);
  }
  const Eigen::Matrix3d back = f.inverse() - Eigen::Matrix3d::Identity();
  const auto tau = Hencky::kirchhoff(p, s, testing::from_eigen<double>(back), 1e-3);
  EXPECT_LE(norm(tau), 1e-12 * kYoung);
  EXPECT_NEAR(Hencky::volume_ratio(p, s), 1, 1e-12);
}

TEST(VonMisesTest, UniaxialStrainYieldsAtTheElasticLimit) {
  // Hugoniot elastic limit Y (1 - nu)/(1 - 2 nu), then slope K: sigma_1 = K e + 2 Y/3. E = 200 MPa,
  // nu = 0.3, Y = 1 MPa: 1.75 MPa; at e = 0.02 4.0 MPa and laterally 3.0.
  const auto p = metal();
  const double limit = kYield * (1 - kPoisson) / (1 - 2 * kPoisson);
  const double first = kYield / (2 * kShear);  // strain at the limit
  EXPECT_NEAR(limit, 1.75e6, 1e-6);
  State s = Law::initial<double>(p);
  EXPECT_NEAR(-stretch<Law>(p, s, -first * (1 - 1e-9), 0, 0).xx, limit, 2e-9 * limit);
  EXPECT_EQ(s.equivalent_plastic_strain, 0);
  const auto tau = stretch<Law>(p, s, -(0.02 - first * (1 - 1e-9)), 0, 0);
  EXPECT_NEAR(-tau.xx, kBulk * 0.02 + 2 * kYield / 3, 1e-10 * kYield);
  EXPECT_NEAR(-tau.xx, 4.0e6, 1e-3);
  EXPECT_NEAR(-tau.yy, 3.0e6, 1e-3);
  // Plastic strain: the deviator of strain less that of stress.
  EXPECT_NEAR(s.equivalent_plastic_strain, 2.0 / 3.0 * (0.02 - first), 1e-14);
  EXPECT_NEAR(s.log_volume_ratio, -0.02, 1e-15);
}

TEST(VonMisesTest, SimpleShear) {
  const auto p = metal();
  State s = Law::initial<double>(p);
  Sym3<double> tau{};
  Mat3<double> L = zero3<double>();
  L(0, 1) = 1e-4;
  for (int n = 0; n < 200; ++n) tau = Law::kirchhoff(p, s, L, 1e-3);
  // Strains of Y/(2 G) = 7e-3 turn the principal axes: an error of second order.
  EXPECT_NEAR(tau.xy, kYield / std::sqrt(3.0), 1e-4 * kYield);
  EXPECT_NEAR(tau.xy, 577350.27, 1e-4 * kYield);
  EXPECT_NEAR(shear_stress(tau), kYield, 1e-10 * kYield);
  EXPECT_NEAR(std::log(det(s.F)), 0, 1e-14);
}

TEST(VonMisesTest, RadialReturnWithHardening) {
  const double hardening = 3e6;
  const auto p = metal(hardening);
  State s = Law::initial<double>(p);
  const auto tau = stretch<Law>(p, s, 0.03, -0.01, -0.008);
  const Eigen::Vector3d e(0.03, -0.01, -0.008), deviator = e.array() - e.mean();
  const double trial = 2 * kShear * std::sqrt(1.5) * deviator.norm();
  const double plastic = (trial - kYield) / (3 * kShear + hardening);
  EXPECT_NEAR(s.equivalent_plastic_strain, plastic, 1e-15);
  EXPECT_NEAR(shear_stress(tau), kYield + hardening * plastic, 1e-10 * kYield);
  EXPECT_NEAR(mean_pressure(tau), -kBulk * e.sum(), 1e-10 * kYield);
  // The deviator keeps its direction; a second, empty step changes nothing.
  EXPECT_NEAR((tau.xx - tau.yy) / (tau.yy - tau.zz), (e[0] - e[1]) / (e[1] - e[2]), 1e-10);
  const State before = s;
  const auto again = Law::kirchhoff(p, s, zero3<double>(), 0.0);
  EXPECT_LE(norm(again - tau), 1e-13 * kYoung);
  EXPECT_NEAR(s.equivalent_plastic_strain, before.equivalent_plastic_strain, 1e-15);
  EXPECT_NEAR(Law::yield_value(p, s), 0, 1e-15);
}

TEST(VonMisesTest, UniaxialTensionHardensWithTheTangentOfTheDeck) {
  // In uniaxial stress d tau/d(plastic strain) = H.
  const double hardening = 5e6;
  const auto p = metal(hardening);
  State s = Law::initial<double>(p);
  Sym3<double> tau{};
  for (int n = 0; n < 100; ++n) {
    const double x = testing::solve(-3e-5, -5e-5, kYield, [&](double y) {
      State trial = s;
      return stretch<Law>(p, trial, 1e-4, y, y).yy;
    });
    tau = stretch<Law>(p, s, 1e-4, x, x);
  }
  EXPECT_GT(s.equivalent_plastic_strain, 4e-3);
  EXPECT_NEAR(tau.xx, kYield + hardening * s.equivalent_plastic_strain, 1e-9 * kYield);
  EXPECT_NEAR(s.equivalent_plastic_strain, 0.01 - tau.xx / kYoung, 1e-12);
}

}  // namespace
}  // namespace scree

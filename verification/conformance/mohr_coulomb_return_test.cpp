// SPDX-License-Identifier: Apache-2.0
// The return to the Mohr-Coulomb pyramid against a slow search over all sets of active planes.
#include <gtest/gtest.h>

#include "verification/conformance/principal_paths.hpp"
#include "verification/conformance/samples/mohr_coulomb.hpp"

namespace scree {
namespace {

using testing::degree;
using testing::MatrixSource;
using Law = MohrCoulomb;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Plane {
  Vector3d normal, flow;
  double limit;  ///< normal . t <= limit
};

/// The pyramid's six planes and the three of the cut-off, for stresses in any order.
std::vector<Plane> planes_of(const Law::Input& in) {
  std::vector<Plane> planes;
  const double f = std::sin(in.friction_angle), d = std::sin(in.dilation_angle);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      Vector3d normal = Vector3d::Zero(), flow = Vector3d::Zero();
      normal[i] = 1 + f;
      normal[j] = -(1 - f);
      flow[i] = 1 + d;
      flow[j] = -(1 - d);
      planes.push_back({normal, flow, 2 * in.cohesion * std::cos(in.friction_angle)});
    }
    if (!std::isnan(in.tension_cutoff)) {
      planes.push_back({Vector3d::Unit(i), Vector3d::Unit(i), in.tension_cutoff});
    }
  }
  return planes;
}

/// Koiter's conditions for one set of active planes: stress on them, non-negative flow on each,
/// inside all others. True and the stress if they hold.
bool koiter(const std::vector<Plane>& planes, const Matrix3d& stiffness, const Vector3d& trial,
            const std::vector<std::size_t>& active, double tolerance, Vector3d& stress) {
  // Unit rows and columns fill the system up to three.
  Matrix3d system = Matrix3d::Identity();
  Vector3d excess = Vector3d::Zero();
  for (std::size_t i = 0; i < active.size(); ++i) {
    const Plane& a = planes[active[i]];
    excess[int(i)] = a.normal.dot(trial) - a.limit;
    for (std::size_t j = 0; j < active.size(); ++j) {
      system(int(i), int(j)) = a.normal.dot(stiffness * planes[active[j]].flow) / stiffness(0, 0);
    }
  }
  if (std::abs(system.determinant()) < 1e-12) return false;
  const Vector3d flow = system.inverse() * excess / stiffness(0, 0);
  stress = trial;
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (flow[int(i)] < 0) return false;
    stress -= flow[int(i)] * (stiffness * planes[active[i]].flow);
  }
  for (const Plane& plane : planes) {
    if (plane.normal.dot(stress) > plane.limit + tolerance) return false;
  }
  return true;
}

/// All stresses that fulfil Koiter's conditions with up to three active planes; without any, the
/// apex (flow that is not associated leaves a gap there).
std::vector<Vector3d> search(const Law::Input& in, const Vector3d& trial, double tolerance) {
  const auto planes = planes_of(in);
  const LameConstants lame = lame_constants(in.youngs_modulus, in.poissons_ratio);
  const Matrix3d stiffness = 2 * lame.mu * Matrix3d::Identity() + lame.lambda * Matrix3d::Ones();
  std::vector<Vector3d> found;
  const std::size_t n = planes.size();
  Vector3d stress;
  const auto attempt = [&](const std::vector<std::size_t>& active) {
    if (koiter(planes, stiffness, trial, active, tolerance, stress)) found.push_back(stress);
  };
  attempt({});
  for (std::size_t i = 0; i < n; ++i) {
    attempt({i});
    for (std::size_t j = i + 1; j < n; ++j) {
      attempt({i, j});
      for (std::size_t k = j + 1; k < n; ++k) attempt({i, j, k});
    }
  }
  if (found.empty()) found.push_back(in.cohesion / std::tan(in.friction_angle) * Vector3d::Ones());
  return found;
}

/// Strains around the pyramid's size, some with equal components.
Vector3d some_strain(MatrixSource& source, double size) {
  Vector3d e(source.uniform(-1, 1), source.uniform(-1, 1), source.uniform(-1, 1));
  const double kind = source.uniform(0, 1);
  if (kind < 0.1) e[1] = e[0];
  if (kind < 0.02) e[2] = e[0];
  if (kind > 0.9) e *= 0.01;
  return size * (e.array() + source.uniform(-1, 0.5));
}

/// How far the law's return lies from the nearest solution of the search, at worst, in units of the
/// trial stress.
double worst_return(const Law::Input& in, int count) {
  MatrixSource source(71);
  const auto p = Law::params<double>(in, testing::density, 3);
  double worst = 0;
  for (int n = 0; n < count; ++n) {
    const Vector3d e = some_strain(source, 0.02);
    const Vector3d trial = 2 * p.mu * e.array() + p.lambda * e.sum();
    auto state = Law::initial<double>(p);
    const auto tau = testing::stretch<Law>(p, state, e[0], e[1], e[2]);
    const double scale = trial.norm() + in.cohesion;
    double nearest = 1e300;
    for (const Vector3d& stress : search(in, trial, 1e-10 * scale)) {
      nearest = std::min(nearest, (Vector3d(tau.xx, tau.yy, tau.zz) - stress).norm() / scale);
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

// Tolerance of all: roundings of exp and log of the strains (1e-16 against strains of 1e-4 and
// more), and of the search's systems, whose condition is below 1e3.
constexpr double kTolerance = 1e-9;

TEST(MohrCoulombReturnTest, AssociatedFlowFindsTheClosestPoint) {
  EXPECT_LE(worst_return({1e7, 0.3, 30 * degree, 2e4, 30 * degree}, 4000), kTolerance);
  EXPECT_LE(worst_return({1e7, 0.0, 40 * degree, 1e4, 40 * degree}, 4000), kTolerance);
  EXPECT_LE(worst_return({1e7, -0.3, 25 * degree, 1e4, 25 * degree}, 4000), kTolerance);
  EXPECT_LE(worst_return({1e7, 0.45, 20 * degree, 0, 20 * degree}, 4000), kTolerance);
}

TEST(MohrCoulombReturnTest, DilationBelowFriction) {
  EXPECT_LE(worst_return({1e7, 0.3, 30 * degree, 2e4, 0}, 4000), kTolerance);
  EXPECT_LE(worst_return({1e7, 0.2, 45 * degree, 1e4, 10 * degree}, 4000), kTolerance);
  EXPECT_LE(worst_return({1e7, -0.2, 35 * degree, 1e3, 5 * degree}, 4000), kTolerance);
}

TEST(MohrCoulombReturnTest, FrictionlessIsTresca) {
  EXPECT_LE(worst_return({1e7, 0.3, 0, 3e4, 0}, 4000), kTolerance);
  EXPECT_LE(worst_return({1e7, 0.49, 0, 1e4, 0, 2e4}, 4000), kTolerance);
}

TEST(MohrCoulombReturnTest, TensionCutoff) {
  for (const double cut : {0.0, 5e3, 2e4, 3.4e4}) {
    EXPECT_LE(worst_return({1e7, 0.3, 30 * degree, 2e4, 30 * degree, cut}, 3000), kTolerance)
        << cut;
    EXPECT_LE(worst_return({1e7, 0.1, 30 * degree, 2e4, 10 * degree, cut}, 3000), kTolerance)
        << cut;
    EXPECT_LE(worst_return({1e7, -0.3, 30 * degree, 2e4, 0, cut}, 3000), kTolerance) << cut;
  }
}

TEST(MohrCoulombReturnTest, CutoffBeyondTheApexCutsNothing) {
  const Law::Input with{1e7, 0.3, 30 * degree, 2e4, 10 * degree, 4e4};
  const Law::Input without{1e7, 0.3, 30 * degree, 2e4, 10 * degree, kNone};
  MatrixSource source(72);
  const auto a = Law::params<double>(with, testing::density, 3);
  const auto b = Law::params<double>(without, testing::density, 3);
  for (int n = 0; n < 2000; ++n) {
    const Vector3d e = some_strain(source, 0.02);
    auto s = Law::initial<double>(a), t = s;
    const auto x = testing::stretch<Law>(a, s, e[0], e[1], e[2]);
    const auto y = testing::stretch<Law>(b, t, e[0], e[1], e[2]);
    EXPECT_LE(norm(x - y), 1e-9 * (norm(y) + 1e4));
  }
}

TEST(MohrCoulombReturnTest, ReturnsAreInsideInOrderAndElasticStepsUntouched) {
  MatrixSource source(73);
  int sides = 0, elastic = 0;
  for (const auto& input : testing::sample_inputs<Law>()) {
    const auto p = Law::params<double>(input, testing::density, 3);
    for (int n = 0; n < 20000; ++n) {
      const Vector3d e = some_strain(source, std::pow(10, source.uniform(-4, 0)));
      auto s = Law::initial<double>(p);
      const auto tau = testing::stretch<Law>(p, s, e[0], e[1], e[2]);
      const double scale = norm(tau) / (2 * p.mu) + 1e-3;
      ASSERT_LE(Law::yield_value(p, s), 1e-12 * scale + 1e-14);
      const double t[] = {tau.xx, tau.yy, tau.zz};
      for (int i = 0; i < 3; ++i) {  // the order of stresses is that of the trial
        const int j = (i + 1) % 3;
        ASSERT_GE((t[i] - t[j]) * (e[i] - e[j]), -1e-12 * scale * 2 * p.mu);
      }
      const Vector3d trial = 2 * p.mu * e.array() + p.lambda * e.sum();
      bool inside = true;
      for (const Plane& plane : planes_of(input)) {
        inside &= plane.normal.dot(trial) < plane.limit - 1e-9 * trial.norm();
      }
      if (inside) {
        ++elastic;
        ASSERT_EQ(s.equivalent_plastic_strain, 0);
        for (int i = 0; i < 3; ++i) ASSERT_EQ(s.F(i, i), 1 + std::expm1(e[i]));
      } else {
        ++sides;
      }
    }
  }
  EXPECT_GT(elastic, 1000);
  EXPECT_GT(sides, 10000);
}

TEST(MohrCoulombReturnTest, DilationIsThatOfTheFlow) {
  // On a plane of the pyramid the plastic volume strain is 2 sin psi dgamma and the largest less
  // the smallest 2 dgamma.
  const double psi = 12 * degree;
  const auto p = Law::params<double>({1e7, 0.3, 35 * degree, 1e4, psi}, testing::density, 3);
  auto s = Law::initial<double>(p);
  testing::stretch<Law>(p, s, -0.03, -0.006, 0.02);
  Vector3d plastic(-0.03, -0.006, 0.02);
  for (int i = 0; i < 3; ++i) plastic[i] -= std::log(s.F(i, i));
  EXPECT_GT(plastic[2], 1e-3);
  EXPECT_NEAR(plastic[1], 0, 1e-15);
  EXPECT_NEAR(plastic.sum(), std::sin(psi) * (plastic[2] - plastic[0]), 1e-15);
  EXPECT_NEAR(s.log_volume_ratio, -0.016, 1e-15);
}

}  // namespace
}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
// wave_speed is an upper bound of the speeds that the acoustic tensor gives, and not a loose one.
#include <gtest/gtest.h>

#include "verification/conformance/samples.hpp"

namespace scree {
namespace {

using testing::MatrixSource;

template <class M>
class WaveSpeedTest : public ::testing::Test {
 protected:
  using Params = typename M::template Params<double>;
  using State = typename M::template State<double>;

  /// rho0 c^2 of the fastest wave along n: the acoustic tensor A w = (dtau - tau L^T) n with L = w
  /// n^T (from P = tau F^-T), dtau by differences.
  static double fastest(const Params& p, const State& state, const Eigen::Vector3d& n) {
    const double h = 1e-6;
    const auto stress = [&](const Eigen::Matrix3d& L) {
      auto moved = state;
      M::kirchhoff(p, moved, testing::from_eigen<double>(L), 1e6);  // slow: no viscous stress
      return testing::to_eigen(M::kirchhoff(p, moved, zero3<double>(), 1e6));
    };
    const Eigen::Matrix3d tau = stress(Eigen::Matrix3d::Zero());
    Eigen::Matrix3d A;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Matrix3d L = h * Eigen::Vector3d::Unit(k) * n.transpose();
      A.col(k) = (stress(L) - stress(-L)) / (2 * h) * n - n[k] * (tau * n);
    }
    // Waves exist for positive eigenvalues; an elastic A is symmetric.
    const Eigen::Matrix3d symmetric = 0.5 * (A + A.transpose());
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric).eigenvalues().maxCoeff();
  }
  /// Largest ratio of bound and fastest wave over random directions; fails where the bound is
  /// exceeded.
  double check(const Params& p, const State& state, double modulus) {
    const double c = M::wave_speed(p, state), bound = testing::density * c * c;
    double fastest_of_all = 0;
    for (int n = 0; n < 30; ++n) {
      const Eigen::Vector3d direction = source.rotation().col(0);
      fastest_of_all = std::max(fastest_of_all, fastest(p, state, direction));
    }
    // 1e-8: error of the difference quotient.
    EXPECT_GE(bound, fastest_of_all * (1 - 1e-8) - 1e-8 * modulus);
    return bound / fastest_of_all;
  }
  MatrixSource source{23};
};
TYPED_TEST_SUITE(WaveSpeedTest, testing::MaterialTypes);

TYPED_TEST(WaveSpeedTest, BoundsElasticWavesNearRest) {
  using M = TypeParam;
  for (const auto& input : testing::sample_inputs<M>()) {
    const auto p = M::template params<double>(input, testing::density, 3);
    const double modulus = testing::stiffness<M>(input);
    for (int n = 0; n < 100; ++n) {
      const auto state = testing::elastic_state<M>(p, this->source, 1e-3, 1e-4);
      const double looseness = this->check(p, state, modulus);
      // Strains of 1e-3 loosen the bound by a few of them; for nu < 0 it uses |lambda|.
      double exact = 1;
      if constexpr (requires { input.poissons_ratio; }) {
        const LameConstants lame = lame_constants(input.youngs_modulus, input.poissons_ratio);
        exact = (2 * lame.mu + std::abs(lame.lambda)) / (2 * lame.mu + lame.lambda);
      }
      if constexpr (requires { p.flow_stiffness; })
        exact += p.flow_stiffness / (p.lambda + 2 * p.mu);
      EXPECT_LE(looseness, 1.02 * exact);
    }
  }
}

TYPED_TEST(WaveSpeedTest, BoundsElasticWavesUnderStrongCompression) {
  using M = TypeParam;
  for (const auto& input : testing::sample_inputs<M>()) {
    const auto p = M::template params<double>(input, testing::density, 3);
    const double modulus = testing::stiffness<M>(input);
    for (int n = 0; n < 100; ++n) {
      const double compression = this->source.uniform(0.01, 0.3);
      this->check(p, testing::elastic_state<M>(p, this->source, compression, 0.1 * compression),
                  modulus);
    }
  }
}

// Plastic flow is softer: along every direction of motion the incremental work stays below the
// bound.
TYPED_TEST(WaveSpeedTest, BoundsTheStiffnessOfStrongAndFlowingStates) {
  using M = TypeParam;
  const double h = 1e-6;
  for (const auto& input : testing::sample_inputs<M>()) {
    const auto p = M::template params<double>(input, testing::density, 3);
    const double modulus = testing::stiffness<M>(input);
    for (int n = 0; n < 3000; ++n) {
      auto state = testing::random_state<M>(p, this->source, 0.15);
      if (!M::admissible(p, state)) continue;
      const Eigen::Vector3d w = this->source.rotation().col(0), d = this->source.rotation().col(0);
      const Eigen::Matrix3d tau = testing::to_eigen(M::kirchhoff(p, state, zero3<double>(), 1e6));
      auto moved = state;
      M::kirchhoff(p, moved, testing::from_eigen<double>(h * w * d.transpose()), 1e6);
      const Eigen::Matrix3d next = testing::to_eigen(M::kirchhoff(p, moved, zero3<double>(), 1e6));
      const double work = w.dot((next - tau) * d) / h - w.dot(d) * w.dot(tau * d);
      const double c = M::wave_speed(p, state);
      // One-sided difference: error of order h times the modulus.
      EXPECT_LE(work, testing::density * c * c + 1e-4 * modulus);
    }
  }
}

}  // namespace
}  // namespace scree

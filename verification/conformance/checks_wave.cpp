// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "verification/conformance/checks.hpp"

namespace scree::testing {

namespace {

constexpr double slow = 1e6;  ///< s a step: no viscous stress

Eigen::Matrix3d stress_after(const Law& law, State state, const Eigen::Matrix3d& L) {
  advance(law, state, L, slow);
  return to_eigen(law.exact->kirchhoff(state, zero3<double>(), slow));
}

/// rho0 c^2 of the fastest wave along n: the acoustic tensor A w = (dtau - tau L^T) n with L = w
/// n^T (from P = tau F^-T), dtau by differences.
double fastest(const Law& law, const State& state, const Eigen::Vector3d& n) {
  const double h = 1e-6;
  const Eigen::Matrix3d tau = stress_after(law, state, Eigen::Matrix3d::Zero());
  Eigen::Matrix3d A;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix3d L = h * Eigen::Vector3d::Unit(k) * n.transpose();
    A.col(k) = (stress_after(law, state, L) - stress_after(law, state, -L)) / (2 * h) * n -
               n[k] * (tau * n);
  }
  // Waves exist for positive eigenvalues; an elastic A is symmetric.
  const Eigen::Matrix3d symmetric = 0.5 * (A + A.transpose());
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric).eigenvalues().maxCoeff();
}

}  // namespace

Worst wave_speed_excess(const Law& law, MatrixSource& source, double size, int count) {
  // One-sided differences: the answer to a small strain depends on its sign where the law yields.
  const double h = 1e-7;
  Worst worst;
  for (int n = 0; n < count; ++n) {
    State state = law.exact->initial();
    const double compression = source.uniform(0, 2 * size);
    advance(law, state, -compression * Eigen::Matrix3d::Identity());
    for (int i = 0; i < 3; ++i) advance(law, state, source.entries(size));
    // Where the surface moves after the return, the flow of the last step goes on for a while.
    for (int i = 0; law.explicit_hardening && i < 100; ++i) {
      advance(law, state, source.entries(1e-9));
    }
    if (law.explicit_hardening && *law.exact->yield_value(state) > 1e-12) continue;
    if (!law.exact->admissible(state)) continue;
    const double c = law.exact->wave_speed(state), bound = density * c * c;
    const Eigen::Matrix3d tau = stress_after(law, state, Eigen::Matrix3d::Zero());
    for (int k = 0; k < 10; ++k) {
      const Eigen::Vector3d w = source.rotation().col(0), d = source.rotation().col(0);
      const Eigen::Matrix3d next = stress_after(law, state, h * w * d.transpose());
      const double stiffness = w.dot((next - tau) * d) / h - w.dot(d) * w.dot(tau * d);
      worst.add(std::max(stiffness / bound - 1, 0.0));
    }
  }
  return worst;
}

Worst wave_speed_looseness(const Law& law, MatrixSource& source, int count) {
  Worst worst;
  for (int n = 0; n < count; ++n) {
    State state = law.exact->initial();
    advance(law, state, -1e-3 * Eigen::Matrix3d::Identity());
    advance(law, state, source.entries(1e-4));
    const double c = law.exact->wave_speed(state);
    double best = 0;
    for (int k = 0; k < 30; ++k) {
      best = std::max(best, fastest(law, state, source.rotation().col(0)));
    }
    worst.add(density * c * c / best);
  }
  return worst;
}

}  // namespace scree::testing

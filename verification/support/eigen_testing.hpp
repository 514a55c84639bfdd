// SPDX-License-Identifier: Apache-2.0
//
// Solutions of the symmetric eigenproblem against Eigen's SelfAdjointEigenSolver.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/base/eigen.hpp"
#include "verification/support/lanes_testing.hpp"

namespace scree::testing {

template <class V>
class EigenProblemTest : public ::testing::Test {
 protected:
  using T = Scalar<V>;

  static void check(const Sym3<T>& a, const SymEigen<T>& result, double tolerance) {
    const Eigen::Matrix3d exact = to_eigen(a), u = to_eigen(result.vectors);
    Eigen::Vector3d values;
    for (int k = 0; k < 3; ++k) values[k] = result.values[k];
    const double unit = double(epsilon<T>) * std::max(exact.norm(), 1e-12);
    ASSERT_LE((u * values.asDiagonal() * u.transpose() - exact).norm(), tolerance * unit) << exact;
    ASSERT_LE((u.transpose() * u - Eigen::Matrix3d::Identity()).norm(), 25 * double(epsilon<T>));
    ASSERT_GT(u.determinant(), 0.5);
    Eigen::Vector3d expected = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(exact).eigenvalues();
    std::sort(values.data(), values.data() + 3);
    ASSERT_LE((values - expected).norm(), tolerance * unit) << exact;
  }
  /// solve: Sym3 -> SymEigen for scalars and lanes; lane_tolerance: how well they agree; both in
  /// units in the last place of the tensor's norm.
  template <class Solve, class Make>
  void expect_decompositions(Solve solve, int batches, double tolerance, double lane_tolerance,
                             Make make) {
    for (int n = 0; n < batches; ++n) {
      Mat3<V> m = zero3<V>();
      for (int i = 0; i < lanes_of<V>; ++i) set_lane_of(m, i, from_eigen<T>(make()));
      const SymEigen<V> result = solve(sym(m));
      for (int i = 0; i < lanes_of<V>; ++i) {
        const Sym3<T> a = sym(lane_of(m, i));
        SymEigen<T> one{{}, lane_of(result.vectors, i)};
        for (int k = 0; k < 3; ++k) one.values[k] = lane(result.values[k], i);
        ASSERT_NO_FATAL_FAILURE(check(a, one, tolerance));
        // The order of nearly equal values may differ by a rounding: compare them sorted.
        Vec3<T> scalar = solve(a).values;
        std::sort(scalar.v, scalar.v + 3);
        std::sort(one.values.v, one.values.v + 3);
        for (int k = 0; k < 3; ++k) {
          ASSERT_NEAR(scalar[k], one.values[k],
                      lane_tolerance * double(epsilon<T>) * to_eigen(a).norm());
        }
      }
    }
  }
  Eigen::Matrix3d with_values(double a, double b, double c) {
    const Eigen::Matrix3d q = source.rotation();
    return q * Eigen::Vector3d(a, b, c).asDiagonal() * q.transpose();
  }
  MatrixSource source{5};
};

}  // namespace scree::testing

// SPDX-License-Identifier: Apache-2.0
// Symmetric eigenproblem against Eigen's SelfAdjointEigenSolver.
#include "solver/base/eigen.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using testing::epsilon;
using testing::to_eigen;

template <class V>
class EigenTest : public ::testing::Test {
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
  template <class Make>
  void expect_decompositions(int batches, double tolerance, Make make) {
    for (int n = 0; n < batches; ++n) {
      Mat3<V> m = zero3<V>();
      for (int i = 0; i < lanes_of<V>; ++i)
        testing::set_lane_of(m, i, testing::from_eigen<T>(make()));
      const SymEigen<V> result = eigen_symmetric(sym(m));
      for (int i = 0; i < lanes_of<V>; ++i) {
        const Sym3<T> a = sym(testing::lane_of(m, i));
        SymEigen<T> one{{}, testing::lane_of(result.vectors, i)};
        for (int k = 0; k < 3; ++k) one.values[k] = lane(result.values[k], i);
        ASSERT_NO_FATAL_FAILURE(check(a, one, tolerance));
        // The order of nearly equal values may differ by a rounding: compare them sorted.
        Vec3<T> scalar = eigen_symmetric(a).values;
        std::sort(scalar.v, scalar.v + 3);
        std::sort(one.values.v, one.values.v + 3);
        for (int k = 0; k < 3; ++k) {
          ASSERT_NEAR(scalar[k], one.values[k], 4 * double(epsilon<T>) * to_eigen(a).norm());
        }
      }
    }
  }
  Eigen::Matrix3d with_values(double a, double b, double c) {
    const Eigen::Matrix3d q = source.rotation();
    return q * Eigen::Vector3d(a, b, c).asDiagonal() * q.transpose();
  }
  testing::MatrixSource source{5};
};
TYPED_TEST_SUITE(EigenTest, testing::LaneTypes);

TYPED_TEST(EigenTest, RandomTensors) {
  this->expect_decompositions(50000 / lanes_of<TypeParam>, 16,
                              [&] { return this->source.entries(1); });
}

TYPED_TEST(EigenTest, LeftCauchyGreenOfStrongStretch) {
  this->expect_decompositions(50000 / lanes_of<TypeParam>, 16, [&] {
    auto square = [&] { return std::pow(this->source.uniform(0.3, 3), 2); };
    return this->with_values(square(), square(), square());
  });
}

TYPED_TEST(EigenTest, RepeatedNearlyRepeatedAndZeroValues) {
  this->expect_decompositions(20000 / lanes_of<TypeParam>, 16, [&] {
    const double a = this->source.uniform(-2, 2), kind = this->source.uniform(0, 5);
    const double near = a * (1 + 1e-6 * this->source.uniform(-1, 1));
    if (kind < 1) return this->with_values(a, a, a);
    if (kind < 2) return this->with_values(a, a, 1);
    if (kind < 3) return this->with_values(a, near, 1);
    if (kind < 4) return this->with_values(a, 0, 0);
    return Eigen::Matrix3d(Eigen::Vector3d(a, near, near).asDiagonal());
  });
}

TYPED_TEST(EigenTest, GradedAndWidelyScaledTensors) {
  this->expect_decompositions(20000 / lanes_of<TypeParam>, 16, [&] {
    const double scale = std::pow(10.0, this->source.uniform(-6, 9));
    auto value = [&] { return scale * std::pow(10.0, this->source.uniform(-6, 0)); };
    return this->with_values(value(), value(), value());
  });
}

TYPED_TEST(EigenTest, DiagonalInputIsExact) {
  using V = TypeParam;
  using T = Scalar<V>;
  const V z = broadcast<V>(T(0)), one = broadcast<V>(T(1)), big = broadcast<V>(T(2.5));
  for (const Sym3<V>& a : {Sym3<V>{one, z, z, one, z, one}, Sym3<V>{z, z, z, z, z, z},
                           Sym3<V>{big, z, z, one, z, z}}) {
    const SymEigen<V> result = eigen_symmetric(a);
    const V diagonal[3] = {a.xx, a.yy, a.zz};
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(lane(result.values[k], 0), lane(diagonal[k], 0));
      for (int j = 0; j < 3; ++j) EXPECT_EQ(lane(result.vectors(k, j), 0), T(k == j));
    }
  }
}

}  // namespace
}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
// Symmetric eigenproblem without iteration against Eigen's SelfAdjointEigenSolver.
#include "solver/base/eigen_closed.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using testing::epsilon;
using testing::to_eigen;

template <class V>
class EigenClosedTest : public ::testing::Test {
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
      const SymEigen<V> result = eigen_symmetric_closed(sym(m));
      for (int i = 0; i < lanes_of<V>; ++i) {
        const Sym3<T> a = sym(testing::lane_of(m, i));
        SymEigen<T> one{{}, testing::lane_of(result.vectors, i)};
        for (int k = 0; k < 3; ++k) one.values[k] = lane(result.values[k], i);
        ASSERT_NO_FATAL_FAILURE(check(a, one, tolerance));
        // The order of nearly equal values may differ by a rounding: compare them sorted. The
        // compiler fuses products and sums differently in scalar and vector code, so the two agree
        // as well as each agrees with the exact values.
        Vec3<T> scalar = eigen_symmetric_closed(a).values;
        std::sort(scalar.v, scalar.v + 3);
        std::sort(one.values.v, one.values.v + 3);
        for (int k = 0; k < 3; ++k) {
          ASSERT_NEAR(scalar[k], one.values[k],
                      tolerance * double(epsilon<T>) * to_eigen(a).norm());
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
TYPED_TEST_SUITE(EigenClosedTest, testing::LaneTypes);

TYPED_TEST(EigenClosedTest, RandomTensors) {
  this->expect_decompositions(50000 / lanes_of<TypeParam>, 16,
                              [&] { return this->source.entries(1); });
}

TYPED_TEST(EigenClosedTest, LeftCauchyGreenOfStrongStretch) {
  this->expect_decompositions(50000 / lanes_of<TypeParam>, 16, [&] {
    auto square = [&] { return std::pow(this->source.uniform(0.3, 3), 2); };
    return this->with_values(square(), square(), square());
  });
}

TYPED_TEST(EigenClosedTest, RepeatedNearlyRepeatedAndZeroValues) {
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

TYPED_TEST(EigenClosedTest, GradedAndWidelyScaledTensors) {
  this->expect_decompositions(20000 / lanes_of<TypeParam>, 16, [&] {
    const double scale = std::pow(10.0, this->source.uniform(-6, 9));
    auto value = [&] { return scale * std::pow(10.0, this->source.uniform(-6, 0)); };
    return this->with_values(value(), value(), value());
  });
}

TYPED_TEST(EigenClosedTest, PlaneTensorsKeepTheirZeros) {
  using V = TypeParam;
  using T = Scalar<V>;
  const V zero = broadcast<V>(T(0));
  for (int n = 0; n < 2000; ++n) {
    const auto number = [&] { return broadcast<V>(T(this->source.uniform(0.5, 2))); };
    Sym3<V> a{number(), number() - T(1), zero, number(), zero, number()};
    if (n % 3 == 0) a.xy = zero;
    if (n % 7 == 0) a.zz = a.xx;
    if (n % 11 == 0) a.yy = a.xx;
    const SymEigen<V> result = eigen_symmetric_closed(a);
    int normal = 0;
    for (int j = 0; j < 3; ++j) {
      const T x = lane(result.vectors(0, j), 0), y = lane(result.vectors(1, j), 0),
              z = lane(result.vectors(2, j), 0);
      EXPECT_TRUE(z == 0 || (x == 0 && y == 0)) << x << " " << y << " " << z;
      normal += z != 0;
    }
    EXPECT_EQ(normal, 1);
  }
}

TYPED_TEST(EigenClosedTest, MultiplesOfTheIdentityAreExact) {
  using V = TypeParam;
  using T = Scalar<V>;
  for (const T x : {T(1), T(2.5), T(1e-3)}) {
    const V d = broadcast<V>(x), z = broadcast<V>(T(0));
    const SymEigen<V> result = eigen_symmetric_closed(Sym3<V>{d, z, z, d, z, d});
    for (int k = 0; k < 3; ++k) EXPECT_EQ(lane(result.values[k], 0), x);
  }
}

}  // namespace
}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
// Singular value decomposition against Eigen's JacobiSVD, with inverted and degenerate matrices.
#include "solver/base/svd.hpp"

#include <gtest/gtest.h>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using testing::epsilon;
using testing::to_eigen;

template <class V>
class SvdTest : public ::testing::Test {
 protected:
  using T = Scalar<V>;

  static void check(const Mat3<T>& a, const Svd<T>& result, double tolerance) {
    const Eigen::Matrix3d exact = to_eigen(a), u = to_eigen(result.u), v = to_eigen(result.v);
    const Eigen::Vector3d s(result.values[0], result.values[1], result.values[2]);
    const double eps = double(epsilon<T>), unit = eps * exact.norm();
    ASSERT_LE((u * s.asDiagonal() * v.transpose() - exact).norm(), tolerance * unit) << exact;
    ASSERT_LE((u.transpose() * u - Eigen::Matrix3d::Identity()).norm(), 30 * eps);
    ASSERT_LE((v.transpose() * v - Eigen::Matrix3d::Identity()).norm(), 30 * eps);
    ASSERT_GT(u.determinant(), 0.5);
    ASSERT_GT(v.determinant(), 0.5);
    Eigen::Vector3d expected = Eigen::JacobiSVD<Eigen::Matrix3d>(exact).singularValues();
    if (exact.determinant() < 0) expected[2] = -expected[2];
    // The sign of a value that is zero to rounding is arbitrary.
    if (std::abs(expected[2]) < tolerance * unit) expected[2] = std::copysign(expected[2], s[2]);
    ASSERT_LE((s - expected).norm(), tolerance * unit) << exact;
  }
  template <class Make>
  void expect_decompositions(int batches, double tolerance, Make make) {
    for (int n = 0; n < batches; ++n) {
      Mat3<V> a = zero3<V>();
      for (int i = 0; i < lanes_of<V>; ++i)
        testing::set_lane_of(a, i, testing::from_eigen<T>(make()));
      const Svd<V> result = svd(a);
      for (int i = 0; i < lanes_of<V>; ++i) {
        const Mat3<T> input = testing::lane_of(a, i);
        Svd<T> one{testing::lane_of(result.u, i), {}, testing::lane_of(result.v, i)};
        for (int k = 0; k < 3; ++k) one.values[k] = lane(result.values[k], i);
        ASSERT_NO_FATAL_FAILURE(check(input, one, tolerance));
        const Svd<T> scalar = svd(input);
        for (int k = 0; k < 3; ++k) {
          ASSERT_NEAR(scalar.values[k], one.values[k],
                      12 * double(epsilon<T>) * to_eigen(input).norm());
        }
      }
    }
  }
  testing::MatrixSource source{9};
};
TYPED_TEST_SUITE(SvdTest, testing::LaneTypes);

TYPED_TEST(SvdTest, RandomMatricesOfBothSigns) {
  this->expect_decompositions(50000 / lanes_of<TypeParam>, 12,
                              [&] { return this->source.entries(1); });
}

TYPED_TEST(SvdTest, InvertedElements) {
  this->expect_decompositions(10000 / lanes_of<TypeParam>, 12, [&] {
    auto s = [&] { return this->source.uniform(0.3, 3); };
    return this->source.with_stretches(s(), s(), -s());
  });
}

TYPED_TEST(SvdTest, RepeatedAndZeroValues) {
  this->expect_decompositions(20000 / lanes_of<TypeParam>, 12, [&]() -> Eigen::Matrix3d {
    const double a = this->source.uniform(0.3, 3), kind = this->source.uniform(0, 7);
    if (kind < 1) return this->source.with_stretches(a, a, a);
    if (kind < 2) return this->source.with_stretches(a, a, -a);
    if (kind < 3) return this->source.with_stretches(a, a, 1);
    if (kind < 4) return this->source.with_stretches(a, 1, 0);
    if (kind < 5) return this->source.with_stretches(a, 0, 0);
    if (kind < 6) return Eigen::Vector3d(0, a, 0).asDiagonal();
    return Eigen::Matrix3d::Constant(a);
  });
}

TYPED_TEST(SvdTest, WideScales) {
  this->expect_decompositions(10000 / lanes_of<TypeParam>, 12, [&] {
    const double scale = std::pow(10.0, this->source.uniform(-20, 20));
    auto s = [&] { return scale * std::pow(10.0, this->source.uniform(-5, 0)); };
    return this->source.with_stretches(s(), s(), s());
  });
}

TYPED_TEST(SvdTest, IdentityAndZeroAreExact) {
  using V = TypeParam;
  using T = Scalar<V>;
  for (const T scale : {T(1), T(0)}) {
    const Svd<V> result = svd(identity3<V>() * broadcast<V>(scale));
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(lane(result.values[k], 0), scale);
      for (int j = 0; j < 3; ++j) EXPECT_EQ(lane(result.u(k, j), 0), T(k == j));
    }
  }
}

}  // namespace
}  // namespace scree

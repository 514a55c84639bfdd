// SPDX-License-Identifier: Apache-2.0
// Small tensors against Eigen, with lanes holding different matrices.
#include "solver/base/tensor.hpp"

#include <gtest/gtest.h>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using testing::epsilon;
using testing::to_eigen;

template <class V>
class TensorTest : public ::testing::Test {
 protected:
  using T = Scalar<V>;
  TensorTest() {
    testing::MatrixSource source(11);
    for (int i = 0; i < lanes_of<V>; ++i) {
      testing::set_lane_of(a, i, testing::from_eigen<T>(source.with_stretches(0.5, 1.1, 2.0)));
      testing::set_lane_of(b, i, testing::from_eigen<T>(source.entries(1.0)));
    }
  }
  /// Rounding of products of three entries of size one or two.
  static constexpr double tolerance = 40 * double(epsilon<T>);

  template <class F>
  void each_lane(F check) {
    for (int i = 0; i < lanes_of<V>; ++i) {
      check(i, to_eigen(testing::lane_of(a, i)), to_eigen(testing::lane_of(b, i)));
    }
  }
  Mat3<V> a = zero3<V>(), b = zero3<V>();
};
TYPED_TEST_SUITE(TensorTest, testing::LaneTypes);

TYPED_TEST(TensorTest, MatrixAlgebra) {
  using V = TypeParam;
  const Mat3<V> product = this->a * this->b, sum = this->a + this->b,
                difference = this->a - this->b;
  const Mat3<V> inverse_of_a = inverse(this->a), cofactors = cofactor(this->a),
                flipped = transpose(this->b);
  const V determinant = det(this->a), sum_of_diagonal = trace(this->a), length = norm(this->b);
  const Vec3<V> v{{this->b(0, 0), this->b(1, 1), this->b(0, 2)}};
  const Vec3<V> image = this->a * v;
  this->each_lane([&](int i, const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    const auto close = [&](const Mat3<V>& x, const Eigen::Matrix3d& y) {
      EXPECT_LE((to_eigen(testing::lane_of(x, i)) - y).norm(), this->tolerance) << "lane " << i;
    };
    close(product, a * b);
    close(sum, a + b);
    close(difference, a - b);
    close(inverse_of_a, a.inverse());
    close(cofactors, a.determinant() * a.inverse().transpose());
    close(flipped, b.transpose());
    EXPECT_NEAR(lane(determinant, i), a.determinant(), this->tolerance);
    EXPECT_NEAR(lane(sum_of_diagonal, i), a.trace(), this->tolerance);
    EXPECT_NEAR(lane(length, i), b.norm(), this->tolerance);
    const Eigen::Vector3d expected = a * Eigen::Vector3d(b(0, 0), b(1, 1), b(0, 2));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(lane(image[k], i), expected[k], this->tolerance);
  });
}

TYPED_TEST(TensorTest, SymmetricTensors) {
  using V = TypeParam;
  const Sym3<V> left = symmetric_product(this->a), part = sym(this->b);
  const Sym3<V> traceless = deviator(left);
  const Vec3<V> values{{this->a(0, 0), this->a(0, 1), this->a(0, 2)}};
  const Sym3<V> built = from_principal(this->b, values);
  this->each_lane([&](int i, const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    const auto close = [&](const Sym3<V>& x, const Eigen::Matrix3d& y) {
      EXPECT_LE((to_eigen(testing::lane_of(to_mat(x), i)) - y).norm(), this->tolerance)
          << "lane " << i;
      EXPECT_NEAR(lane(norm(x), i), y.norm(), this->tolerance);
      EXPECT_NEAR(lane(trace(x), i), y.trace(), this->tolerance);
    };
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity(), product = a * a.transpose();
    close(left, product);
    close(part, 0.5 * (b + b.transpose()));
    close(traceless, product - product.trace() / 3 * one);
    close(built, b * a.row(0).asDiagonal() * b.transpose());
    close(left + part, product + 0.5 * (b + b.transpose()));
    EXPECT_NEAR(lane(det(left), i), product.determinant(), this->tolerance);
  });
}

TEST(Tensor, SymmetricComponentsAreReadInBothOrders) {
  const Sym3<double> a{1, 2, 3, 4, 5, 6};
  const double expected[3][3] = {{1, 2, 3}, {2, 4, 5}, {3, 5, 6}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_EQ(a(i, j), expected[i][j]);
  }
}

TEST(Tensor, TypesHoldComponentsOnly) {
  EXPECT_EQ(sizeof(Vec3<float>), 3 * sizeof(float));
  EXPECT_EQ(sizeof(Mat3<double>), 9 * sizeof(double));
  EXPECT_EQ(sizeof(Sym3<Lanes<double>>), 6 * sizeof(Lanes<double>));
}

}  // namespace
}  // namespace scree

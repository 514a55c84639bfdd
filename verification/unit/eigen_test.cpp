// SPDX-License-Identifier: Apache-2.0
// Symmetric eigenproblem against Eigen's SelfAdjointEigenSolver.
#include "solver/base/eigen.hpp"

#include <gtest/gtest.h>

#include "verification/support/eigen_testing.hpp"

namespace scree {
namespace {

template <class V>
class EigenTest : public testing::EigenProblemTest<V> {
 protected:
  template <class Make>
  void expect_decompositions(int batches, double tolerance, Make make) {
    const auto solve = [](const auto& a) { return eigen_symmetric(a); };
    testing::EigenProblemTest<V>::expect_decompositions(solve, batches, tolerance, 4, make);
  }
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

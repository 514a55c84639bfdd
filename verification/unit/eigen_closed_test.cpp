// SPDX-License-Identifier: Apache-2.0
// Symmetric eigenproblem without iteration against Eigen's SelfAdjointEigenSolver.
#include "solver/base/eigen_closed.hpp"

#include <gtest/gtest.h>

#include "verification/support/eigen_testing.hpp"

namespace scree {
namespace {

template <class V>
class EigenClosedTest : public testing::EigenProblemTest<V> {
 protected:
  // The compiler fuses products and sums differently in scalar and vector code, so the two agree as
  // well as each agrees with the exact values.
  template <class Make>
  void expect_decompositions(int batches, double tolerance, Make make) {
    const auto solve = [](const auto& a) { return eigen_symmetric_closed(a); };
    testing::EigenProblemTest<V>::expect_decompositions(solve, batches, tolerance, tolerance, make);
  }
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

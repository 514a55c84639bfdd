// SPDX-License-Identifier: Apache-2.0
// The Newton polar rotation against U V^T of Eigen's singular value decomposition.
#include "solver/base/polar.hpp"

#include <gtest/gtest.h>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using testing::epsilon;
using testing::to_eigen;

Eigen::Matrix3d exact_rotation(const Eigen::Matrix3d& f) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

template <class V>
class PolarTest : public ::testing::Test {
 protected:
  using T = Scalar<V>;
  /// Fills lanes with different matrices of one kind and compares; the oracle sees the rounded
  /// input.
  template <class Make>
  void expect_rotations(int batches, double tolerance, Make make) {
    for (int n = 0; n < batches; ++n) {
      Mat3<V> f = zero3<V>();
      for (int i = 0; i < lanes_of<V>; ++i)
        testing::set_lane_of(f, i, testing::from_eigen<T>(make()));
      const Mat3<V> r = polar_rotation(f);
      for (int i = 0; i < lanes_of<V>; ++i) {
        const Mat3<T> input = testing::lane_of(f, i), result = testing::lane_of(r, i);
        const double error = (to_eigen(result) - exact_rotation(to_eigen(input))).norm();
        ASSERT_LE(error, tolerance * double(epsilon<T>)) << to_eigen(input);
        const double difference = (to_eigen(polar_rotation(input)) - to_eigen(result)).norm();
        ASSERT_LE(difference, tolerance * double(epsilon<T>))
            << "lane " << i << " differs from the scalar";
      }
    }
  }
  testing::MatrixSource source{3};
};
TYPED_TEST_SUITE(PolarTest, testing::LaneTypes);

TYPED_TEST(PolarTest, ModerateStretch) {
  auto s = [this] { return this->source.uniform(0.3, 3); };
  // Error amplification of the polar factor is 2/(s2 + s3) <= 3.4 here; 10 observed at most.
  this->expect_rotations(20000 / lanes_of<TypeParam>, 20,
                         [&] { return this->source.with_stretches(s(), s(), s()); });
}

TYPED_TEST(PolarTest, RepeatedStretches) {
  this->expect_rotations(2000 / lanes_of<TypeParam>, 20, [&] {
    const double a = this->source.uniform(0.3, 3), b = this->source.uniform(0.3, 3);
    return this->source.uniform(0, 1) < 0.5 ? this->source.with_stretches(a, a, b)
                                            : this->source.with_stretches(a, a, a);
  });
}

TYPED_TEST(PolarTest, ExtremeStretch) {
  // One small stretch: the rotation stays well conditioned (2/(s2 + s3)).
  this->expect_rotations(2000 / lanes_of<TypeParam>, 2000, [&] {
    return this->source.with_stretches(this->source.uniform(1, 30), this->source.uniform(0.5, 1),
                                       this->source.uniform(0.001, 0.01));
  });
}

TYPED_TEST(PolarTest, IdentityIsExact) {
  using V = TypeParam;
  const Mat3<V> r = polar_rotation(identity3<V>());
  for (int k = 0; k < 9; ++k) EXPECT_EQ(lane(r(k / 3, k % 3), 0), k % 4 == 0 ? 1 : 0);
}

TYPED_TEST(PolarTest, InvertedAndDegenerateInputGivesTheIdentity) {
  using V = TypeParam;
  using T = Scalar<V>;
  const Eigen::Matrix3d inputs[] = {Eigen::Vector3d(1, 1, -1).asDiagonal(), Eigen::Matrix3d::Zero(),
                                    Eigen::Vector3d(1, 1, 0).asDiagonal(),
                                    1e18 * Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Ones()};
  for (const auto& input : inputs) {
    Mat3<V> f = identity3<V>();
    testing::set_lane_of(f, lanes_of<V> - 1,
                         testing::from_eigen<T>(input * (sizeof(T) == 4 ? 1 : 1e10)));
    const Mat3<T> r = testing::lane_of(polar_rotation(f), lanes_of<V> - 1);
    for (int k = 0; k < 9; ++k) EXPECT_EQ(r(k / 3, k % 3), k % 4 == 0 ? T(1) : T(0)) << input;
  }
}

}  // namespace
}  // namespace scree

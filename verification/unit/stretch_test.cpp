// SPDX-License-Identifier: Apache-2.0
// b - V without the rotation against Eigen's singular value decomposition.
#include "solver/base/stretch.hpp"

#include <gtest/gtest.h>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using testing::epsilon;
using testing::to_eigen;

/// U (S^2 - S) U^T of F = U S V^T.
Eigen::Matrix3d exact_excess(const Eigen::Matrix3d& f) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d s = svd.singularValues();
  const Eigen::Vector3d excess = s.array() * (s.array() - 1);
  return svd.matrixU() * excess.asDiagonal() * svd.matrixU().transpose();
}

template <class V>
Eigen::Matrix3d excess_of(const Mat3<V>& f, int l) {
  const Sym3<V> r = stretch_excess(f, symmetric_product(f), det(f));
  const auto at = [&](const V& x) { return double(lane(x, l)); };
  return (Eigen::Matrix3d() << at(r.xx), at(r.xy), at(r.xz), at(r.xy), at(r.yy), at(r.yz), at(r.xz),
          at(r.yz), at(r.zz))
      .finished();
}

template <class V>
class StretchTest : public ::testing::Test {
 protected:
  using T = Scalar<V>;
  /// Lanes with different matrices of one kind; errors in epsilon times |b|. (Double's oracle is in
  /// double, too: its own error is several epsilon.)
  template <class Make>
  void expect_excesses(int batches, double tolerance, Make make) {
    for (int n = 0; n < batches; ++n) {
      Mat3<V> f = zero3<V>();
      for (int i = 0; i < lanes_of<V>; ++i)
        testing::set_lane_of(f, i, testing::from_eigen<T>(make()));
      for (int i = 0; i < lanes_of<V>; ++i) {
        const Mat3<T> input = testing::lane_of(f, i);
        const Eigen::Matrix3d F = to_eigen(input), result = excess_of(f, i);
        const double unit = double(epsilon<T>) * (F * F.transpose()).norm();
        ASSERT_LE((result - exact_excess(F)).norm(), tolerance * unit) << F;
        ASSERT_LE((result - excess_of(input, 0)).norm(), tolerance * unit)
            << "lane " << i << " differs from the scalar";
      }
    }
  }
  testing::MatrixSource source{5};
};
TYPED_TEST_SUITE(StretchTest, testing::LaneTypes);

TYPED_TEST(StretchTest, ModerateStretch) {
  auto s = [this] { return this->source.uniform(0.3, 3); };
  this->expect_excesses(20000 / lanes_of<TypeParam>, 20,
                        [&] { return this->source.with_stretches(s(), s(), s()); });
}

TYPED_TEST(StretchTest, SmallStrain) {
  auto s = [this] { return 1 + this->source.uniform(-1e-3, 1e-3); };
  this->expect_excesses(2000 / lanes_of<TypeParam>, 20,
                        [&] { return this->source.with_stretches(s(), s(), s()); });
}

TYPED_TEST(StretchTest, RepeatedStretches) {
  this->expect_excesses(2000 / lanes_of<TypeParam>, 20, [&] {
    const double a = this->source.uniform(0.3, 3), b = this->source.uniform(0.3, 3);
    return this->source.uniform(0, 1) < 0.5 ? this->source.with_stretches(a, a, b)
                                            : this->source.with_stretches(a, a, a);
  });
}

TYPED_TEST(StretchTest, OneSmallStretch) {
  // Beyond the limit of distortion some go by the rotation, whose tolerance this is.
  this->expect_excesses(2000 / lanes_of<TypeParam>, 2000, [&] {
    return this->source.with_stretches(this->source.uniform(1, 30), this->source.uniform(0.5, 1),
                                       this->source.uniform(0.001, 0.01));
  });
}

TYPED_TEST(StretchTest, RestIsStressFree) {
  const Mat3<TypeParam> f = identity3<TypeParam>();
  for (int i = 0; i < lanes_of<TypeParam>; ++i)
    EXPECT_LE(excess_of(f, i).norm(), 2 * double(epsilon<Scalar<TypeParam>>));
}

}  // namespace
}  // namespace scree

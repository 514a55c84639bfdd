// SPDX-License-Identifier: Apache-2.0
// Every material with strong, degenerate and repeated stretches; lanes against scalars, float
// against double, with floating-point exceptions trapped.
#include <gtest/gtest.h>

#include "verification/conformance/samples.hpp"

namespace scree {
namespace {

using testing::MatrixSource;

/// Singular values in [0.3, 3], among them two and three equal ones and the identity.
Eigen::Matrix3d strong_gradient(MatrixSource& source) {
  const double a = source.uniform(0.3, 3), b = source.uniform(0.3, 3), c = source.uniform(0.3, 3);
  const double kind = source.uniform(0, 10);
  if (kind < 1) return source.with_stretches(a, a, b);
  if (kind < 2) return source.with_stretches(a, a, a);
  if (kind < 2.5) return a * Eigen::Matrix3d::Identity();
  if (kind < 3) return Eigen::Vector3d(a, a, b).asDiagonal();
  if (kind < 3.5) return Eigen::Matrix3d::Identity();
  if (kind < 4) return source.rotation();
  return source.with_stretches(a, b, c);
}

template <class M>
class RobustnessTest : public ::testing::Test {
 protected:
  MatrixSource source{22};
};
TYPED_TEST_SUITE(RobustnessTest, testing::MaterialTypes);

template <class M, class T>
void expect_return_is_idempotent(MatrixSource& source, int count, double tolerance) {
  for (const auto& input : testing::sample_inputs<M>()) {
    const auto p = M::template params<T>(input, testing::density, 3);
    const double modulus = testing::stiffness<M>(input);
    for (int n = 0; n < count; ++n) {
      const Eigen::Matrix3d f = strong_gradient(source);
      auto state = M::template initial<T>(p);
      const testing::FloatingPointTraps traps;
      const Sym3<T> first =
          M::kirchhoff(p, state, testing::from_eigen<T>(f - Eigen::Matrix3d::Identity()), T(1e-2));
      // A fluid integrates tr L: a finite increment may take it out of its domain.
      if (!M::admissible(p, state)) continue;
      const T c = M::wave_speed(p, state), e = M::energy_density(p, state),
              J = M::volume_ratio(p, state);
      ASSERT_TRUE(std::isfinite(norm(testing::to_double(first))) && std::isfinite(c) &&
                  std::isfinite(e))
          << f;
      ASSERT_GT(c, 0);
      ASSERT_GT(J, 0);
      auto again = state;
      const Sym3<T> second = M::kirchhoff(p, again, zero3<T>(), T(0));
      const double scale = modulus + norm(testing::to_double(first));
      ASSERT_LE(testing::distance(testing::to_double(first), testing::to_double(second)),
                tolerance * scale)
          << f;
      const auto x = testing::entries<M, T>(state), y = testing::entries<M, T>(again);
      for (std::size_t i = 0; i < x.size(); ++i) {
        ASSERT_NEAR(x[i], y[i], tolerance * (1 + std::abs(x[i]))) << "entry " << i << "\n" << f;
      }
    }
  }
}

TYPED_TEST(RobustnessTest, ReturnIsIdempotentInDouble) {
  expect_return_is_idempotent<TypeParam, double>(this->source, 100000, 1e-12);
}

TYPED_TEST(RobustnessTest, ReturnIsIdempotentInFloat) {
  expect_return_is_idempotent<TypeParam, float>(this->source, 100000, 2e-5);
}

template <class M, class T>
void expect_lanes_equal_scalars(MatrixSource& source, double tolerance) {
  using V = Lanes<T>;
  for (const auto& input : testing::sample_inputs<M>()) {
    const auto p = M::template params<T>(input, testing::density, 3);
    const double modulus = testing::stiffness<M>(input);
    for (int n = 0; n < 2000; ++n) {
      Mat3<V> first = zero3<V>(), second = zero3<V>();
      for (int i = 1; i < lanes_of<V>; ++i) {  // lane 0 stays undeformed
        testing::set_lane_of(
            first, i,
            testing::from_eigen<T>(strong_gradient(source) - Eigen::Matrix3d::Identity()));
        testing::set_lane_of(second, i, testing::from_eigen<T>(source.entries(0.1)));
      }
      const testing::FloatingPointTraps traps;
      auto state = M::template initial<V>(p);
      M::kirchhoff(p, state, first, T(1e-2));
      const Sym3<V> tau = M::kirchhoff(p, state, second, T(1e-2));
      const V c = M::wave_speed(p, state), e = M::energy_density(p, state);
      for (int i = 0; i < lanes_of<V>; ++i) {
        auto alone = M::template initial<T>(p);
        M::kirchhoff(p, alone, testing::lane_of(first, i), T(1e-2));
        const Sym3<T> expected = M::kirchhoff(p, alone, testing::lane_of(second, i), T(1e-2));
        EXPECT_EQ(lane(M::admissible(p, state), i), M::admissible(p, alone));
        if (!M::admissible(p, alone)) continue;
        const Mat3<T> x = testing::lane_of(to_mat(tau), i);
        const double scale = modulus + norm(testing::to_double(expected));
        ASSERT_LE(testing::distance(testing::to_double(sym(x)), testing::to_double(expected)),
                  tolerance * scale);
        ASSERT_NEAR(lane(c, i) / M::wave_speed(p, alone), 1, tolerance);
        ASSERT_NEAR(lane(e, i), M::energy_density(p, alone), tolerance * scale);
      }
    }
  }
}

// Lanes and scalars run the same operations and may differ only by the compiler's choice of fused
// multiply-adds: a few roundings, amplified by products of stretches up to 3.
TYPED_TEST(RobustnessTest, LanesEqualScalarsInDouble) {
  expect_lanes_equal_scalars<TypeParam, double>(this->source, 1e-13);
}

TYPED_TEST(RobustnessTest, LanesEqualScalarsInFloat) {
  expect_lanes_equal_scalars<TypeParam, float>(this->source, 5e-5);
}

TYPED_TEST(RobustnessTest, SinglePrecisionStaysNearDouble) {
  using M = TypeParam;
  for (const auto& input : testing::sample_inputs<M>()) {
    const auto exact = M::template params<double>(input, testing::density, 3);
    const auto rounded = M::template params<float>(input, testing::density, 3);
    const double modulus = testing::stiffness<M>(input);
    for (int n = 0; n < 5000; ++n) {
      auto state = testing::random_state<M>(exact, this->source, 0.05);
      auto single = testing::to_float<M>(state);
      const Mat3<float> L = testing::from_eigen<float>(this->source.entries(0.05));
      Mat3<double> same;
      for (int k = 0; k < 9; ++k) same(k / 3, k % 3) = L(k / 3, k % 3);
      const Sym3<double> tau = M::kirchhoff(exact, state, same, 1e-2);
      const Sym3<float> approximate = M::kirchhoff(rounded, single, L, 1e-2f);
      // Rounding of F (6e-8) and of the decomposition (about ten roundings), times the modulus.
      ASSERT_LE(testing::distance(testing::to_double(approximate), tau), 3e-6 * modulus);
      ASSERT_NEAR(M::wave_speed(rounded, single) / M::wave_speed(exact, state), 1, 1e-5);
    }
  }
}

TYPED_TEST(RobustnessTest, InvertedGradientIsNotAdmissibleAndDoesNotTrap) {
  using M = TypeParam;
  const Eigen::Matrix3d gradients[] = {Eigen::Vector3d(-1, 1, 1).asDiagonal(),
                                       Eigen::Vector3d(0, 1, 1).asDiagonal(),
                                       Eigen::Matrix3d::Zero(), -Eigen::Matrix3d::Identity()};
  for (const auto& input : testing::sample_inputs<M>()) {
    const auto p = M::template params<double>(input, testing::density, 3);
    for (const auto& f : gradients) {
      auto state = M::template initial<double>(p);
      const testing::FloatingPointTraps traps;
      M::kirchhoff(p, state, testing::from_eigen<double>(f - Eigen::Matrix3d::Identity()), 1e-2);
      const double c = M::wave_speed(p, state);
      EXPECT_TRUE(std::isfinite(c));
      // A fluid sees tr L only: 1 + tr(f - 1) decides.
      const bool fluid = std::is_same_v<M, JFluid>;
      if (!fluid || f.trace() <= 2) {
        EXPECT_FALSE(M::admissible(p, state)) << M::name << "\n" << f;
      }
    }
  }
}

}  // namespace
}  // namespace scree

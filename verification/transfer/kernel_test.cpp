// SPDX-License-Identifier: Apache-2.0
//
// The solver's kernels against the reference sums: weights, slopes, node positions and the closed
// form of D^-1, for scalars and lanes, float and double (cases V01, V02).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"
#include "verification/reference/kernel.hpp"
#include "verification/support/effort.hpp"
#include "verification/support/random.hpp"

namespace scree {
namespace {

using reference::Matrix;
using reference::StencilEntry;
using reference::Vector;

template <class K>
constexpr reference::Kernel kernel_of() {
  if (std::is_same_v<K, Compact>) return reference::Kernel::compact;
  return std::is_same_v<K, Quadratic> ? reference::Kernel::quadratic : reference::Kernel::linear;
}

/// Everything the solver knows about one particle, node by node, in double.
template <class K, int D, class V>
struct SolverPoint {
  using Point = typename K::template Point<V, D>;
  Point point;
  Slopes<V, D, K::lattices, K::support> slopes;
  Vector u = Vector::Zero();

  explicit SolverPoint(const Scalar<V> (&position)[D]) {
    V lanes[D];
    for (int a = 0; a < D; ++a) {
      lanes[a] = broadcast<V>(position[a]);
      u[a] = position[a];
    }
    point = K::template at<V, D>(lanes);
    slopes = K::template slopes<V, D>(point);
  }

  static double first(const V& v) { return static_cast<double>(lane(v, lanes_of<V> - 1)); }

  /// The node's entry, step[a] nodes above the lowest of the lattice in axis a.
  StencilEntry entry(int lattice, const int (&step)[3]) const {
    StencilEntry e{{lattice, {}}, Vector::Zero(), 1.0, Vector::Zero()};
    int rest = static_cast<int>(lane(point.stencil.base[lattice], lanes_of<V> - 1));
    for (int a = D - 1; a >= 0; --a) {
      e.node.index[a] = rest % K::arena_extent + K::first_node(lattice) + step[a];
      rest /= K::arena_extent;
      e.offset[a] = first(point.stencil.offset[lattice][a]) + step[a];
      e.weight *= first(point.stencil.weight[lattice][a][step[a]]);
    }
    EXPECT_EQ(rest, lattice);
    for (int a = 0; a < D; ++a) {
      e.gradient[a] = 1;
      for (int b = 0; b < D; ++b)
        e.gradient[a] *= a == b ? first(slopes.slope[lattice][b][step[b]])
                                : first(point.stencil.weight[lattice][b][step[b]]);
    }
    return e;
  }
};

template <class K, int D, class V>
void expect_equal_to_reference(const SolverPoint<K, D, V>& solver, double rounding) {
  const auto entries = reference::stencil(kernel_of<K>(), solver.u, 1.0, D);
  const int depth = D == 3 ? K::support : 1;
  size_t n = 0;
  for (int lattice = 0; lattice < K::lattices; ++lattice)
    for (int i = 0; i < K::support; ++i)
      for (int j = 0; j < K::support; ++j)
        for (int k = 0; k < depth; ++k, ++n) {
          const StencilEntry got = solver.entry(lattice, {i, j, k});
          const StencilEntry& expected = entries[n];
          EXPECT_EQ(got.node.lattice, expected.node.lattice);
          for (int a = 0; a < D; ++a)
            EXPECT_EQ(got.node.index[a], expected.node.index[a]) << solver.u.transpose();
          EXPECT_LT((got.offset - expected.offset).norm(), rounding);
          EXPECT_NEAR(got.weight, expected.weight, rounding);
          EXPECT_LT((got.gradient - expected.gradient).norm(), 8 * rounding);  // slopes up to 2
        }
}

template <class K, int D, class V>
void expect_inverse_moment(const SolverPoint<K, D, V>& solver, double rounding) {
  if constexpr (K::has_inverse_moment) {
    V identity[D][D];
    V out[D][D];
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) identity[a][b] = broadcast<V>(a == b ? 1 : 0);
    K::template times_inverse_moment<V, D>(solver.point, identity, out);
    Matrix inverse = Matrix::Zero();
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) inverse(a, b) = SolverPoint<K, D, V>::first(out[a][b]);
    const Matrix D_sum = reference::moment_matrix(kernel_of<K>(), solver.u, 1.0, D);
    Matrix one = Matrix::Identity();
    if (D == 2) one(2, 2) = 0;
    EXPECT_LT((inverse * D_sum - one).norm(), 8 * rounding);  // cond(D) <= 1.92
  }
}

template <class K, int D, class V>
void check_kernel(unsigned long long seed) {
  using T = Scalar<V>;
  testing::Random random(seed);
  // The polynomial sine is good to 4e-16 (double) and 3e-8 (float), products of D weights and the
  // rounding of the position add a few units.
  const double rounding = 12 * static_cast<double>(std::numeric_limits<T>::epsilon());
  for (int count = 0; count < testing::effort(4000); ++count) {
    T u[D];
    for (int a = 0; a < D; ++a) {
      u[a] = static_cast<T>(random.uniform(0, 4.5));
      if (count % 4 == 0) u[a] = std::round(2 * u[a]) / 2;
      if (count % 8 == 0) u[a] = std::nextafter(u[a], T(2));
      u[a] = std::min(std::max(u[a], T(0)), std::nextafter(T(4.5), T(0)));
    }
    const SolverPoint<K, D, V> solver(u);
    expect_equal_to_reference(solver, rounding);
    expect_inverse_moment(solver, rounding);
    if (::testing::Test::HasFailure()) return;
  }
}

template <class K>
class KernelTest : public ::testing::Test {};
using Kernels = ::testing::Types<Compact, Quadratic, Linear>;
TYPED_TEST_SUITE(KernelTest, Kernels);

TYPED_TEST(KernelTest, equals_the_reference_in_two_dimensions) {
  check_kernel<TypeParam, 2, double>(41);
  check_kernel<TypeParam, 2, float>(42);
  check_kernel<TypeParam, 2, Lanes<double>>(43);
  check_kernel<TypeParam, 2, Lanes<float>>(44);
}

TYPED_TEST(KernelTest, equals_the_reference_in_three_dimensions) {
  check_kernel<TypeParam, 3, double>(45);
  check_kernel<TypeParam, 3, float>(46);
  check_kernel<TypeParam, 3, Lanes<double>>(47);
  check_kernel<TypeParam, 3, Lanes<float>>(48);
}

TYPED_TEST(KernelTest, partition_of_unity_and_first_moment_to_the_last_bit) {
  testing::Random random(49);
  for (int count = 0; count < testing::effort(100000); ++count) {
    const double u[2] = {random.uniform(0, 4.5), random.uniform(0, 4.5)};
    const auto point = TypeParam::template at<double, 2>(u);
    double first[2] = {0, 0};
    for (int k = 0; k < TypeParam::lattices; ++k)
      for (int a = 0; a < 2; ++a) {
        double sum = 0;
        for (int s = 0; s < TypeParam::support; ++s) {
          const double w = point.stencil.weight[k][a][s];
          sum += w;
          first[a] += w * (point.stencil.offset[k][a] + s) / TypeParam::lattices;
          EXPECT_GE(w, 0);
        }
        EXPECT_NEAR(sum, 1, 2.3e-16);
      }
    EXPECT_NEAR(first[0], 0, 1e-15);
    EXPECT_NEAR(first[1], 0, 1e-15);
  }
}

template <class T>
double worst_sine_error() {
  double worst = 0;
  for (int n = 0; n <= 20000; ++n) {
    const T h = static_cast<T>(n / 80000.0);
    const long double angle = 2 * std::numbers::pi_v<long double> * static_cast<long double>(h);
    const long double exact = std::cos(angle) / (2 * std::numbers::pi_v<long double>);
    worst = std::max(worst, static_cast<double>(std::abs(compact_sine<T>(h * h) - exact)));
  }
  return worst;
}

TEST(CompactSine, has_its_stated_accuracy) {
  EXPECT_LT(worst_sine_error<double>(), 4e-16);
  EXPECT_LT(worst_sine_error<float>(), 3e-8);
  EXPECT_EQ(compact_sine(0.0625), 0);  // K is continuous at the cell's edges
  for (double h = -0.25; h <= 0.25; h += 1.0 / 4096)
    EXPECT_NEAR(compact_sin_2pi(h), std::sin(2 * std::numbers::pi * h), 3e-16);
}

}  // namespace
}  // namespace scree

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

/// g - sin(2 pi g)/(2 pi) in extended precision, by its series near zero.
long double exact_rim(long double g) {
  const long double pi = std::numbers::pi_v<long double>;
  if (g > 0.05L) return g - std::sin(2 * pi * g) / (2 * pi);
  const long double z = 4 * pi * pi * g * g;
  long double term = g * z / 6, sum = 0;
  for (int k = 3; k < 20; k += 2) {
    sum += term;
    term *= -z / ((k + 1) * (k + 2));
  }
  return sum;
}

/// Largest relative error of compact_rim from the edge of the support to the middle of the kernel.
template <class T>
double worst_rim_error() {
  double worst = 0;
  for (long double x = 0.5L; x > 1e-10L; x *= 0.9991L) {
    const T g = static_cast<T>(x), r = T(0.5) - g;
    const long double exact = exact_rim(static_cast<long double>(g));
    const long double got = compact_rim(g, r, compact_remainder(g * r));
    worst = std::max(worst, static_cast<double>(std::abs(got / exact - 1)));
  }
  return worst;
}

TEST(CompactRim, has_its_stated_accuracy) {
  EXPECT_LT(worst_rim_error<double>(), 4e-15);
  EXPECT_LT(worst_rim_error<float>(), 6e-7);
  EXPECT_EQ(compact_rim(0.0, 0.5, compact_remainder(0.0)), 0);  // K is continuous at the edges
  EXPECT_EQ(compact_rim(0.5, 0.0, compact_remainder(0.0)), 0.5);
}

TEST(CompactSlope, has_its_stated_accuracy) {
  for (double g = 0.5; g > 1e-10; g *= 0.997) {
    const double sine = std::sin(std::numbers::pi * g);
    EXPECT_NEAR(compact_slope(g) / (2 * sine * sine), 1, 1e-15) << g;  // rounding
  }
  EXPECT_EQ(compact_slope(0.0), 0);
}

/// At a distance e from the edge of the support the weight is (2 pi^2/3) e^3, its slope 2 pi^2 e^2:
/// never of the other sign, so that masses of light nodes cannot cancel while forces do not.
TEST(CompactRim, weights_and_slopes_keep_their_digits_beside_nodes) {
  for (const double middle : {1.0, 1.5, 2.0, 2.5}) {
    for (double e = 1e-3; e > 1e-15; e *= 0.37) {
      for (const double side : {-1.0, 1.0}) {
        const double u[2] = {middle + side * e, 2.2};
        const double distance = std::abs(u[0] - middle);  // e as it is after rounding
        if (distance == 0) continue;
        const auto point = Compact::at<double, 2>(u);
        const auto slopes = Compact::slopes<double, 2>(point);
        const int lattice = middle == std::floor(middle) ? 0 : 1, node = side > 0 ? 1 : 0;
        const double pi_square = std::numbers::pi * std::numbers::pi;
        // The next terms of both series are below 2 pi^2/5 e^2, (pi e)^2.
        const double bound = 1e-14 + 10 * distance * distance;
        EXPECT_NEAR(point.stencil.weight[lattice][0][node] /
                        (2 * pi_square / 3 * distance * distance * distance),
                    1, bound);
        EXPECT_NEAR(side * slopes.slope[lattice][0][node] / (2 * pi_square * distance * distance),
                    1, bound);
      }
    }
  }
}

}  // namespace
}  // namespace scree

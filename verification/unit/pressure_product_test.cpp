// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "solver/coupling/pressure_product.hpp"
#include "solver/coupling/pressure_solver.hpp"
#include "solver/grid/block.hpp"
#include "verification/support/random.hpp"

namespace scree::testing {
namespace {

/// A matrix on some nodes of a box, with gaps in every axis. Each pair of nodes within reach has an
/// entry; the diagonal outweighs the others.
template <int D>
struct Scattered {
  PressureLattice<D> lattice;
  PressureMatrix<D> matrix;
  PressureProduct<D> product;
  ThreadPool pool{2};

  Scattered(int spacing, int reach)
      : lattice(spacing, 0.25, cells(), {}), matrix(lattice, reach), product(lattice, reach) {
    Random random(3);
    std::vector<char> marks(std::size_t(lattice.size()), 0);
    PressureNode<D> node{};
    for (std::int64_t i = 0; i < lattice.size(); ++i) {
      node = lattice.node(i);
      bool inside = true;
      for (const std::int32_t n : node) inside = inside && n >= 0 && n < 11;
      marks[std::size_t(i)] = inside && random.uniform(0, 1) < 0.6 ? 1 : 0;
    }
    matrix.set_nodes(marks, true);
    for (std::int32_t r = 0; r < matrix.rows(); ++r) {
      const PressureNode<D> from = lattice.node(matrix.nodes()[std::size_t(r)]);
      for (std::int32_t c = r; c < matrix.rows(); ++c) {
        const PressureNode<D> to = lattice.node(matrix.nodes()[std::size_t(c)]);
        bool near = true;
        for (std::size_t a = 0; a < D; ++a) near = near && std::abs(to[a] - from[a]) <= reach;
        if (!near) continue;
        const double value = c == r ? power(2 * reach + 1, D) : random.uniform(-1, 1);
        matrix.add(r, matrix.offset_index(from, to), value);
      }
    }
    matrix.finish();
    product.set_nodes(matrix);
    product.set_values(matrix, pool);
  }
  static std::array<std::int32_t, D> cells() {
    std::array<std::int32_t, D> n{};
    n.fill(12);
    return n;
  }
  std::vector<double> compressed(const std::vector<double>& x) const {
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t r = 0; r < x.size(); ++r) {
      for (std::int32_t i = matrix.row_begin()[r]; i < matrix.row_begin()[r + 1]; ++i) {
        y[r] += matrix.values()[std::size_t(i)] * x[std::size_t(matrix.columns()[std::size_t(i)])];
      }
    }
    return y;
  }
};

template <int D>
void expect_product_of_compressed_rows(int spacing, int reach) {
  const Scattered<D> scattered(spacing, reach);
  const std::size_t rows = std::size_t(scattered.matrix.rows());
  Random random(4);
  std::vector<double> x(rows), y(rows), diagonal(rows);
  for (double& value : x) value = random.uniform(-1, 1);
  const std::vector<double> expected = scattered.compressed(x);
  scattered.product.multiply(x.data(), y.data());
  scattered.product.diagonal(diagonal.data());
  const double size = power(2 * reach + 1, D);  // of the diagonal, and of all others together
  for (std::size_t r = 0; r < rows; ++r) {
    EXPECT_NEAR(y[r], expected[r], 1e-15 * 2 * size) << r;  // some ulps of the sum of magnitudes
    EXPECT_EQ(diagonal[r], size);
  }
}

TEST(PressureProduct, IsThatOfTheCompressedRows) {
  expect_product_of_compressed_rows<2>(2, 2);
  expect_product_of_compressed_rows<2>(1, 3);
  expect_product_of_compressed_rows<3>(2, 2);
  expect_product_of_compressed_rows<3>(1, 3);
}

TEST(PressureProduct, SolvesLikeCompressedRows) {
  const Scattered<3> scattered(2, 2);
  const std::size_t rows = std::size_t(scattered.matrix.rows());
  const std::vector<double> b(rows, 1.0);
  std::vector<double> x(rows, 0.0), y(rows, 0.0);
  PressureSolver of_entries("jacobi", 1e-12, ""), of_action("jacobi", 1e-12, "");
  EXPECT_FALSE(of_action.needs_entries());
  of_entries.set_pattern(scattered.matrix.row_begin(), scattered.matrix.columns());
  of_action.set_action(scattered.product);
  const SolveReport one = of_entries.solve(scattered.matrix.values(), b, x);
  const SolveReport other = of_action.solve(b, y);
  EXPECT_TRUE(one.converged);
  EXPECT_TRUE(other.converged);
  EXPECT_EQ(one.iterations, other.iterations);
  for (std::size_t r = 0; r < rows; ++r) EXPECT_NEAR(x[r], y[r], 1e-13) << r;  // 10 x tolerance/125
}

TEST(PressureProduct, OtherPreconditionersNeedEntries) {
  EXPECT_TRUE(PressureSolver("icc", 1e-8, "").needs_entries());
  EXPECT_TRUE(PressureSolver("jacobi", 1e-8, "-scree_p_pc_type gamg").needs_entries());
  EXPECT_TRUE(PressureSolver("jacobi", 1e-8, "-scree_p_pc_jacobi_type rowmax").needs_entries());
  EXPECT_FALSE(PressureSolver("icc", 1e-8, "-scree_p_pc_type none").needs_entries());
}

}  // namespace
}  // namespace scree::testing

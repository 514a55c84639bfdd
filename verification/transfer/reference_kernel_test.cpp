// SPDX-License-Identifier: Apache-2.0
//
// Properties of the reference kernels and of D: the oracle must be right before it judges the
// solver (cases V01, V02).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "verification/reference/kernel.hpp"
#include "verification/support/effort.hpp"
#include "verification/support/random.hpp"

namespace scree::reference {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Kernel kernels[] = {Kernel::compact, Kernel::quadratic, Kernel::linear};

/// Random positions in units of dx, every fourth within 1e-12 of a node, a cell face or a G+ node.
Vector sample_position(scree::testing::Random& random, int dimension, int count) {
  Vector x = Vector::Zero();
  for (int a = 0; a < dimension; ++a) {
    x[a] = random.uniform(2, 9);
    if (count % 4 == 0) x[a] = std::round(2 * x[a]) / 2 + random.uniform(-1e-12, 1e-12);
  }
  return x;
}

TEST(ReferenceKernel, partition_of_unity_on_every_lattice) {
  scree::testing::Random random(11);
  for (Kernel kernel : kernels)
    for (int count = 0; count < scree::testing::effort(20000); ++count) {
      double sum[2] = {0, 0};
      for (const StencilEntry& e : stencil(kernel, sample_position(random, 3, count), 1.0, 3)) {
        EXPECT_GE(e.weight, -1e-15);  // sin(2 pi x) at x = 1 - 1e-16 is 1e-16 off
        sum[e.node.lattice] += e.weight;
      }
      for (int k = 0; k < lattice_count(kernel); ++k) EXPECT_NEAR(sum[k], 1, 2e-15);
    }
}

TEST(ReferenceKernel, average_of_lattices_reproduces_position_and_gradient) {
  scree::testing::Random random(12);
  for (Kernel kernel : kernels)
    for (int dimension : {2, 3})
      for (int count = 0; count < scree::testing::effort(5000); ++count) {
        const Vector x = sample_position(random, dimension, count);
        Vector first = Vector::Zero(), gradient_sum = Vector::Zero();
        Matrix gradient = Matrix::Zero();
        const double share = 1.0 / lattice_count(kernel);
        for (const StencilEntry& e : stencil(kernel, x, 1.0, dimension)) {
          first += share * e.weight * e.offset;
          gradient_sum += share * e.gradient;
          gradient += share * (x + e.offset) * e.gradient.transpose();
        }
        Matrix expected = Matrix::Identity();
        if (dimension == 2) expected(2, 2) = 0;
        EXPECT_LT(first.norm(), 4e-15);  // rounding of offsets of size |x| = 9
        EXPECT_LT(gradient_sum.norm(), 1e-14);
        EXPECT_LT((gradient - expected).norm(), 1e-13);  // |x| = 16 times rounding
      }
}

TEST(ReferenceKernel, one_compact_lattice_alone_misses_the_first_moment_by_a_sine) {
  double largest = 0;
  for (int n = 0; n < 1000; ++n) {
    const double f = n / 1000.0;
    double moment = 0;
    for (const StencilEntry& e : stencil(Kernel::compact, Vector(5 + f, 3, 0), 1.0, 2))
      if (e.node.lattice == 0) moment += e.weight * e.offset[0];
    EXPECT_NEAR(moment, -std::sin(2 * pi * f) / (2 * pi), 2e-15);
    largest = std::max(largest, std::abs(moment));
  }
  EXPECT_NEAR(largest, 1 / (2 * pi), 1e-12);  // at f = 1/4, which the scan hits
}

TEST(ReferenceKernel, compact_kernel_is_smooth_monotone_and_has_unit_area) {
  const double h = 1e-6;
  for (double x : {-1.0, 0.0, 1.0}) {
    const auto jump = [&](auto f) { return std::abs(f(x + h) - f(x - h)); };
    EXPECT_LT(jump([](double y) { return kernel_value(Kernel::compact, y); }), 1e-11);
    EXPECT_LT(jump([](double y) { return kernel_slope(Kernel::compact, y); }), 1e-10);
    // K''' is 8 pi^2 at most, so K'' changes by 2 h 4 pi^2 over the interval where it is
    // continuous.
    EXPECT_LT(jump(compact_curvature), 2 * h * 4 * pi * pi * 1.01);
  }
  const auto third = [&](double x) {
    return (compact_curvature(x + h) - compact_curvature(x)) / h;
  };
  EXPECT_NEAR(third(0.0) - third(-h), -8 * pi * pi, 1e-4);
  EXPECT_NEAR(std::abs(third(1.0) - third(1.0 - h)), 4 * pi * pi, 1e-4);
  double area = 0, steepest = 0;
  const int n = 1000;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    area += 2 * kernel_value(Kernel::compact, x) / n;
    steepest = std::max(steepest, std::abs(kernel_slope(Kernel::compact, x)));
    EXPECT_LE(kernel_slope(Kernel::compact, x), 0);
    EXPECT_GE(kernel_value(Kernel::compact, x), 0);
  }
  EXPECT_NEAR(area, 1, 1e-13);
  EXPECT_NEAR(kernel_slope(Kernel::compact, 0.5), -2, 1e-15);
  EXPECT_LE(steepest, 2);
  const double f = 1e-3;
  EXPECT_NEAR(kernel_value(Kernel::compact, 1 - f) / (2 * pi * pi / 3 * f * f * f), 1, 1e-4);
}

TEST(ReferenceKernel, slopes_are_the_derivatives_of_the_values) {
  const double h = 1e-6;
  for (Kernel kernel : kernels)
    for (double x : {-1.3, -0.83, -0.31, 0.12, 0.47, 0.76, 1.2}) {
      const double difference =
          (kernel_value(kernel, x + h) - kernel_value(kernel, x - h)) / (2 * h);
      EXPECT_NEAR(kernel_slope(kernel, x), difference, 1e-9);
      if (kernel == Kernel::compact) {
        EXPECT_NEAR(compact_curvature(x),
                    (kernel_slope(kernel, x + h) - kernel_slope(kernel, x - h)) / (2 * h), 1e-8);
      }
    }
}

/// D/dx^2 = diag(d - s^2) + s s^T of the method page, from positions in units of dx.
struct ClosedForm {
  Vector s = Vector::Zero(), d = Vector::Zero();
  int dimension;
  ClosedForm(const Vector& x, int dim) : dimension(dim) {
    for (int a = 0; a < dim; ++a) {
      const double u = x[a] - std::floor(x[a]);
      const double h = std::fmod(u, 0.5) - 0.25;
      s[a] = std::sin(2 * pi * u) / (2 * pi);
      d[a] = 3.0 / 16 - h * h - std::abs(s[a]) / 2;
    }
  }
  Matrix moment() const {
    Matrix m = s * s.transpose();
    for (int a = 0; a < dimension; ++a) m(a, a) = d[a];
    return m;
  }
  Matrix inverse() const {
    Vector t = Vector::Zero();
    Matrix m = Matrix::Zero();
    for (int a = 0; a < dimension; ++a) {
      const double q = d[a] - s[a] * s[a];
      t[a] = s[a] / q;
      m(a, a) = 1 / q;
    }
    return m - t * t.transpose() / (1 + s.dot(t));
  }
};

TEST(ReferenceKernel, moment_matrix_has_the_closed_form_and_its_bounds) {
  scree::testing::Random random(13);
  for (int dimension : {2, 3}) {
    // Sharp: reached where |s_a| = 1/(2 pi) in every axis.
    const double lowest = 3.0 / 16 - 1 / (4 * pi) - 1 / (4 * pi * pi);
    const double highest = 3.0 / 16 - 1 / (4 * pi) + (dimension - 1) / (4 * pi * pi);
    for (int count = 0; count < scree::testing::effort(3000); ++count) {
      const Vector x = sample_position(random, dimension, count);
      const Matrix sum = moment_matrix(Kernel::compact, x, 1.0, dimension);
      const ClosedForm closed(x, dimension);
      EXPECT_LT((sum - closed.moment()).norm(), 2e-15);
      EXPECT_LT(
          (inverse_moment_matrix(Kernel::compact, x, 1.0, dimension) - closed.inverse()).norm(),
          5e-13);  // entries of size 12, twice the rounding of positions of size 9
      const Eigen::MatrixXd block = sum.topLeftCorner(dimension, dimension);
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(block).eigenvalues();
      EXPECT_GT(values.minCoeff(), lowest - 1e-14);
      EXPECT_LT(values.maxCoeff(), std::max(highest, 0.125) + 1e-14);
    }
  }
}

TEST(ReferenceKernel, moment_matrices_of_the_other_kernels) {
  scree::testing::Random random(14);
  for (int count = 0; count < scree::testing::effort(1000); ++count) {
    const Vector x = sample_position(random, 3, 1);
    const double dx = 0.3;
    EXPECT_LT(
        (moment_matrix(Kernel::quadratic, x * dx, dx, 3) - dx * dx / 4 * Matrix::Identity()).norm(),
        2e-15);
    Matrix hat = Matrix::Zero();
    for (int a = 0; a < 3; ++a) {
      const double f = x[a] - std::floor(x[a]);
      hat(a, a) = f * (1 - f);
    }
    EXPECT_LT((moment_matrix(Kernel::linear, x, 1.0, 3) - hat).norm(), 1e-14);
  }
  // Scaling with dx^2: the same point of a cell on a finer grid.
  const Vector x(3.2, 4.7, 5.9);
  EXPECT_LT((moment_matrix(Kernel::compact, x * 0.01, 0.01, 3) * 1e4 -
             moment_matrix(Kernel::compact, x, 1.0, 3))
                .norm(),
            1e-14);
}

}  // namespace
}  // namespace scree::reference

// SPDX-License-Identifier: Apache-2.0
//
// Do the velocities of the nodes and the pressures of the water fit? Two numbers of periodic boxes
// tell: the smallest eigenvalue of sum Q^T M^-1 Q against the Laplacian, and the inf-sup constant.
// The matrices are built here, from the kernels of the reference; pressure_test.cpp shows that the
// solver's operator is the same.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "verification/reference/kernel.hpp"
#include "verification/support/random.hpp"

namespace scree::testing {
namespace {

using Dense = Eigen::MatrixXd;
using reference::Kernel;

double offset_of(double spacing, Kernel kernel) {
  if (kernel == Kernel::quadratic) return 0.5;
  if (spacing == 2) return 0;
  return kernel == Kernel::compact ? 0.25 : 0.5;
}

/// A periodic box of cells of size 1 with jittered particles; pressure nodes `spacing` cells apart.
struct Box {
  int dimension, cells;
  double spacing;
  int particles;  ///< a direction
  double jitter;  ///< of the distance between particles
  Kernel kernel = Kernel::compact;
  double offset = offset_of(spacing, kernel);  ///< of the nodes, as the solver has it

  int pressures() const { return int(std::lround(cells / spacing)); }
};

int power(int base, int exponent) {
  int result = 1;
  while (exponent-- > 0) result *= base;
  return result;
}

int wrap(int i, int n) { return (i % n + n) % n; }

/// Hat functions' mass or stiffness on n nodes of a circle, h apart.
Dense circle(int n, double h, bool stiffness) {
  Dense matrix = Dense::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    matrix(i, i) += stiffness ? 1 / h : h / 3;
    matrix(j, j) += stiffness ? 1 / h : h / 3;
    matrix(i, j) += stiffness ? -1 / h : h / 6;
    matrix(j, i) += stiffness ? -1 / h : h / 6;
  }
  return matrix;
}

Dense kronecker(const Dense& a, const Dense& b) {
  Dense product(a.rows() * b.rows(), a.cols() * b.cols());
  for (int i = 0; i < a.rows(); ++i) {
    for (int j = 0; j < a.cols(); ++j) {
      product.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
    }
  }
  return product;
}

Dense laplacian(int n, double h, int dimension) {
  Dense sum = Dense::Zero(power(n, dimension), power(n, dimension));
  for (int slope = 0; slope < dimension; ++slope) {
    Dense product = Dense::Ones(1, 1);
    for (int a = 0; a < dimension; ++a) product = kronecker(product, circle(n, h, a == slope));
    sum += product;
  }
  return sum;
}

/// Q of each lattice and axis (velocity nodes x pressure nodes), masses of the nodes of each
/// lattice, density 1, and the pressures' mass matrix.
struct Operator {
  std::vector<Dense> q;
  std::vector<Eigen::VectorXd> mass;
  Dense pressure_mass;
};

void add_particle(const Box& box, const reference::Vector& x, double volume, Operator& op) {
  const int d = box.dimension, m = box.pressures();
  std::vector<int> nodes(std::size_t(power(2, d)), 0);
  std::vector<double> hats(nodes.size(), 1.0);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (int a = 0; a < d; ++a) {
      const double y = (x[a] - box.offset) / box.spacing, xi = y - std::floor(y);
      const bool upper = (k >> a & 1) != 0;
      nodes[k] = nodes[k] * m + wrap(int(std::floor(y)) + (upper ? 1 : 0), m);
      hats[k] *= upper ? xi : 1 - xi;
    }
  }
  const reference::Matrix inverse = reference::inverse_moment_matrix(box.kernel, x, 1, d);
  for (const reference::StencilEntry& entry : reference::stencil(box.kernel, x, 1, d)) {
    const reference::Vector gradient = entry.weight * inverse * entry.offset;
    int i = 0;
    for (int a = 0; a < d; ++a)
      i = i * box.cells + wrap(entry.node.index[std::size_t(a)], box.cells);
    op.mass[std::size_t(entry.node.lattice)][i] += entry.weight * volume;
    for (int a = 0; a < d; ++a) {
      Dense& q = op.q[std::size_t(entry.node.lattice * d + a)];
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        q(i, nodes[k]) += volume * gradient[a] * hats[k];
      }
    }
  }
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (std::size_t l = 0; l < nodes.size(); ++l) {
      op.pressure_mass(nodes[k], nodes[l]) += volume * hats[k] * hats[l];
    }
  }
}

Operator build(const Box& box) {
  const int d = box.dimension, velocities = power(box.cells, d),
            pressures = power(box.pressures(), d);
  const int lattices = reference::lattice_count(box.kernel), row = box.cells * box.particles;
  Operator op;
  op.q.assign(std::size_t(lattices * d), Dense::Zero(velocities, pressures));
  op.mass.assign(std::size_t(lattices), Eigen::VectorXd::Zero(velocities));
  op.pressure_mass = Dense::Zero(pressures, pressures);
  Random random(11);
  for (int p = 0; p < power(row, d); ++p) {
    reference::Vector x = reference::Vector::Zero();
    for (int a = 0, rest = p; a < d; ++a, rest /= row) {
      x[a] = (rest % row + 0.5 + box.jitter * random.uniform(-1, 1)) / box.particles;
    }
    add_particle(box, x, 1.0 / power(box.particles, d), op);
  }
  return op;
}

/// The smallest eigenvalue of the pencil a x = lambda b x.
double smallest(const Dense& a, const Dense& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Dense> solver(a, b, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0];
}

struct Spectrum {
  double lambda, beta;
};

/// lambda: 1 of a smooth pressure. beta: the norm of velocities is the sum over the lattices of
/// their Laplacian, so that two lattices leave 1/sqrt(2) of a smooth pressure, one leaves 1.
Spectrum spectrum(const Box& box) {
  const Operator op = build(box);
  const int d = box.dimension, n = int(op.pressure_mass.rows());
  const double lattices = double(op.mass.size()), volume = power(box.cells, d);
  const Dense ones = Dense::Ones(n, n);
  const Dense nodes = Dense::Ones(op.q[0].rows(), op.q[0].rows());
  const Eigen::LLT<Dense> velocity(laplacian(box.cells, 1, d) + nodes);
  Dense schur = Dense::Zero(n, n), inf_sup = Dense::Zero(n, n);
  for (std::size_t k = 0; k < op.q.size(); ++k) {
    const Dense& q = op.q[k];
    const Eigen::VectorXd& mass = op.mass[k / std::size_t(d)];
    schur += q.transpose() * mass.cwiseInverse().asDiagonal() * q / lattices;
    const Dense centred = q.rowwise() - q.colwise().mean();
    inf_sup += centred.transpose() * velocity.solve(centred) / (lattices * lattices);
  }
  // Constants get the eigenvalue 1, which is above all that is sought.
  const Dense weights = op.pressure_mass * ones * op.pressure_mass / volume;
  return {smallest(schur + ones, laplacian(box.pressures(), box.spacing, d) + ones),
          std::sqrt(std::max(smallest(inf_sup + weights, op.pressure_mass), 0.0))};
}

/// Momentum: the nodal forces of any pressure add up to nothing.
TEST(PressureSpectra, ForcesOfAPressureSumToZero) {
  const Operator op = build({2, 8, 1, 3, 0.3});
  for (int a = 0; a < 2; ++a) {
    const Eigen::RowVectorXd sum =
        op.q[std::size_t(a)].colwise().sum() + op.q[std::size_t(2 + a)].colwise().sum();
    EXPECT_LT(sum.cwiseAbs().maxCoeff(), 1e-13) << a;  // rounding of sums of 72 numbers below 1
  }
}

// Bounds leave a third below what boxes of 4, 8 and 16 cells have, with 2 and 3 particles a
// direction, regular and jittered; constants that shrink with the box would fall below.
TEST(PressureSpectra, NodesEveryCellFitTheCompactKernel) {
  for (const Box& box : {Box{2, 8, 1, 3, 0}, Box{2, 8, 1, 3, 0.3}, Box{2, 8, 1, 2, 0.3}}) {
    const Spectrum s = spectrum(box);
    EXPECT_GT(s.lambda, 0.05);  // 0.078
    EXPECT_GT(s.beta, 0.5);     // 0.55 to 0.61, whatever the size of the box
    EXPECT_LT(s.beta, std::sqrt(0.5));
  }
  const Spectrum s = spectrum({3, 8, 1, 2, 0.3});
  EXPECT_GT(s.lambda, 0.015);
  EXPECT_GT(s.beta, 0.42);
}

TEST(PressureSpectra, NodesEverySecondCellFitEveryKernel) {
  for (const Box& box :
       {Box{2, 8, 2, 3, 0}, Box{2, 8, 2, 3, 0.3}, Box{2, 8, 2, 2, 0.3}, Box{3, 8, 2, 2, 0.3}}) {
    const Spectrum s = spectrum(box);
    EXPECT_GT(s.lambda, 0.3);  // 0.43 to 0.46 in 2D, 0.31 to 0.33 in 3D
    EXPECT_GT(s.beta, 0.65);   // 0.69
  }
  for (const Kernel kernel : {Kernel::quadratic, Kernel::linear}) {
    EXPECT_GT(spectrum({2, 8, 2, 3, 0.3, kernel}).lambda, 0.15);  // 0.21, 0.32
  }
}

/// What the deck refuses, or does not offer: the test can tell.
TEST(PressureSpectra, OtherSpacesDoNotFit) {
  for (const double jitter : {0.0, 0.3}) {
    const Spectrum s = spectrum({2, 8, 0.5, 3, jitter});
    EXPECT_LT(std::abs(s.lambda), 1e-12);  // more pressures than velocities can tell apart
    EXPECT_LT(s.beta, 1e-5);               // root of the rounding
  }
  // On nodes of the velocity: 0.0017 and 0.10, nothing where the particles are regular.
  for (const double offset : {0.0, 0.5}) {
    const Spectrum s = spectrum({2, 8, 1, 3, 0.3, Kernel::compact, offset});
    EXPECT_LT(s.lambda, 0.01);
    EXPECT_LT(s.beta, 0.2);
  }
  EXPECT_LT(spectrum({2, 8, 1, 3, 0.3, Kernel::quadratic}).lambda, 0.01);
  EXPECT_LT(spectrum({2, 8, 1, 3, 0.3, Kernel::linear}).lambda, 0.01);
}

}  // namespace
}  // namespace scree::testing

// SPDX-License-Identifier: Apache-2.0
#include "verification/reference/kernel.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace scree::reference {

namespace {

constexpr double pi = std::numbers::pi;

/// Lowest lattice line that a particle at `x` (units of dx) touches.
int lowest_index(Kernel kernel, int lattice, double x) {
  if (kernel == Kernel::quadratic) return static_cast<int>(std::floor(x - 0.5));
  return static_cast<int>(std::floor(x - 0.5 * lattice));
}

double sign(double x) { return x < 0 ? -1.0 : 1.0; }

/// f - sin(2 pi f)/(2 pi); by its series where the difference loses its digits.
double compact_rim(double f) {
  const double z = 4 * pi * pi * f * f;
  if (f > 0.05) return f - std::sin(2 * pi * f) / (2 * pi);
  double term = f * z / 6, sum = 0;
  for (int k = 3; k < 20; k += 2) {
    sum += term;
    term *= -z / ((k + 1) * (k + 2));
  }
  return sum;
}

}  // namespace

double kernel_value(Kernel kernel, double x) {
  const double a = std::abs(x);
  switch (kernel) {
    case Kernel::compact:
      return a < 1 ? compact_rim(1 - a) : 0.0;
    case Kernel::quadratic:
      if (a < 0.5) return 0.75 - a * a;
      return a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0.0;
    case Kernel::linear:
      return a < 1 ? 1 - a : 0.0;
  }
  return 0.0;
}

double kernel_slope(Kernel kernel, double x) {
  const double a = std::abs(x);
  switch (kernel) {
    case Kernel::compact:
      return a < 1 ? -sign(x) * 2 * std::pow(std::sin(pi * (1 - a)), 2) : 0.0;
    case Kernel::quadratic:
      if (a < 0.5) return -2 * x;
      return a < 1.5 ? -sign(x) * (1.5 - a) : 0.0;
    case Kernel::linear:  // the derivative from the right where it jumps
      return x >= -1 && x < 1 ? -sign(x) : 0.0;
  }
  return 0.0;
}

double compact_curvature(double x) {
  const double a = std::abs(x);
  return a < 1 ? -2 * pi * std::sin(2 * pi * a) : 0.0;
}

int lattice_count(Kernel kernel) { return kernel == Kernel::compact ? 2 : 1; }

double node_coordinate(int lattice, int index, double cell_size) {
  return (index + 0.5 * lattice) * cell_size;
}

std::vector<StencilEntry> stencil(Kernel kernel, const Vector& position, double cell_size,
                                  int dimension) {
  const int width = kernel == Kernel::quadratic ? 3 : 2;
  const int depth = dimension == 3 ? width : 1;
  std::vector<StencilEntry> entries;
  for (int lattice = 0; lattice < lattice_count(kernel); ++lattice)
    for (int i = 0; i < width; ++i)
      for (int j = 0; j < width; ++j)
        for (int k = 0; k < depth; ++k) {
          StencilEntry entry{{lattice, {}}, Vector::Zero(), 1.0, Vector::Ones()};
          const std::array<int, 3> step{i, j, k};
          for (int a = 0; a < dimension; ++a) {
            const int index = lowest_index(kernel, lattice, position[a] / cell_size) + step[a];
            entry.node.index[a] = index;
            entry.offset[a] = node_coordinate(lattice, index, cell_size) - position[a];
            const double distance = -entry.offset[a] / cell_size;
            entry.weight *= kernel_value(kernel, distance);
            for (int b = 0; b < dimension; ++b)
              entry.gradient[b] *= a == b ? kernel_slope(kernel, distance) / cell_size
                                          : kernel_value(kernel, distance);
          }
          if (dimension == 2) entry.gradient[2] = 0;
          entries.push_back(entry);
        }
  return entries;
}

Matrix moment_matrix(Kernel kernel, const Vector& position, double cell_size, int dimension) {
  Matrix sum = Matrix::Zero();
  for (const StencilEntry& entry : stencil(kernel, position, cell_size, dimension))
    sum += entry.weight * entry.offset * entry.offset.transpose();
  return sum / lattice_count(kernel);
}

Matrix inverse_moment_matrix(Kernel kernel, const Vector& position, double cell_size,
                             int dimension) {
  const Matrix moment = moment_matrix(kernel, position, cell_size, dimension);
  if (dimension == 3) return moment.inverse();
  Matrix inverse = Matrix::Zero();
  const Eigen::Matrix2d block = moment.topLeftCorner<2, 2>();
  inverse.topLeftCorner<2, 2>() = block.inverse();
  return inverse;
}

}  // namespace scree::reference

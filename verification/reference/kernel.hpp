// SPDX-License-Identifier: Apache-2.0
//
// Kernels of the reference method: plain sums over nodes, std::sin, no closed form of D. Slow and
// obvious on purpose: it is the oracle of the fast solver and shares no code with it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace scree::reference {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

enum class Kernel { compact, quadratic, linear };

/// The 1D kernel at `x`, the distance from the node in units of the cell size.
/// compact: K(x) = 1 - |x| + sin(2 pi |x|)/(2 pi) on |x| <= 1 (Liu, Wang, Li, CK-MPM, ACM TOG
/// 44(4), 2025, eq. 4). quadratic: the B-spline of degree 2 (support 3/2). linear: the hat
/// function.
double kernel_value(Kernel kernel, double x);

/// First derivative of the 1D kernel, in units of one over the cell size.
double kernel_slope(Kernel kernel, double x);

/// Second derivative of the compact kernel: -2 pi sin(2 pi |x|) on |x| <= 1.
double compact_curvature(double x);

/// Number of node lattices: 2 (G- at i dx, G+ at (i + 1/2) dx) for compact, else 1 (nodes at i dx).
int lattice_count(Kernel kernel);

/// A grid node: lattice 0 is G-, 1 is G+; index by axis (0 in the third axis of a 2D problem).
struct Node {
  int lattice = 0;
  std::array<int, 3> index{};
  bool operator<(const Node& other) const {
    return lattice != other.lattice ? lattice < other.lattice : index < other.index;
  }
};

/// Coordinate [m] of lattice line `index` in one axis, measured from the domain's lower corner.
double node_coordinate(int lattice, int index, double cell_size);

/// One node that a particle touches.
struct StencilEntry {
  Node node;
  Vector offset;    ///< x_i - x_p [m]
  double weight;    ///< w_i(x_p); the weights of one lattice add up to 1
  Vector gradient;  ///< derivative of w_i by the particle position [1/m]
};

/// All nodes with a weight that may differ from zero: per lattice 2^d (compact, linear) or 3^d
/// (quadratic) nodes. `position` [m] from the domain's lower corner; `dimension` 2 or 3, in 2D the
/// third axis is left out.
std::vector<StencilEntry> stencil(Kernel kernel, const Vector& position, double cell_size,
                                  int dimension);

/// D = 1/n sum over n lattices and their nodes of w (x_i - x_p)(x_i - x_p)^T [m^2], by summation.
Matrix moment_matrix(Kernel kernel, const Vector& position, double cell_size, int dimension);

/// Inverse of the d x d block of D by Eigen's LU; zero in the third axis of a 2D problem [1/m^2].
Matrix inverse_moment_matrix(Kernel kernel, const Vector& position, double cell_size,
                             int dimension);

}  // namespace scree::reference

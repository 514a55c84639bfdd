// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/coupling/pressure_lattice.hpp"
#include "solver/grid/block.hpp"

namespace scree {

/// A particle with water in its pores, as a step sees it at its start.
template <int D>
struct FlowPoint {
  double local[D];       ///< position in cells from its block's lower corner
  double xi[D];          ///< position within its pressure cell, in [0, 1)
  double half[D];        ///< half the sides of its box, in pressure cells
  PressureNode<D> cell;  ///< that cell
  double volume;         ///< present volume [m^3] (2D: m^2)
  double storage;        ///< 1/M [1/Pa]
  double mobility;       ///< [m^2/(Pa s)]
  double biot;           ///< alpha
  double fluid_density;  ///< [kg/m^3]
  double pressure;       ///< at the step's start [Pa]
  double defect;         ///< volume change of the last step that tr(dt grad v) missed [m^3]
  std::int64_t id;
  bool loaded;  ///< by a traction: FlowPoints::moments counts
};

/// The points of one block of one body, one after the other in FlowPoints::points.
template <int D>
struct FlowChunk {
  std::int64_t begin = 0, end = 0;
  BlockCoord<D> block{};
  std::int32_t grid_block = 0;  ///< in the grid's topology
  std::int32_t body = 0;
  std::int32_t colour = 0;  ///< parity of the block; blocks of one colour share no node
};

template <int D>
struct FlowPoints {
  std::vector<FlowPoint<D>> points;
  /// Of loaded points: sum over faces of force (row) times place of the face from the point
  /// (column), D x D [N m]. Empty where no point is loaded.
  std::vector<std::array<double, D * D>> moments;
  std::vector<FlowChunk<D>> chunks;
};

/// Hat functions of a pressure cell's corners at xi (which may lie outside: they are extended).
/// Corner k has the upper node in axis a where bit D-1-a of k is set.
template <int D>
void hats(const double* xi, double (&n)[1 << D]) {
  for (int k = 0; k < (1 << D); ++k) {
    double product = 1;
    for (int a = 0; a < D; ++a) product *= (k >> (D - 1 - a) & 1) ? xi[a] : 1 - xi[a];
    n[k] = product;
  }
}

/// Derivatives of the hats by xi.
template <int D>
void hat_slopes(const double* xi, double (&g)[1 << D][D]) {
  for (int k = 0; k < (1 << D); ++k) {
    for (int b = 0; b < D; ++b) {
      double product = 1;
      for (int a = 0; a < D; ++a) {
        const bool upper = k >> (D - 1 - a) & 1;
        product *= a == b ? (upper ? 1.0 : -1.0) : upper ? xi[a] : 1 - xi[a];
      }
      g[k][b] = product;
    }
  }
}

/// Corner k of a cell.
template <int D>
PressureNode<D> corner(const PressureNode<D>& cell, int k) {
  PressureNode<D> node = cell;
  for (int a = 0; a < D; ++a) node[a] += k >> (D - 1 - a) & 1;
  return node;
}

}  // namespace scree

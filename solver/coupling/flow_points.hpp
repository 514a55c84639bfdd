// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/base/pack.hpp"
#include "solver/coupling/pressure_lattice.hpp"
#include "solver/exec/aligned.hpp"
#include "solver/grid/block.hpp"

namespace scree {

/// Points of a chunk in one pressure cell, from one place in the chunk's order to another.
template <int D>
struct FlowRun {
  PressureNode<D> cell{};
  std::int64_t begin = 0, end = 0;
};

/// The points of one block of one body. Points of all chunks are numbered chunk by chunk.
template <int D>
struct FlowChunk {
  std::int64_t begin = 0, end = 0;
  BlockCoord<D> block{};
  std::int32_t body = 0;
  std::vector<FlowRun<D>> runs;

  /// Lowest pressure cell that a point of the block may lie in, astray or not, and cells an axis
  /// from there on.
  std::int32_t first_cell(int axis, int spacing) const {
    return block_cells / spacing * block[std::size_t(axis)] - 1;
  }
  static constexpr int cells(int spacing) { return block_cells / spacing + 2; }
};

/// The particles of a chunk as a step sees them at its start, field by field, in the chunk's order.
/// Behind the last point every field has room for a vector of lanes.
template <int D>
struct FlowPoints {
  using Field = AlignedVector<double>;
  std::array<Field, D> local;  ///< position in cells from the block's lower corner
  std::array<Field, D> xi;    ///< position within the point's pressure cell, in [0, 1) but at walls
  std::array<Field, D> half;  ///< half the sides of its box, in pressure cells
  Field volume;               ///< present volume [m^3] (2D: m^2)
  Field capacity;             ///< volume/M [m^3/Pa]
  Field mobility;             ///< [m^2/(Pa s)]
  Field content;              ///< capacity times the pressure at the step's start [m^3]
  Field missed;  ///< alpha times the change of volume since the last points that the sum of
                 ///< tr(dt grad v) missed [m^3]
  std::vector<std::int64_t> place;  ///< in PoreStates
  std::vector<char> loaded;         ///< by a traction: its moment counts
  /// Of loaded points: sum over faces of force (row) times place of the face from the point
  /// (column), D x D [N m]. Empty, like `loaded`, where no point is loaded.
  std::vector<std::array<double, D * D>> moments;

  void resize(std::int64_t points, bool with_moments) {
    const std::size_t room = std::size_t(points) + lanes_of<Lanes<double>>;
    for (int a = 0; a < D; ++a) {
      for (Field* f : {&local[std::size_t(a)], &xi[std::size_t(a)], &half[std::size_t(a)]}) {
        f->resize(room);
      }
    }
    for (Field* f : {&volume, &capacity, &mobility, &content, &missed}) f->resize(room);
    place.resize(std::size_t(points));
    loaded.assign(with_moments ? std::size_t(points) : 0, 0);
    moments.resize(loaded.size());
  }
};

/// What the end of a step needs of the points again, by their numbers.
template <int D>
struct KeptPoints {
  using Field = AlignedVector<double>;
  std::array<Field, D> xi;
  Field capacity, mobility;
  std::vector<std::int64_t> place;

  void resize(std::int64_t points) {
    const std::size_t room = std::size_t(points) + lanes_of<Lanes<double>>;
    for (Field& f : xi) f.resize(room);
    capacity.resize(room);
    mobility.resize(room);
    place.resize(std::size_t(points));
  }
  std::int64_t bytes() const {
    return std::int64_t((D + 2) * sizeof(double) * capacity.capacity() + 8 * place.capacity());
  }
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

/// Corner k of a cell.
template <int D>
PressureNode<D> corner(const PressureNode<D>& cell, int k) {
  PressureNode<D> node = cell;
  for (int a = 0; a < D; ++a) node[a] += k >> (D - 1 - a) & 1;
  return node;
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace scree {

/// A regular grid of cubic cells (squares in 2D, where there is one node along z and no cell).
struct Lattice {
  int dimension = 3;
  std::array<double, 3> origin{};              ///< m, of node (0, 0, 0)
  double spacing = 1;                          ///< m
  std::array<std::int64_t, 3> cells{1, 1, 1};  ///< an axis; not used along z in 2D

  std::int64_t nodes(int axis) const {
    return axis < dimension ? cells[static_cast<std::size_t>(axis)] + 1 : 1;
  }
  std::int64_t node_count() const { return nodes(0) * nodes(1) * nodes(2); }
  std::int64_t cell_count() const { return cells[0] * cells[1] * (dimension == 3 ? cells[2] : 1); }
  /// Index of a node; x runs fastest.
  std::int64_t node(const std::array<std::int64_t, 3>& at) const {
    return (at[2] * nodes(1) + at[1]) * nodes(0) + at[0];
  }
  std::array<std::int64_t, 3> node_place(std::int64_t index) const {
    return {index % nodes(0), index / nodes(0) % nodes(1), index / (nodes(0) * nodes(1))};
  }
  std::int64_t cell(const std::array<std::int64_t, 3>& at) const {
    return (at[2] * cells[1] + at[1]) * cells[0] + at[0];
  }
  std::array<std::int64_t, 3> cell_place(std::int64_t index) const {
    return {index % cells[0], index / cells[0] % cells[1], index / (cells[0] * cells[1])};
  }
};

/// Where a point lies in a lattice.
struct LatticePlace {
  std::array<std::int64_t, 3> cell{};
  std::array<double, 3> share{};  ///< 0 to 1 within the cell, an axis
  bool inside = true;             ///< of the lattice, its surface included
};

inline LatticePlace locate(const Lattice& lattice, const double* point) {
  LatticePlace place;
  for (std::size_t a = 0; a < static_cast<std::size_t>(lattice.dimension); ++a) {
    const double x = (point[a] - lattice.origin[a]) / lattice.spacing;
    const auto last = lattice.cells[a] - 1;
    place.inside = place.inside && x >= 0 && x <= static_cast<double>(last + 1);
    if (!place.inside) return place;
    place.cell[a] = std::min(static_cast<std::int64_t>(x), last);
    place.share[a] = x - static_cast<double>(place.cell[a]);
  }
  return place;
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace scree {

/// Node of the pressure lattice, or the cell whose lower node it is.
template <int D>
using PressureNode = std::array<std::int32_t, D>;

/// The lattice that carries the pore pressure: hat functions on nodes `spacing` cells apart, the
/// node 0 at `offset` cells from the domain's lower corner in every axis.
///
/// Around the domain lies a margin of nodes, so that nothing near a face needs a test.
///
/// Walls. Nodes on the wall itself (offset 0) make a mirror plane of it: what lies beyond is the
/// image of what lies within. With offset 1/4 a cell's last quarter reaches into the domain at a
/// lower wall; its outer nodes would have next to no soil, so the hats of the first whole cell go
/// on to the wall.
template <int D>
class PressureLattice {
 public:
  /// Lower and upper face of each axis: whether it is a wall.
  using Walls = std::array<std::array<bool, 2>, D>;

  /// cells: of the domain; a periodic axis needs a multiple of `spacing` of them.
  PressureLattice(int spacing, double offset, const std::array<std::int32_t, D>& cells,
                  const std::array<bool, D>& periodic, const Walls& walls = {})
      : spacing_(spacing), offset_(offset) {
    for (int a = 0; a < D; ++a) {
      wall_[a] = {walls[a][0] ? 0.0 : -infinite, walls[a][1] ? double(cells[a]) : infinite};
      period_[a] = periodic[a] ? cells[a] / spacing : 0;
      first_[a] = periodic[a] ? 0 : int(std::floor((-margin - offset) / spacing));
      const int last = int(std::ceil((cells[a] + margin - offset) / spacing));
      count_[a] = periodic[a] ? period_[a] : last - first_[a] + 1;
    }
  }

  int spacing() const { return spacing_; }
  double offset() const { return offset_; }
  bool periodic() const {
    for (int a = 0; a < D; ++a) {
      if (period_[a] > 0) return true;
    }
    return false;
  }

  /// Where a wall is, in cells from the domain's lower corner; infinite where there is none.
  double wall(int axis, int side) const { return wall_[std::size_t(axis)][std::size_t(side)]; }
  /// Points from here on [cells] lie in the cell first_cell() at least, whose hats go on to them.
  double first_from(int axis) const {
    if (wall(axis, 0) != 0 || offset_ >= 0.5) return infinite;
    return offset_ == 0 ? -deepest : 0.0;
  }
  bool ends_at_wall(int axis) const { return std::isfinite(first_from(axis)); }
  static constexpr std::int32_t first_cell() { return 0; }
  /// Limit of the points' positions [cells]: half a cell beyond walls that have nodes, where nodes
  /// of the velocity begin that walls do not fold onto the same pressures.
  double limit(int axis, int side) const {
    if (offset_ != 0) return side == 0 ? -infinite : infinite;
    return wall(axis, side) + (side == 0 ? -deepest : deepest);
  }

  /// Number of nodes, most of them perhaps far from any particle.
  std::int64_t size() const {
    std::int64_t n = 1;
    for (int a = 0; a < D; ++a) n *= count_[a];
    return n;
  }

  /// Coordinate in units of the spacing, from node 0; u in cells from the domain's lower corner.
  double coordinate(double u) const { return (u - offset_) / spacing_; }

  /// Number of a node; nodes beyond a periodic face are their images.
  std::int64_t index(const PressureNode<D>& node) const {
    std::int64_t at = 0;
    for (int a = 0; a < D; ++a) at = at * count_[a] + local(node[a], a);
    return at;
  }

  PressureNode<D> node(std::int64_t index) const {
    PressureNode<D> n{};
    for (int a = D - 1; a >= 0; --a) {
      n[a] = first_[a] + std::int32_t(index % count_[a]);
      index /= count_[a];
    }
    return n;
  }

 private:
  /// Cells: two blocks beyond the domain hold nodes, whose kernels reach farther, and a spacing.
  static constexpr int margin = 20;
  static constexpr double infinite = std::numeric_limits<double>::infinity(), deepest = 0.5;

  std::int32_t local(std::int32_t node, int a) const {
    if (period_[a] == 0) return node - first_[a];
    return ((node % period_[a]) + period_[a]) % period_[a];
  }

  int spacing_;
  double offset_;
  std::array<std::array<double, 2>, D> wall_{};
  std::array<std::int32_t, D> first_{}, count_{}, period_{};
};

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace scree {

/// Node of the pressure lattice, or the cell whose lower node it is.
template <int D>
using PressureNode = std::array<std::int32_t, D>;

/// The lattice that carries the pore pressure: hat functions on nodes `spacing` cells apart, the
/// node 0 at `offset` cells from the domain's lower corner in every axis.
///
/// For the compact kernel the nodes are midpoints between the velocity lattices G- and G+ (all of
/// them or every second one), offset 1/4; with one lattice they are midpoints of its cells, offset
/// 1/2. Around the domain lies a margin of nodes, so that nothing near a face needs a test.
template <int D>
class PressureLattice {
 public:
  /// cells: of the domain; a periodic axis needs a multiple of `spacing` of them.
  PressureLattice(int spacing, double offset, const std::array<std::int32_t, D>& cells,
                  const std::array<bool, D>& periodic)
      : spacing_(spacing), offset_(offset) {
    for (int a = 0; a < D; ++a) {
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

  std::int32_t local(std::int32_t node, int a) const {
    if (period_[a] == 0) return node - first_[a];
    return ((node % period_[a]) + period_[a]) % period_[a];
  }

  int spacing_;
  double offset_;
  std::array<std::int32_t, D> first_{}, count_{}, period_{};
};

}  // namespace scree

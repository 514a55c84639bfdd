// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/coupling/flow_points.hpp"

namespace scree {

/// Orders the points of a chunk by pressure cell and, within one, by half cell of the velocity's
/// lattices: points of a half cell touch the same nodes.
template <int D>
class PointOrder {
 public:
  /// Room for the positions of the points, in cells from the block's lower corner, in the order of
  /// the block.
  void resize(int points);
  double* local(int axis) { return local_[std::size_t(axis)].data(); }

  /// Sets the chunk's runs and, in their order, `local` and `xi` of the points.
  void arrange(FlowChunk<D>& chunk, const PressureLattice<D>& lattice, FlowPoints<D>& points);
  /// Place in FlowPoints of point i of the block.
  std::int64_t place(int i) const { return place_[std::size_t(i)]; }

 private:
  void find_keys(const FlowChunk<D>& chunk, const PressureLattice<D>& lattice);

  std::array<AlignedVector<double>, D> local_, xi_;
  void order_run(const FlowRun<D>& run, std::int64_t begin);

  std::vector<std::int32_t> key_;      ///< number of the pressure cell among those of the block
  std::vector<std::uint8_t> part_;     ///< number of the half cell in the pressure cell, as order
  std::vector<std::int32_t> by_cell_;  ///< points of the block, cell by cell
  std::vector<std::int64_t> place_;
};

extern template class PointOrder<2>;
extern template class PointOrder<3>;

}  // namespace scree

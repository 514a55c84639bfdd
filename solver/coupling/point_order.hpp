// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/coupling/flow_points.hpp"

namespace scree {

/// The order of the points of chunks: by pressure cell and, within one, by half cell of the
/// velocity's lattices; points of a half cell touch the same nodes. It is kept from step to step as
/// long as no point of a chunk has left its half cell.
template <int D>
class PointOrder {
 public:
  using Wide = Lanes<double>;
  static constexpr int width = lanes_of<Wide>;

  /// Where a vector of points is.
  struct Spot {
    Wide local[D];  ///< in cells from the block's lower corner, not beyond the lattice's limits
    Wide xi[D];     ///< within its pressure cell
    Wide cell;      ///< number of that among those of the block
    Wide part;      ///< number of the half cell within the pressure cell, as order
  };

  explicit PointOrder(const PressureLattice<D>& lattice) : lattice_(lattice) {}

  /// u: cells from the lower corner of the chunk's block.
  Spot find(const FlowChunk<D>& chunk, const double (&u)[D][width]) const;

  /// Room for all points of a step.
  void resize(std::int64_t points);
  /// The particles of the chunks are others than in the last step.
  void forget() { known_ = false; }
  /// Notes where the points from `first` of a chunk on are, in the order of the block; true: where
  /// they were.
  bool note(const FlowChunk<D>& chunk, int first, int count, const double (&u)[D][width]);
  /// Sets the runs of a chunk whose points have moved.
  void arrange(FlowChunk<D>& chunk);
  /// All chunks have been arranged.
  void finish() { known_ = true; }
  bool known() const { return known_; }
  /// Place in the order of its chunk of point i of the block.
  std::int32_t place(const FlowChunk<D>& chunk, int i) const {
    return place_[std::size_t(chunk.begin + i)];
  }

  std::int64_t bytes() const { return std::int64_t(4 * place_.capacity() + 2 * key_.capacity()); }

 private:
  static constexpr int parts = 1 << (2 * D);  ///< half cells of a pressure cell

  PressureLattice<D> lattice_;
  bool known_ = false;
  std::vector<std::uint16_t> key_;   ///< of the cell and the half cell, in the order of the blocks
  std::vector<std::int32_t> place_;  ///< the same order
};

extern template class PointOrder<2>;
extern template class PointOrder<3>;

}  // namespace scree

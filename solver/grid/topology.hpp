// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/boundary/faces.hpp"
#include "solver/grid/block.hpp"

namespace scree {

/// What a lower or upper domain face does to the lattice: nothing, mirror it, or wrap it.
enum class FaceKind { none, mirror, periodic };

/// The domain as the grid sees it: `cells` an axis, node 0 of lattice 0 on the lower faces.
template <int D>
struct GridDomain {
  std::array<std::int32_t, D> cells{};
  std::array<std::array<FaceKind, 2>, D> faces{};  ///< [axis][0 = lower, 1 = upper]
  int lattices = 1;
};

/// Node index of the mirror image of node `index` of a lattice, for the face on `side`.
/// Lattice 0 has nodes at i, lattice 1 at i + 1/2.
inline std::int32_t mirrored_node(std::int32_t index, std::int32_t cells, int side, int lattice) {
  return static_cast<std::int32_t>(mirror_index(index, side == 0 ? 0 : cells, lattice));
}

/// Node within [0, cells) that a node beyond periodic faces repeats.
constexpr std::int32_t periodic_node(std::int32_t index, std::int32_t cells) {
  return ((index % cells) + cells) % cells;
}

/// The set of blocks that hold nodes, sorted by key, with their neighbours.
///
/// Built from the blocks that hold particles: those, all their neighbours, and the blocks that hold
/// the mirror or periodic images of nodes beyond a face.
template <int D>
class Topology {
 public:
  void build(const std::vector<std::uint64_t>& occupied, const GridDomain<D>& domain);

  int size() const { return static_cast<int>(keys_.size()); }
  const std::vector<std::uint64_t>& keys() const { return keys_; }
  BlockCoord<D> coord(int block) const { return block_coord<D>(keys_[block]); }
  /// Index of the block with this key, -1 if it is not active.
  int find(std::uint64_t key) const;
  /// Indices of the 3^D blocks around `block` (itself in the middle, last axis fastest); -1 = none.
  const std::int32_t* neighbours(int block) const {
    return neighbours_.data() + static_cast<std::size_t>(block) * neighbour_count<D>;
  }
  const std::vector<std::int32_t>& neighbour_table() const { return neighbours_; }

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<std::int32_t> neighbours_;
};

extern template class Topology<2>;
extern template class Topology<3>;

}  // namespace scree

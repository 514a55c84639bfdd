// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "solver/grid/block.hpp"

namespace scree {

/// Shape of a block's arena: extent^D nodes of 4 values for each lattice, lattice after lattice.
template <class Kernel, int D>
struct ArenaShape {
  static constexpr int extent = Kernel::arena_extent;
  static constexpr int lattice_nodes = power(extent, D);
  static constexpr int nodes = Kernel::lattices * lattice_nodes;
  static constexpr int values = nodes * node_values;
};

/// Where an arena node lies in the grid.
struct NodePlace {
  std::int32_t neighbour;  ///< 0 .. 3^D - 1
  std::int32_t node;       ///< index within that block's record array, lattice included
};

/// Grid place of arena node `n` (lattice-major, last axis fastest).
template <class Kernel, int D>
SCREE_FN constexpr NodePlace arena_place(int n) {
  using Shape = ArenaShape<Kernel, D>;
  const int lattice = n / Shape::lattice_nodes;
  int rest = n % Shape::lattice_nodes;
  NodePlace place{0, 0};
  int neighbour_stride = 1;
  int node_stride = 1;
  for (int a = D - 1; a >= 0; --a) {
    const int node = Kernel::first_node(lattice) + rest % Shape::extent;
    rest /= Shape::extent;
    place.neighbour += (block_of_node(node) + 1) * neighbour_stride;
    place.node += node_in_block(node) * node_stride;
    neighbour_stride *= 3;
    node_stride *= block_cells;
  }
  place.node += lattice * block_node_count<D>;
  return place;
}

/// Neighbouring arena nodes on the last axis that are also neighbours in the grid.
struct NodeRun {
  std::int32_t first;  ///< arena node
  std::int32_t count;
  NodePlace place;  ///< of the first node
};

/// All runs, made at compile time for the CPU.
template <class Kernel, int D>
class ArenaRuns {
 public:
  constexpr ArenaRuns() : runs_{}, count_(0) {
    for (int n = 0; n < ArenaShape<Kernel, D>::nodes; ++n) {
      const NodePlace place = arena_place<Kernel, D>(n);
      if (n % ArenaShape<Kernel, D>::extent != 0 && continues(runs_[count_ - 1], place)) {
        ++runs_[count_ - 1].count;
      } else {
        runs_[count_++] = {n, 1, place};
      }
    }
  }
  constexpr const NodeRun* begin() const { return runs_; }
  constexpr const NodeRun* end() const { return runs_ + count_; }

 private:
  static constexpr bool continues(const NodeRun& run, const NodePlace& place) {
    return place.neighbour == run.place.neighbour && place.node == run.place.node + run.count;
  }

  NodeRun runs_[ArenaShape<Kernel, D>::nodes];
  int count_;
};

}  // namespace scree

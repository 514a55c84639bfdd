// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

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

/// The nodes of a line along the last axis that lie in one block.
struct LineCut {
  std::int32_t first;  ///< place in the line
  std::int32_t count;
  NodePlace shift;  ///< from the line's first node
};

/// How the blocks cut the lines of a lattice, and where each line begins.
template <class Kernel, int D, int lattice>
struct ArenaLines {
  using Shape = ArenaShape<Kernel, D>;
  static constexpr int count = Shape::lattice_nodes / Shape::extent;
  static constexpr int max_cuts = 3;

  NodePlace line[count];  ///< of the first node
  LineCut cut[max_cuts];
  int cuts;

  constexpr ArenaLines() : line{}, cut{}, cuts(0) {
    constexpr int first = lattice * Shape::lattice_nodes;
    for (int l = 0; l < count; ++l) line[l] = arena_place<Kernel, D>(first + l * Shape::extent);
    int block = -1;
    for (int z = 0; z < Shape::extent; ++z) {
      const NodePlace place = arena_place<Kernel, D>(first + z);
      if (place.neighbour != block) {
        block = place.neighbour;
        cut[cuts++] = {z, 0, {block - line[0].neighbour, place.node - line[0].node}};
      }
      ++cut[cuts - 1].count;
    }
  }
};

namespace detail {

template <class Kernel, int D, int lattice, class F, std::size_t... cut>
[[gnu::always_inline]] inline void each_run_of_line(int l, F&& f, std::index_sequence<cut...>) {
  static constexpr ArenaLines<Kernel, D, lattice> lines;
  const int first = lattice * ArenaShape<Kernel, D>::lattice_nodes + l * Kernel::arena_extent;
  (f(std::integral_constant<int, lines.cut[cut].count>{}, first + lines.cut[cut].first,
     NodePlace{lines.line[l].neighbour + lines.cut[cut].shift.neighbour,
               lines.line[l].node + lines.cut[cut].shift.node}),
   ...);
}

}  // namespace detail

/// Lines of all lattices of an arena.
template <class Kernel, int D>
inline constexpr int arena_lines = Kernel::lattices* ArenaLines<Kernel, D, 0>::count;

/// For the lines first .. last - 1, lattice after lattice: f(count, arena node, place in the grid)
/// for each run of neighbouring nodes that are neighbours in the grid too. The count is a type, so
/// that copies are unrolled.
template <class Kernel, int D, int lattice = 0, class F>
[[gnu::always_inline]] inline void each_run(int first, int last, F&& f) {
  constexpr ArenaLines<Kernel, D, lattice> lines;
  for (int l = first < 0 ? 0 : first; l < last && l < lines.count; ++l) {
    detail::each_run_of_line<Kernel, D, lattice>(l, f, std::make_index_sequence<lines.cuts>{});
  }
  if constexpr (lattice + 1 < Kernel::lattices) {
    each_run<Kernel, D, lattice + 1>(first - lines.count, last - lines.count, f);
  }
}

}  // namespace scree

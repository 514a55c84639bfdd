// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "solver/base/config.hpp"

namespace scree {

/// Blocks of 4 cells an axis tile the domain; block b owns the nodes 4b .. 4b+3 of every lattice.
inline constexpr int block_cells = 4;

/// A particle's home block holds u in [home_begin, home_end), u in cells from the block's lower
/// corner. The shift by a quarter cell lets both lattices of the compact kernel get by with 6 nodes
/// an axis while a particle may stray by up to max_excursion before it is moved to its new block.
inline constexpr double home_begin = 0.25;
inline constexpr double home_end = home_begin + block_cells;
inline constexpr double max_excursion = 0.25;

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

template <int D>
inline constexpr int block_node_count = power(block_cells, D);
template <int D>
inline constexpr int neighbour_count = power(3, D);

/// Numbers a node record holds: velocity or momentum (D, padded to 3) and mass at index 3.
inline constexpr int node_values = 4;
inline constexpr int mass_slot = 3;

template <int D>
using BlockCoord = std::array<std::int32_t, D>;

/// Sortable key of a block; coordinates in [-2^20, 2^20), first axis most significant.
template <int D>
constexpr std::uint64_t block_key(const BlockCoord<D>& c) {
  std::uint64_t key = 0;
  for (int a = 0; a < D; ++a) {
    key = (key << 21) | static_cast<std::uint64_t>(static_cast<std::int64_t>(c[a]) + (1 << 20));
  }
  return key;
}

template <int D>
constexpr BlockCoord<D> block_coord(std::uint64_t key) {
  BlockCoord<D> c{};
  for (int a = D - 1; a >= 0; --a) {
    c[a] = static_cast<std::int32_t>(static_cast<std::int64_t>(key & 0x1fffffu) - (1 << 20));
    key >>= 21;
  }
  return c;
}

/// floor(a / 4) and a mod 4 for negative a too.
SCREE_FN constexpr int block_of_node(int node) {
  return node >= 0 ? node / block_cells : -((block_cells - 1 - node) / block_cells);
}
SCREE_FN constexpr int node_in_block(int node) { return node - block_cells * block_of_node(node); }

}  // namespace scree

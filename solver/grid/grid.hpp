// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "solver/exec/aligned.hpp"
#include "solver/exec/thread_pool.hpp"
#include "solver/grid/topology.hpp"

namespace scree {

/// Node data on the active blocks: for each block, lattice and node one record of 4 values,
/// {momentum or velocity (D, zero-padded to 3), mass}.
template <int D, class T>
class Grid {
 public:
  explicit Grid(int lattices) : lattices_(lattices) {}

  int lattices() const { return lattices_; }
  const Topology<D>& topology() const { return topology_; }
  Topology<D>& topology() { return topology_; }

  /// Values of one block in a channel.
  std::size_t block_values() const {
    return std::size_t(lattices_) * block_node_count<D> * node_values;
  }
  std::size_t size() const { return std::size_t(topology_.size()) * block_values(); }

  /// Zeroes a channel of the present topology.
  void clear(AlignedVector<T>& channel, ThreadPool& pool) const {
    channel.resize(size());
    const std::size_t n = block_values();
    pool.for_each(
        topology_.size(),
        [&](std::int64_t b, int) {
          T* p = channel.data() + std::size_t(b) * n;
          for (std::size_t i = 0; i < n; ++i) p[i] = T(0);
        },
        16);
  }

  /// Carries a channel of another block set over to the present one; blocks that are new start at
  /// zero.
  void carry_over(const Topology<D>& before, const AlignedVector<T>& from, AlignedVector<T>& to,
                  ThreadPool& pool) const {
    to.resize(size());
    const std::size_t n = block_values();
    pool.for_each(
        topology_.size(),
        [&](std::int64_t b, int) {
          T* p = to.data() + std::size_t(b) * n;
          const int old = before.find(topology_.keys()[std::size_t(b)]);
          if (old < 0) {
            std::fill_n(p, n, T(0));
          } else {
            std::copy_n(from.data() + std::size_t(old) * n, n, p);
          }
        },
        16);
  }

  /// Index of a node's record (in records, not values); -1 if its block is not active.
  std::int64_t record(const BlockCoord<D>& node, int lattice) const {
    BlockCoord<D> block{};
    std::int64_t local = 0;
    for (int a = 0; a < D; ++a) {
      block[a] = block_of_node(node[a]);
      local = local * block_cells + node_in_block(node[a]);
    }
    const int b = topology_.find(block_key<D>(block));
    if (b < 0) return -1;
    return (std::int64_t(b) * lattices_ + lattice) * block_node_count<D> + local;
  }

  /// Lattice index of local node n of a block.
  BlockCoord<D> node(int block, int n) const {
    BlockCoord<D> c = topology_.coord(block);
    for (int a = D - 1; a >= 0; --a) {
      c[a] = c[a] * block_cells + n % block_cells;
      n /= block_cells;
    }
    return c;
  }

 private:
  int lattices_;
  Topology<D> topology_;
};

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>

#include "solver/exec/arena.hpp"

namespace scree {

/// The arena of kernels with two nodes an axis: row n holds the quads of the nodes n, n + 1,
/// n + e, n + e + 1 (e nodes an axis), that is of the 2 x 2 corners of a cell in the last two axes.
/// A particle then touches whole aligned rows, one a lattice in 2D and two in 3D, at the price of
/// four copies of each node. Rows that would leave the lattice exist but are never touched.
template <class Kernel, int D, class T>
struct RowArena {
  using Shape = ArenaShape<Kernel, D>;
  static constexpr int row_values = 4 * node_values;
  static constexpr int extent = Shape::extent;
  static constexpr int values = Shape::nodes * row_values;

  /// nodes: one quad a node; each goes to the rows that hold it.
  static inline void fill(const T* nodes, T* rows) {
    each_line([&](int line, int y) {
      if (y == extent - 1) return;
      const Quad* low = reinterpret_cast<const Quad*>(nodes) + line;
      Quad* row = reinterpret_cast<Quad*>(rows + line * row_values);
      SCREE_UNROLL for (int z = 0; z < extent - 1; ++z) {
        row[4 * z] = low[z];
        row[4 * z + 1] = low[z + 1];
        row[4 * z + 2] = low[extent + z];
        row[4 * z + 3] = low[extent + z + 1];
      }
    });
  }

  static inline void clear(T* rows) {
    each_line([&](int line, int y) {
      if (y == extent - 1) return;
      std::memset(rows + line * row_values, 0, (extent - 1) * row_values * sizeof(T));
    });
  }

  /// nodes: the sum over the copies of each.
  static inline void sum(const T* rows, T* nodes) {
    each_line([&](int line, int y) {
      T* out = nodes + line * node_values;
      std::memset(out, 0, extent * node_values * sizeof(T));
      if (y < extent - 1) add_line(rows + line * row_values, out);
      if (y > 0) add_line(rows + (line - extent) * row_values + 2 * node_values, out);
    });
  }

 private:
  typedef T Quad __attribute__((vector_size(4 * sizeof(T)), may_alias));

  /// f(first node, place on the last axis but one) for all lines along the last axis.
  template <class F>
  static inline void each_line(F&& f) {
    for (int n = 0; n < Shape::nodes; n += extent) f(n, n / extent % extent);
  }

  /// Adds the first two quads of each row of a line to its nodes.
  static SCREE_FN void add_line(const T* row, T* nodes) {
    Quad* out = reinterpret_cast<Quad*>(nodes);
    SCREE_UNROLL for (int z = 0; z < extent; ++z) {
      if (z < extent - 1) out[z] += *reinterpret_cast<const Quad*>(row + z * row_values);
      if (z > 0) {
        out[z] += *reinterpret_cast<const Quad*>(row + (z - 1) * row_values + node_values);
      }
    }
  }
};

}  // namespace scree

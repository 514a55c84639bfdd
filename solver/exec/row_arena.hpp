// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <type_traits>

#include "solver/exec/arena.hpp"
#include "solver/exec/node_row.hpp"

namespace scree {

/// Arenas keep the quads {vector, mass} of nodes in rows, one register each, so that particles load
/// and store whole aligned rows that overlap no others in part; a node is copied to all rows that
/// hold it, and its sum is that of its copies.
///
/// stride: numbers from a row to the next; row n begins with node n. node_step, line_step: numbers
/// from a node to its neighbour on the last axis, and on the axis before, within the rows that a
/// particle at that node touches.
template <class Kernel, int D, class T>
struct ArenaBase {
  using Shape = ArenaShape<Kernel, D>;
  static constexpr int extent = Shape::extent;

 protected:
  typedef T Quad __attribute__((vector_size(4 * sizeof(T)), may_alias));
  static SCREE_FN const Quad& quad(const T* p) { return *reinterpret_cast<const Quad*>(p); }
  static SCREE_FN Quad& quad(T* p) { return *reinterpret_cast<Quad*>(p); }
  /// Two quads side by side, aligned as one.
  typedef T Pair __attribute__((vector_size(8 * sizeof(T)), aligned(4 * sizeof(T)), may_alias));
  static SCREE_FN const Pair& pair(const T* p) { return *reinterpret_cast<const Pair*>(p); }
  static SCREE_FN Pair& pair(T* p) { return *reinterpret_cast<Pair*>(p); }

  /// f(first node, place on the last axis but one) for all lines along the last axis.
  template <class F>
  static inline void each_line(F&& f) {
    for (int n = 0; n < Shape::nodes; n += extent) f(n, n / extent % extent);
  }
};

/// Row n is node n: no copies.
template <class Kernel, int D, class T>
struct NodeArena : ArenaBase<Kernel, D, T> {
  using Shape = ArenaShape<Kernel, D>;
  static constexpr int stride = node_values;
  static constexpr int values = Shape::nodes * stride;
  static constexpr int node_step = stride;
  static constexpr int line_step = Shape::extent * stride;

  static inline void clear(T* rows) { std::memset(rows, 0, values * sizeof(T)); }
};

/// Row n: the nodes n, n + 1.
template <class Kernel, int D, class T>
struct PairArena : ArenaBase<Kernel, D, T> {
  using Base = ArenaBase<Kernel, D, T>;
  using Base::extent;
  using typename Base::Quad;
  using typename Base::Shape;
  static constexpr int stride = 2 * node_values;
  static constexpr int values = Shape::nodes * stride;
  static constexpr int node_step = stride;
  static constexpr int line_step = extent * stride;

  /// nodes: one quad a node; each goes to the rows that hold it.
  static inline void fill(const T* nodes, T* rows) {
    Base::each_line([&](int line, int) {
      const T* node = nodes + line * node_values;
      T* row = rows + line * stride;
      SCREE_UNROLL for (int z = 0; z + 1 < extent; ++z) {
        Base::pair(row + z * stride) = Base::pair(node + z * node_values);
      }
      Base::quad(row + (extent - 1) * stride) = Base::quad(node + (extent - 1) * node_values);
      Base::quad(row + (extent - 1) * stride + node_values) = Quad{};
    });
  }

  static inline void clear(T* rows) { std::memset(rows, 0, values * sizeof(T)); }

  /// nodes: the sum over the copies of each.
  static inline void sum(const T* rows, T* nodes) {
    Base::each_line([&](int line, int) {
      const T* row = rows + line * stride;
      T* node = nodes + line * node_values;
      Quad carry{};
      SCREE_UNROLL for (int z = 0; z < extent; ++z) {
        Base::quad(node + z * node_values) = carry + Base::quad(row + z * stride);
        carry = Base::quad(row + z * stride + node_values);
      }
    });
  }
};

/// Row n: the nodes n, n + 1, n + e, n + e + 1 (e nodes an axis), that is the 2 x 2 corners of a
/// cell in the last two axes. Rows that would leave the lattice exist but are never touched.
template <class Kernel, int D, class T>
struct CellArena : ArenaBase<Kernel, D, T> {
  using Base = ArenaBase<Kernel, D, T>;
  using Base::extent;
  using typename Base::Quad;
  using typename Base::Shape;
  static constexpr int stride = 4 * node_values;
  static constexpr int values = Shape::nodes * stride;
  static constexpr int node_step = node_values;
  static constexpr int line_step = 2 * node_values;

  static inline void fill(const T* nodes, T* rows) {
    Base::each_line([&](int line, int y) {
      if (y == extent - 1) return;
      const T* low = nodes + line * node_values;
      T* row = rows + line * stride;
      SCREE_UNROLL for (int z = 0; z < extent - 1; ++z) {
        Base::pair(row + z * stride) = Base::pair(low + z * node_values);
        Base::pair(row + z * stride + line_step) = Base::pair(low + (extent + z) * node_values);
      }
    });
  }

  static inline void clear(T* rows) {
    Base::each_line([&](int line, int y) {
      if (y == extent - 1) return;
      std::memset(rows + line * stride, 0, (extent - 1) * stride * sizeof(T));
    });
  }

  static inline void sum(const T* rows, T* nodes) {
    Base::each_line([&](int line, int y) {
      const T* upper = rows + line * stride;  // whose first pairs are this line's nodes
      const T* lower = rows + (line - extent) * stride + line_step;  // whose second pairs are
      T* out = nodes + line * node_values;
      if (y == 0) {
        add_pairs([&](int z) { return Base::pair(upper + z * stride); }, out);
      } else if (y == extent - 1) {
        add_pairs([&](int z) { return Base::pair(lower + z * stride); }, out);
      } else {
        add_pairs(
            [&](int z) { return Base::pair(upper + z * stride) + Base::pair(lower + z * stride); },
            out);
      }
    });
  }

 private:
  /// Sets the nodes of a line; both(z): what is to be added to the nodes z and z + 1.
  template <class F>
  static SCREE_FN void add_pairs(F&& both, T* nodes) {
    Quad carry{};
    SCREE_UNROLL for (int z = 0; z < extent - 1; ++z) {
      const auto two = both(z);
      Base::quad(nodes + z * node_values) =
          carry + Quad(__builtin_shufflevector(two, two, 0, 1, 2, 3));
      carry = Quad(__builtin_shufflevector(two, two, 4, 5, 6, 7));
    }
    Base::quad(nodes + (extent - 1) * node_values) = carry;
  }
};

/// Row n: the nodes n, n + 1, n + 2 and a quad that is always zero. The last two rows of a line
/// would leave it and are never touched.
template <class Kernel, int D, class T>
struct LineArena : ArenaBase<Kernel, D, T> {
  using Base = ArenaBase<Kernel, D, T>;
  using Base::extent;
  using typename Base::Quad;
  using typename Base::Shape;
  static constexpr int stride = 4 * node_values;
  static constexpr int values = Shape::nodes * stride;
  static constexpr int node_step = node_values;
  static constexpr int line_step = extent * stride;

  static inline void fill(const T* nodes, T* rows) {
    Base::each_line([&](int line, int) {
      const T* node = nodes + line * node_values;
      T* row = rows + line * stride;
      SCREE_UNROLL for (int z = 0; z < touched; ++z) {
        SCREE_UNROLL for (int i = 0; i < 3; ++i) {
          Base::quad(row + z * stride + i * node_values) = Base::quad(node + (z + i) * node_values);
        }
        Base::quad(row + z * stride + 3 * node_values) = Quad{};
      }
    });
  }

  static inline void clear(T* rows) {
    Base::each_line(
        [&](int line, int) { std::memset(rows + line * stride, 0, touched * stride * sizeof(T)); });
  }

  static inline void sum(const T* rows, T* nodes) {
    Base::each_line([&](int line, int) {
      const T* row = rows + line * stride;
      T* node = nodes + line * node_values;
      SCREE_UNROLL for (int z = 0; z < extent; ++z) {
        Quad all{};
        SCREE_UNROLL for (int i = 0; i < 3; ++i) {
          const bool held = z >= i && z - i < touched;
          if (held) all += Base::quad(row + (z - i) * stride + i * node_values);
        }
        Base::quad(node + z * node_values) = all;
      }
    });
  }

 private:
  static constexpr int touched = extent - 2;  ///< rows of a line
};

/// The arena with as many nodes in a row as a register holds.
template <class Kernel, int D, class T, int row_nodes = NodeRow<T>::part_quads>
using RowArena = std::conditional_t<
    row_nodes == 1, NodeArena<Kernel, D, T>,
    std::conditional_t<row_nodes == 2, PairArena<Kernel, D, T>,
                       std::conditional_t<Kernel::support == 2, CellArena<Kernel, D, T>,
                                          LineArena<Kernel, D, T>>>>;

}  // namespace scree

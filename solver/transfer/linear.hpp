// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/transfer/stencil.hpp"

namespace scree {

/// Hat functions on one lattice (nodes at i): the baseline that shows the cell-crossing error.
/// D = diag(f (1 - f)) is singular at nodes, so only pic and flip use it.
struct Linear {
  static constexpr const char* name = "linear";
  static constexpr int lattices = 1;
  static constexpr int support = 2;
  static constexpr int arena_extent = 6;
  SCREE_FN static constexpr int first_node(int) { return 0; }
  static constexpr bool has_inverse_moment = false;

  template <class V, int D>
  struct Point {
    Stencil<V, D, 1, 2> stencil;
  };

  /// u: cells from the block's lower corner, in [0, 4.5).
  template <class V, int D>
  SCREE_FN static Point<V, D> at(const V (&u)[D]) {
    using T = Scalar<V>;
    Point<V, D> p;
    V node[D];
    for (int a = 0; a < D; ++a) {
      node[a] = floor(u[a]);
      const V f = u[a] - node[a];
      p.stencil.weight[0][a][1] = f;
      p.stencil.weight[0][a][0] = T(1) - f;
      p.stencil.offset[0][a] = -f;
    }
    p.stencil.base[0] = arena_index<V, D>(node, arena_extent, 0);
    return p;
  }

  template <class V, int D>
  SCREE_FN static Slopes<V, D, 1, 2> slopes(const Point<V, D>&) {
    using T = Scalar<V>;
    Slopes<V, D, 1, 2> out;
    for (int a = 0; a < D; ++a) {
      out.slope[0][a][0] = broadcast<V>(T(-1));
      out.slope[0][a][1] = broadcast<V>(T(1));
    }
    return out;
  }
};

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/transfer/stencil.hpp"

namespace scree {

/// Quadratic B-spline on one lattice (nodes at i): Steffen, Kirby, Berzins, IJNME 76 (2008);
/// D = dx^2/4: Jiang et al., The affine particle-in-cell method, ACM TOG 34(4), 2015.
struct Quadratic {
  static constexpr const char* name = "quadratic";
  static constexpr int lattices = 1;
  static constexpr int support = 3;
  static constexpr int arena_extent = 7;
  SCREE_FN static constexpr int first_node(int) { return -1; }
  static constexpr bool has_inverse_moment = true;

  template <class V, int D>
  struct Point {
    Stencil<V, D, 1, 3> stencil;
    V local[D];  ///< particle minus lowest node [cells], in [1/2, 3/2)
  };

  /// u: cells from the block's lower corner, in [0, 4.5).
  template <class V, int D>
  SCREE_FN static Point<V, D> at(const V (&u)[D]) {
    using T = Scalar<V>;
    Point<V, D> p;
    V node[D];
    for (int a = 0; a < D; ++a) {
      const V low = floor(u[a] - T(0.5));
      const V f = u[a] - low;
      p.local[a] = f;
      p.stencil.weight[0][a][0] = T(0.5) * (T(1.5) - f) * (T(1.5) - f);
      p.stencil.weight[0][a][2] = T(0.5) * (f - T(0.5)) * (f - T(0.5));
      p.stencil.weight[0][a][1] = T(1) - p.stencil.weight[0][a][0] - p.stencil.weight[0][a][2];
      p.stencil.offset[0][a] = -f;
      node[a] = low + T(1);
    }
    p.stencil.base[0] = arena_index<V, D>(node, arena_extent, 0);
    return p;
  }

  /// M D, D = 1/4 cells^2.
  template <class V, int D>
  SCREE_FN static void times_moment(const Point<V, D>&, const V (&m)[D][D], V (&out)[D][D]) {
    for (int r = 0; r < D; ++r) {
      for (int a = 0; a < D; ++a) out[r][a] = m[r][a] * Scalar<V>(0.25);
    }
  }

  /// M D^-1.
  template <class V, int D>
  SCREE_FN static void times_inverse_moment(const Point<V, D>&, const V (&m)[D][D],
                                            V (&out)[D][D]) {
    for (int r = 0; r < D; ++r) {
      for (int a = 0; a < D; ++a) out[r][a] = m[r][a] * Scalar<V>(4);
    }
  }

  template <class V, int D>
  SCREE_FN static Slopes<V, D, 1, 3> slopes(const Point<V, D>& p) {
    using T = Scalar<V>;
    Slopes<V, D, 1, 3> out;
    for (int a = 0; a < D; ++a) {
      out.slope[0][a][0] = p.local[a] - T(1.5);
      out.slope[0][a][2] = p.local[a] - T(0.5);
      out.slope[0][a][1] = -(out.slope[0][a][0] + out.slope[0][a][2]);
    }
    return out;
  }
};

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/transfer/stencil.hpp"

namespace scree {

/// |sin(2 pi u)|/(2 pi) as a function of q = h^2, h = (u mod 1/2) - 1/4, q in [0, 1/16].
///
/// Equals cos(2 pi h)/(2 pi) = (1/16 - q) Q(q); the factor makes it vanish exactly at the cell
/// edges, so the kernel stays continuous. Q is a minimax polynomial: absolute error 4e-16
/// (double, degree 6), 3e-8 (float, degree 3).
template <class V>
SCREE_FN V compact_sine(const V& q) {
  using T = Scalar<V>;
  if constexpr (sizeof(T) == sizeof(float)) {
    V p = q * T(-8.93572407371708414) + T(13.0062185087916908);
    p = p * q + T(-9.52171420067259478);
    p = p * q + T(2.54647895547724999);
    return p * (T(0.0625) - q);
  } else {
    V p = q * T(0.26174338373920325) + T(-1.24039613238393387);
    p = p * q + T(4.12828440805791093);
    p = p * q + T(-9.3302129158446277);
    p = p * q + T(13.01773654359219);
    p = p * q + T(-9.52181702590078116);
    p = p * q + T(2.54647908947032006);
    return p * (T(0.0625) - q);
  }
}

/// sin(2 pi h) for h in [-1/4, 1/4]: Taylor series in x = 2 pi h, |x| <= pi/2, up to x^21
/// (remainder (pi/2)^23/23! = 1.3e-18).
template <class V>
SCREE_FN V compact_sin_2pi(const V& h) {
  using T = Scalar<V>;
  const V x = h * T(6.283185307179586476925);
  const V z = x * x;
  V p = broadcast<V>(T(1.0));
  for (int k = 20; k >= 2; k -= 2) p = T(1) - z * p * T(1.0 / (k * (k + 1)));
  return x * p;
}

/// The compact kernel on the dual grid: CK-MPM, Liu, Wang, Li, ACM TOG 44(4), 2025, eq. 4, 5.
///
/// Lattice 0 (G-) has its nodes at i, lattice 1 (G+) at i + 1/2, in cells from the domain's lower
/// corner (the paper's pair, moved by a quarter cell, so that faces at multiples of a cell are
/// mirror planes of both lattices).
struct Compact {
  static constexpr const char* name = "compact";
  static constexpr int lattices = 2;
  static constexpr int support = 2;
  static constexpr int arena_extent = 6;
  /// Lowest arena node of a lattice, relative to the block's first node.
  SCREE_FN static constexpr int first_node(int lattice) { return lattice == 0 ? 0 : -1; }
  static constexpr bool has_inverse_moment = true;

  /// Everything about one particle's position (u: cells from the block's lower corner, in
  /// [0, 4.5)).
  template <class V, int D>
  struct Point {
    Stencil<V, D, 2, 2> stencil;
    V sine[D];              ///< s_a = sin(2 pi u_a)/(2 pi)
    V inverse_diagonal[D];  ///< 1/q_a, q_a = d_a - s_a^2
    V quarter_offset[D];    ///< h_a, position in the half cell, in [-1/4, 1/4)
    MaskOf<V> upper_half[D];
  };

  template <class V, int D>
  SCREE_FN static Point<V, D> at(const V (&u)[D]) {
    using T = Scalar<V>;
    Point<V, D> p;
    V node[2][D];
    for (int a = 0; a < D; ++a) {
      const V cell = floor(u[a]);
      const V f = u[a] - cell;
      const MaskOf<V> upper = f >= T(0.5);
      const V h = select(upper, f - T(0.5), f) - T(0.25);
      const V q = h * h;
      const V magnitude = compact_sine(q);
      const V s = select(upper, -magnitude, magnitude);
      const V f_plus = select(upper, f - T(0.5), f + T(0.5));
      p.stencil.weight[0][a][1] = f - s;
      p.stencil.weight[0][a][0] = T(1) - p.stencil.weight[0][a][1];
      p.stencil.weight[1][a][1] = f_plus + s;  // the sine changes sign on the other lattice
      p.stencil.weight[1][a][0] = T(1) - p.stencil.weight[1][a][1];
      p.stencil.offset[0][a] = -f;
      p.stencil.offset[1][a] = -f_plus;
      node[0][a] = cell;
      node[1][a] = select(upper, cell + T(1), cell);  // arena of lattice 1 starts one node lower
      const V d = T(0.1875) - q - T(0.5) * magnitude;
      p.sine[a] = s;
      p.inverse_diagonal[a] = rcp(d - s * s);
      p.quarter_offset[a] = h;
      p.upper_half[a] = upper;
    }
    p.stencil.base[0] = arena_index<V, D>(node[0], arena_extent, 0);
    p.stencil.base[1] = arena_index<V, D>(node[1], arena_extent, 1);
    return p;
  }

  /// M D, D [cells^2] = diag(q) + s s^T.
  template <class V, int D>
  SCREE_FN static void times_moment(const Point<V, D>& p, const V (&m)[D][D], V (&out)[D][D]) {
    for (int r = 0; r < D; ++r) {
      V projection = m[r][0] * p.sine[0];
      for (int a = 1; a < D; ++a) projection = projection + m[r][a] * p.sine[a];
      for (int a = 0; a < D; ++a) {
        out[r][a] = m[r][a] / p.inverse_diagonal[a] + projection * p.sine[a];
      }
    }
  }

  /// M D^-1 with D [cells^2] = diag(q) + s s^T in closed form (the paper inverts numerically):
  /// Sherman-Morrison, D^-1 = diag(1/q) - t t^T/(1 + s.t), t = s/q. The order M D^-1 keeps the
  /// particle's virial symmetric.
  template <class V, int D>
  SCREE_FN static void times_inverse_moment(const Point<V, D>& p, const V (&m)[D][D],
                                            V (&out)[D][D]) {
    using T = Scalar<V>;
    V t[D];
    V denominator = broadcast<V>(T(1));
    for (int a = 0; a < D; ++a) {
      t[a] = p.sine[a] * p.inverse_diagonal[a];
      denominator = mul_add(p.sine[a], t[a], denominator);
    }
    const V scale = rcp(denominator);
    for (int r = 0; r < D; ++r) {
      V projection = m[r][0] * t[0];
      for (int a = 1; a < D; ++a) projection = mul_add(m[r][a], t[a], projection);
      projection = projection * scale;
      for (int a = 0; a < D; ++a) {
        out[r][a] = m[r][a] * p.inverse_diagonal[a] - projection * t[a];
      }
    }
  }

  template <class V, int D>
  SCREE_FN static Slopes<V, D, 2, 2> slopes(const Point<V, D>& p) {
    using T = Scalar<V>;
    Slopes<V, D, 2, 2> out;
    for (int a = 0; a < D; ++a) {
      const V sine = compact_sin_2pi(p.quarter_offset[a]);
      const V cosine = select(p.upper_half[a], sine, -sine);  // cos(2 pi u_-)
      out.slope[0][a][1] = T(1) - cosine;
      out.slope[0][a][0] = cosine - T(1);
      out.slope[1][a][1] = T(1) + cosine;
      out.slope[1][a][0] = -T(1) - cosine;
    }
    return out;
  }
};

}  // namespace scree

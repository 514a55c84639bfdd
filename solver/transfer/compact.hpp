// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/transfer/stencil.hpp"

namespace scree {

/// R(w) = (cos(2 pi h)/(2 pi) - 2 w - 8 w^2)/w^3 with w = 1/16 - h^2 in [0, 1/16], a polynomial
/// through Chebyshev points: error 1.7e-13 (double, degree 5), 1e-5 (float, degree 2).
template <class V>
SCREE_FN V compact_remainder(const V& w) {
  using T = Scalar<V>;
  if constexpr (sizeof(T) == sizeof(float)) {
    const V p = w * T(3.8648001753143525) + T(8.3427557740095248);
    return p * w + T(11.36211876538095);
  } else {
    V p = w * T(0.042759006635290524) + T(0.25113666000987351);
    p = p * w + T(1.1433079171032053);
    p = p * w + T(3.7559416738420512);
    p = p * w + T(8.3453183304665330);
    return p * w + T(11.362109860856593);
  }
}

/// K at the distance g from the edge of its support, with r = 1/2 - g, g in [0, 1/2], and R(g r):
/// g - sin(2 pi g)/(2 pi) = g^3 (4 + 8 r - r^3 R).
///
/// The cube as a factor keeps the last digits where the difference loses all of them: a node that
/// only the rims of kernels reach has masses of one sign, in proportion to the forces. Relative
/// error 4e-15 (double), 6e-7 (float); absolute error 4e-17, 3e-9 and a rounding.
template <class V>
SCREE_FN V compact_rim(const V& g, const V& r, const V& remainder) {
  using T = Scalar<V>;
  return (g * g * g) * (T(4) + T(8) * r - (r * r * r) * remainder);
}

/// 1 - cos(2 pi g) = 2 sin^2(pi g) for g in [0, 1/2], small where it is small: Taylor series of the
/// sine in x = pi g <= pi/2 up to x^21 (remainder (pi/2)^23/23! = 1.3e-18).
template <class V>
SCREE_FN V compact_slope(const V& g) {
  using T = Scalar<V>;
  const V x = g * T(3.14159265358979323846);
  const V z = x * x;
  V p = broadcast<V>(T(1.0));
  for (int k = 20; k >= 2; k -= 2) p = T(1) - z * p * T(1.0 / (k * (k + 1)));
  const V sine = x * p;
  return T(2) * sine * sine;
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
    V half_offset[D];       ///< g_a = u_a mod 1/2, position in the half cell
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
      const V g = select(upper, f - T(0.5), f);
      const V r = T(0.5) - g;
      const V w = g * r;
      const V remainder = compact_remainder(w);
      // The weights near g = 0 and near g = 1/2: one lattice each, in turn for both halves.
      const V first = compact_rim(g, r, remainder);
      const V second = compact_rim(r, g, remainder);
      const V magnitude = g - first;  // |sin(2 pi u)|/(2 pi)
      const V s = select(upper, -magnitude, magnitude);
      p.stencil.weight[0][a][0] = select(upper, second, T(1) - first);
      p.stencil.weight[0][a][1] = select(upper, T(1) - second, first);
      p.stencil.weight[1][a][0] = select(upper, T(1) - first, second);
      p.stencil.weight[1][a][1] = select(upper, first, T(1) - second);
      p.stencil.offset[0][a] = -f;
      p.stencil.offset[1][a] = -select(upper, g, f + T(0.5));
      node[0][a] = cell;
      node[1][a] = select(upper, cell + T(1), cell);  // arena of lattice 1 starts one node lower
      const V d = T(0.125) + w - T(0.5) * magnitude;
      p.sine[a] = s;
      p.inverse_diagonal[a] = rcp(d - s * s);
      p.half_offset[a] = g;
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
      const V g = p.half_offset[a];
      const V first = compact_slope(g);
      const V second = compact_slope(T(0.5) - g);
      out.slope[0][a][1] = select(p.upper_half[a], second, first);
      out.slope[1][a][1] = select(p.upper_half[a], first, second);
      for (int k = 0; k < 2; ++k) out.slope[k][a][0] = -out.slope[k][a][1];
    }
    return out;
  }
};

}  // namespace scree

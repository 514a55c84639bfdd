// SPDX-License-Identifier: Apache-2.0
/// \file
/// Return map to the Mohr-Coulomb pyramid with a tension cut-off, in principal strains.
///
/// de Souza Neto, Peric, Owen, Computational Methods for Plasticity, Wiley 2008, section 8.2
/// (planes, edges, apex), here without hardening inside the return, so that every case is a closed
/// form; the cut-off is Rankine's with associated flow. Numbers of equations are those of
/// docs/materials/mohr_coulomb.md: plane (6), edges (7), apex (8), cut-off (9).
#pragma once

#include "solver/base/pack_functions.hpp"
#include "solver/base/tensor.hpp"

namespace scree::detail {

/// The pyramid in stresses divided by 2 mu: (1 + sin phi) t_1 - (1 - sin phi) t_3 <= cohesion, t_1
/// >= t_2 >= t_3, flow along (1 + sin psi, 0, -(1 - sin psi)).
template <class S>
struct MohrCoulombStrength {
  S friction;  ///< sin phi
  S dilation;  ///< sin psi
  S cohesion;  ///< 2 c cos phi/(2 mu)
  S apex;      ///< c cot phi/(2 mu)
  // (3) to (5): with a = N_1 : D : M_1 and b = N_1 : D : M_2 of the two planes at an edge, D = 1 +
  // ratio 1 x 1:
  S plane;                           ///< 1/a
  S compression_sum, extension_sum;  ///< 1/(a + b)
  S compression_gap, extension_gap;  ///< 1/(a - b)
  S slope;                           ///< 1/(1 - sin phi)

  template <class R>
  MohrCoulombStrength<R> as() const {
    return {R(friction),        R(dilation),      R(cohesion),        R(apex),          R(plane),
            R(compression_sum), R(extension_sum), R(compression_gap), R(extension_gap), R(slope)};
  }
};

/// From the sines, the cosine of the friction angle and c/(2 mu); ratio = lambda/(2 mu). Without
/// friction the apex is so far away that no state reaches it.
template <class S, class T>
SCREE_FN MohrCoulombStrength<S> mohr_coulomb_strength(S friction, S cosine, S dilation, S cohesion,
                                                      T ratio) {
  const S least = broadcast<S>(sizeof(T) == 4 ? T(1e-6) : T(1e-12));
  const S volumetric = T(4) * ratio * friction * dilation;
  const S compression = (T(1) + friction) * (T(1) + dilation);
  const S extension = max((T(1) - friction) * (T(1) - dilation), least * least);
  const S a = compression + extension + volumetric;
  const S strength = T(2) * cohesion * cosine;
  return {friction,
          dilation,
          strength,
          strength * rcp(max(T(2) * friction, least)),
          rcp(a),
          rcp(a + extension + volumetric),
          rcp(a + compression + volumetric),
          rcp(compression),
          rcp(extension),
          rcp(max(T(1) - friction, least))};
}

/// Descending order of three numbers by three exchanges that can be undone.
template <class V>
struct Descending {
  Vec3<V> sorted;
  MaskOf<V> first, second, third;

  SCREE_FN explicit Descending(const Vec3<V>& a) : sorted(a) {
    first = sorted[0] < sorted[1];
    exchange(sorted, first, 0);
    second = sorted[1] < sorted[2];
    exchange(sorted, second, 1);
    third = sorted[0] < sorted[1];
    exchange(sorted, third, 0);
  }
  /// Numbers that belong to the sorted ones, in the order before.
  SCREE_FN Vec3<V> undo(Vec3<V> a) const {
    exchange(a, third, 0);
    exchange(a, second, 1);
    exchange(a, first, 0);
    return a;
  }

 private:
  SCREE_FN static void exchange(Vec3<V>& a, MaskOf<V> mask, int i) {
    const V upper = select(mask, a[i + 1], a[i]);
    a[i + 1] = select(mask, a[i], a[i + 1]);
    a[i] = upper;
  }
};

/// Stress over 2 mu: t_i = e_i + ratio tr e.
template <class V, class T>
SCREE_FN Vec3<V> scaled_stress(const Vec3<V>& e, T ratio) {
  const V mean = ratio * (e[0] + e[1] + e[2]);
  return {{e[0] + mean, e[1] + mean, e[2] + mean}};
}

/// Yield value of the pyramid at sorted t.
template <class V, class S>
SCREE_FN V mohr_coulomb_excess(const MohrCoulombStrength<S>& k, V largest, V smallest) {
  using T = Scalar<V>;
  return (T(1) + k.friction) * largest - (T(1) - k.friction) * smallest - k.cohesion;
}

/// Change of the sorted elastic strains by the return of the sorted stress t to the pyramid without
/// apex: to the plane t_1, t_3, or where that spoils the order to the edge t_1 = t_2 (triaxial
/// compression) or t_2 = t_3 (extension), whichever the return along the plane's flow meets first.
template <class V, class S>
SCREE_FN Vec3<V> return_to_sides(const MohrCoulombStrength<S>& k, const Vec3<V>& t) {
  using T = Scalar<V>;
  const V zero = broadcast<V>(0);
  const auto upper = T(1) + k.dilation, lower = T(1) - k.dilation;
  const V above = t[0] - t[1], below = t[1] - t[2];
  const V excess = mohr_coulomb_excess(k, t[0], t[2]);
  const V single = excess * k.plane;
  const auto sides = (upper * single <= above) & (lower * single <= below);
  const auto compression = lower * above < upper * below;
  const V second =
      select(compression, mohr_coulomb_excess(k, t[1], t[2]), mohr_coulomb_excess(k, t[0], t[1]));
  const V both =
      (excess + second) * select(compression, zero + k.compression_sum, zero + k.extension_sum);
  const V gap =
      (excess - second) * select(compression, zero + k.compression_gap, zero + k.extension_gap);
  const V one = T(0.5) * (both + gap), other = T(0.5) * (both - gap);
  const V g0 = select(sides, single, select(compression, one, both));
  const V g1 = select(compression, -(upper * other), lower * other);
  const V g2 = select(sides, single, select(compression, both, one));
  const auto yields = excess > T(0);
  return {{select(yields, -(upper * g0), zero), select(yields & !sides, g1, zero),
           select(yields, lower * g2, zero)}};
}

/// Return to the largest stress t_1 <= tension, and to the pyramid where that is still outside: the
/// line t_1 = tension, t_3 = what the pyramid then demands, between its two ends. Stress over 2 mu.
template <class V, class S, class T>
SCREE_FN Vec3<V> return_to_tension(const MohrCoulombStrength<S>& k, T ratio, T tension,
                                   const Vec3<V>& e, const Vec3<V>& t) {
  const V limit = broadcast<V>(tension);
  const T single = ratio / (T(1) + ratio), twofold = ratio / (T(1) + T(2) * ratio);
  const V over = t[0] - limit;
  const V middle = t[1] - single * over, least = t[2] - single * over;
  const auto edge = middle > limit;
  const V least_at_edge = t[2] - twofold * (over + t[1] - limit);
  const V t1 = min(middle, limit), t2 = min(select(edge, least_at_edge, least), limit);
  // The pyramid at t_1 = tension.
  const V bottom = ((T(1) + k.friction) * limit - k.cohesion) * k.slope;
  const V between =
      ((T(1) + T(3) * ratio) * e[1] + ratio * (limit + bottom)) * (T(1) / (T(1) + T(2) * ratio));
  const auto corner = t2 < bottom;
  return {
      {limit, select(corner, min(max(between, bottom), limit), t1), select(corner, bottom, t2)}};
}

}  // namespace scree::detail

// SPDX-License-Identifier: Apache-2.0
/// \file
/// The stretch of a deformation without its rotation.
#pragma once

#include <type_traits>

#include "solver/base/polar.hpp"

namespace scree {

namespace detail {

template <class T>
struct StretchLimits {
  /// Of |F|^6/(det F)^2, 27 for a rotation: beyond it the invariants cancel.
  static constexpr T distortion = sizeof(T) == 4 ? T(1e5) : T(1e7);
  static constexpr T rounding = sizeof(T) == 4 ? T(6e-8) : T(1e-16);
  static constexpr int iterations = 20;
};

/// tr V of b = V^2, from tr b, the second invariant of b and det V: the largest root of f(x) = y^2
/// - 2 x det V - I2, y = (x^2 - tr b)/2 being the second invariant of V. f is convex beyond it, and
/// sqrt(3 tr b) >= tr V, so Newton's iteration falls towards it, from within strain squared.
/// Converged lanes are frozen, so a lane does not depend on others.
template <class V>
SCREE_FN V stretch_trace(const V& trace_b, const V& second_b, const V& J) {
  using T = Scalar<V>;
  using Limits = StretchLimits<T>;
  V x = sqrt(T(3) * trace_b);
  MaskOf<V> active = x > T(0);
  for (int i = 0; i < Limits::iterations && any(active); ++i) {
    const V square = x * x;
    const V y = T(0.5) * (square - trace_b);
    const V value = mul_add(y, y, mul_add(T(-2) * J, x, -second_b));
    const V half_slope = mul_add(x, y, -J);
    const V change = T(0.5) * value * rcp(half_slope);
    x = select(active, x - change, x);
    // What is left is change^2 f''/(2 f').
    const V left = change * change * (T(3) * square - trace_b);
    active = active & (left > (T(4) * Limits::rounding) * x * half_slope);
  }
  return x;
}

}  // namespace detail

/// b - V with b = F F^T = V^2, the left stretch V: (F - R) F^T without the rotation R. By
/// Cayley-Hamilton V (b + i2 I) = i1 b + i3 I with the invariants i1, i2, i3 = J of V (Hoger,
/// Carlson, Q. Appl. Math. 42, 1984), whose equation is solved for i1. Error a few units in the
/// last place of |b|. Distortions beyond a stretch of about 20 (float), 60 (double) times another
/// go by polar_rotation, with its limits: lanes beyond those must be rejected by the caller.
template <class V>
SCREE_FN Sym3<V> stretch_excess(const Mat3<V>& F, const Sym3<V>& b, const V& J) {
  using T = Scalar<V>;
  using Polar = detail::PolarLimits<T>;
  const V trace_b = trace(b);
  const MaskOf<V> usual =
      (trace_b < Polar::square_max) & (J > Polar::det_min) &
      (trace_b * trace_b * trace_b <= detail::StretchLimits<T>::distortion * J * J);
  if constexpr (std::is_arithmetic_v<V>) {
    if (!usual) return sym((F - polar_rotation(F)) * transpose(F));
  }
  // The others take the place of the identity meanwhile.
  const V zero = broadcast<V>(0), one = broadcast<V>(1);
  const Sym3<V> a = {select(usual, b.xx, one), select(usual, b.xy, zero), select(usual, b.xz, zero),
                     select(usual, b.yy, one), select(usual, b.yz, zero), select(usual, b.zz, one)};
  const V i3 = select(usual, J, one);
  const V second =
      a.xx * a.yy - a.xy * a.xy + (a.yy * a.zz - a.yz * a.yz) + (a.xx * a.zz - a.xz * a.xz);
  const V i1 = detail::stretch_trace(trace(a), second, i3);
  const V i2 = T(0.5) * (i1 * i1 - trace(a));
  // (b + i2 I)^-1, then b - V = (b^2 + (i2 - i1) b - i3 I)(b + i2 I)^-1 from its left factor.
  const V x = a.xx + i2, y = a.yy + i2, z = a.zz + i2;
  const V cxx = y * z - a.yz * a.yz, cyy = x * z - a.xz * a.xz, czz = x * y - a.xy * a.xy;
  const V cxy = a.xz * a.yz - a.xy * z, cxz = a.xy * a.yz - a.xz * y, cyz = a.xy * a.xz - a.yz * x;
  const V inverse = rcp(x * cxx + a.xy * cxy + a.xz * cxz);
  // V = i1 I + (i3 - i1 i2)(b + i2 I)^-1: one matrix less.
  const V factor = (i1 * i2 - i3) * inverse;
  Sym3<V> r = {a.xx - (i1 - factor * cxx), a.xy + factor * cxy, a.xz + factor * cxz,
               a.yy - (i1 - factor * cyy), a.yz + factor * cyz, a.zz - (i1 - factor * czz)};
  if (!std::is_arithmetic_v<V> && !all(usual)) {
    const Sym3<V> other = sym((F - polar_rotation(F)) * transpose(F));
    r = {select(usual, r.xx, other.xx), select(usual, r.xy, other.xy),
         select(usual, r.xz, other.xz), select(usual, r.yy, other.yy),
         select(usual, r.yz, other.yz), select(usual, r.zz, other.zz)};
  }
  return r;
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
/// \file
/// Rotation of the polar decomposition F = R U.
#pragma once

#include "solver/base/tensor.hpp"

namespace scree {

namespace detail {
template <class T>
struct PolarLimits {
  // Determinant and squared norm between which neither the cofactors nor 1/det leave the range of
  // T.
  static constexpr T det_min = sizeof(T) == 4 ? T(1e-10) : T(1e-40);
  static constexpr T square_max = sizeof(T) == 4 ? T(1e10) : T(1e40);
  // Newton converges quadratically: after a change e the remaining error is e^2/2.
  static constexpr T change_square = sizeof(T) == 4 ? T(1e-7) : T(1e-15);
  // Each iteration at least halves the largest stretch until it is near 1.
  static constexpr int iterations = sizeof(T) == 4 ? 48 : 160;
};

template <class V>
SCREE_FN Mat3<V> select_or_identity(const MaskOf<V>& mask, const Mat3<V>& f) {
  const Mat3<V> one = identity3<V>();
  Mat3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) r(i, j) = select(mask, f(i, j), one(i, j));
  }
  return r;
}
}  // namespace detail

/// The rotation R nearest to F, for det F > 0, by Newton's iteration R <- (R + R^-T)/2 (Higham,
/// SIAM J. Sci. Stat. Comput. 7(4), 1986). Error about 3 cond(F) units in the last place. A lane
/// whose F is inverted or degenerate (det F <= 1e-10 float, 1e-40 double, or |F|^2 >= 1e10, 1e40)
/// gets the identity: the caller must reject it. Converged lanes are frozen, so a lane does not
/// depend on others.
template <class V>
SCREE_FN Mat3<V> polar_rotation(const Mat3<V>& f) {
  using T = Scalar<V>;
  using Limits = detail::PolarLimits<T>;
  V square = broadcast<V>(0);
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) square = square + f(i, j) * f(i, j);
  }
  // The size comes first: the determinant of a huge F would overflow.
  MaskOf<V> active = square < Limits::square_max;
  Mat3<V> r = detail::select_or_identity(active, f);
  active = active & (det(r) > Limits::det_min);
  r = detail::select_or_identity(active, r);
  for (int iteration = 0; iteration < Limits::iterations && any(active); ++iteration) {
    const Mat3<V> c = cofactor(r);
    const V d = r(0, 0) * c(0, 0) + r(0, 1) * c(0, 1) + r(0, 2) * c(0, 2);
    const V half_inverse = T(0.5) * rcp(d);
    V change = broadcast<V>(0);
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      SCREE_UNROLL for (int j = 0; j < 3; ++j) {
        const V next = T(0.5) * r(i, j) + half_inverse * c(i, j);
        change = max(change, abs(next - r(i, j)));
        r(i, j) = select(active, next, r(i, j));
      }
    }
    active = active & (change * change > Limits::change_square);
  }
  return r;
}

}  // namespace scree

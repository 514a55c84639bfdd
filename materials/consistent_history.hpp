// SPDX-License-Identifier: Apache-2.0
/// \file
/// Strength that depends on the plastic strain of the same step.
#pragma once

#include "solver/base/pack.hpp"

namespace scree::detail {

/// The plastic strain x = start + flow(x), where flow(x) >= 0 is what the return map with the
/// strength at x yields; secant steps, a fixed number. The caller returns to the strength at x and
/// stores x, so that the state lies on its own yield surface whatever the residual is.
///
/// Where the strength falls so fast that x grows to more than 4 times the flow at constant strength
/// (beyond a factor of infinity elasticity could not follow, the stress would jump), the loss is
/// spread over steps by this factor; wave_speed counts on it.
inline constexpr double largest_softening = 0.75;

template <class V, class Flow>
SCREE_FN V consistent_history(V start, const Flow& flow) {
  using T = Scalar<V>;
  constexpr T least_slope = T(1 - largest_softening);
  constexpr T tiny = sizeof(T) == 4 ? T(1e-20) : T(1e-60);
  const V first = flow(start);
  if (all(first <= T(0))) return start;  // as the steps below would find: nothing yields
  const V limit = start + first * T(1 / least_slope);
  V last = start, last_residual = first, x = start + first;
  for (int i = 0; i < 3; ++i) {
    const V residual = start + flow(x) - x;
    const V distance = x - last;
    const auto apart = abs(distance) > tiny;
    // -d residual/dx; 1 where the strength is constant, above that where it grows.
    const V slope = select(apart, (last_residual - residual) / select(apart, distance, T(1)), T(1));
    last = x;
    last_residual = residual;
    x = min(max(x + residual / max(slope, broadcast<V>(least_slope)), start), limit);
  }
  return x;
}

}  // namespace scree::detail

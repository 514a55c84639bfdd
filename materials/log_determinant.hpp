// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/math.hpp"
#include "solver/base/tensor.hpp"

namespace scree::detail {

/// ln det(I + L), to full relative accuracy for small L: det(I + L) - 1 = tr L + the principal
/// minors + det L, without a cancellation against 1.
template <class V>
SCREE_FN V log_determinant(const Mat3<V>& L) {
  using T = Scalar<V>;
  const V minors = L(0, 0) * L(1, 1) - L(0, 1) * L(1, 0) + L(1, 1) * L(2, 2) - L(1, 2) * L(2, 1) +
                   L(2, 2) * L(0, 0) - L(2, 0) * L(0, 2);
  const V growth = trace(L) + minors + det(L);
  return log1p(max(growth, broadcast<V>(T(-0.999))));  // a limit that no admissible step reaches
}

}  // namespace scree::detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/math.hpp"
#include "solver/base/tensor.hpp"

namespace scree::detail {

/// det(I + L) - 1 = tr L + the principal minors + det L, to full relative accuracy for small L:
/// without a cancellation against 1.
template <class V>
SCREE_FN V volume_growth(const Mat3<V>& L) {
  const V minors = L(0, 0) * L(1, 1) - L(0, 1) * L(1, 0) + L(1, 1) * L(2, 2) - L(1, 2) * L(2, 1) +
                   L(2, 2) * L(0, 0) - L(2, 0) * L(0, 2);
  return trace(L) + minors + det(L);
}

/// ln det(I + L), to full relative accuracy for small L.
template <class V>
SCREE_FN V log_determinant(const Mat3<V>& L) {
  using T = Scalar<V>;
  // -0.999: a limit that no admissible step reaches
  return log1p(max(volume_growth(L), broadcast<V>(T(-0.999))));
}

}  // namespace scree::detail

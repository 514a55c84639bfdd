// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/math.hpp"
#include "solver/base/tensor.hpp"

namespace scree::detail {

/// ln det(I + L), to full relative accuracy for small L.
template <class V>
SCREE_FN V log_determinant(const Mat3<V>& L) {
  using T = Scalar<V>;
  // -0.999: a limit that no admissible step reaches
  return log1p(max(volume_growth(L), broadcast<V>(T(-0.999))));
}

}  // namespace scree::detail

// SPDX-License-Identifier: Apache-2.0
#include "solver/step/split_kernel.hpp"

namespace scree {

template struct SplitKernel<Compact, 3, double>;
template struct SplitKernel<Compact, 3, float>;

}  // namespace scree

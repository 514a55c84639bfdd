// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/config.hpp"

namespace scree {

/// x, of which device code may not know that it has seen it before: what is cheap to work out again
/// is worked out where it is needed, rather than kept in a register over a long loop. On a CPU it
/// is x and no more: results that exist are used again.
template <class V>
SCREE_FN V anew(V x) {
#ifdef __CUDA_ARCH__
  if constexpr (sizeof(V) == 4) {
    asm("" : "+f"(x));
  } else {
    asm("" : "+d"(x));
  }
#endif
  return x;
}

}  // namespace scree

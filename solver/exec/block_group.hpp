// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef SCREE_STRICT
#include "solver/exec/strict_group.hpp"
#else
#include "solver/exec/cpu_group.hpp"
#endif

namespace scree {

/// The group that runs block bodies on this CPU build: the strict one finds missing barriers and
/// uninitialised reads (SCREE_STRICT), the plain one is fast.
#ifdef SCREE_STRICT
template <int D, class T, class Kernel>
using BlockGroup = StrictGroup<D, T, Kernel>;
#else
template <int D, class T, class Kernel>
using BlockGroup = CpuGroup<D, T, Kernel>;
#endif

}  // namespace scree

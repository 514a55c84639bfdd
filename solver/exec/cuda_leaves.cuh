// SPDX-License-Identifier: Apache-2.0
/// \file
/// What only a CUDA device can do: barriers, atomics, thread numbers. The block bodies are
/// host-device functions, so these must have a host side too; it is never called.
#pragma once

#include <cstdint>

#include "solver/base/config.hpp"

namespace scree::cuda {

SCREE_FN int thread() {
#ifdef __CUDA_ARCH__
  return int(threadIdx.x);
#else
  return 0;
#endif
}

SCREE_FN int threads() {
#ifdef __CUDA_ARCH__
  return int(blockDim.x);
#else
  return 1;
#endif
}

/// Waits for all threads of the block and makes their writes visible to each other.
SCREE_FN void barrier() {
#ifdef __CUDA_ARCH__
  __syncthreads();
#endif
}

/// *p += x while others do the same.
template <class T>
SCREE_FN void add(T* p, T x) {
#ifdef __CUDA_ARCH__
  atomicAdd(p, x);
#else
  *p += x;
#endif
}

/// Replaces `expected` by `desired`; true for the one caller that did.
template <class Enum>
SCREE_FN bool claim(Enum* p, Enum expected, Enum desired) {
  static_assert(sizeof(Enum) == sizeof(int));
#ifdef __CUDA_ARCH__
  return atomicCAS(reinterpret_cast<int*>(p), int(expected), int(desired)) == int(expected);
#else
  if (*p != expected) return false;
  *p = desired;
  return true;
#endif
}

/// *p = max(*p, x) over all threads of the block, for x >= 0, whose bits sort like integers. Every
/// thread of the block must call it; a warp reduces in registers first.
template <class T>
SCREE_FN void raise(T* p, T x) {
#ifdef __CUDA_ARCH__
  for (int distance = 16; distance > 0; distance /= 2) {
    const T other = __shfl_xor_sync(0xffffffffu, x, distance);
    x = other > x ? other : x;
  }
  if (threadIdx.x % 32 != 0) return;
  if constexpr (sizeof(T) == 4) {
    atomicMax(reinterpret_cast<int*>(p), __float_as_int(x));
  } else {
    atomicMax(reinterpret_cast<long long*>(p), __double_as_longlong(x));
  }
#else
  if (x > *p) *p = x;
#endif
}

}  // namespace scree::cuda

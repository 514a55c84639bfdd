// SPDX-License-Identifier: Apache-2.0
/// \file
/// What only a CUDA device has: thread numbers, barriers, atomics. On the host the same names mean
/// ordinary threads, so that the tests can run the CUDA group, under a thread sanitizer too, on a
/// machine without a GPU.
#pragma once

#include <cstdint>

#include "solver/base/config.hpp"

#ifndef __CUDA_ARCH__
#include <atomic>
#endif

namespace scree::cuda {

#ifndef __CUDA_ARCH__
/// Stand-in of threadIdx, blockDim and the block's barrier; alone unless a test says otherwise.
struct HostThread {
  int index = 0;
  int count = 1;
  void (*wait)(void* barrier) = nullptr;
  void* barrier = nullptr;
};
inline thread_local HostThread host_thread;
#endif

SCREE_FN int thread() {
#ifdef __CUDA_ARCH__
  return int(threadIdx.x);
#else
  return host_thread.index;
#endif
}

SCREE_FN int threads() {
#ifdef __CUDA_ARCH__
  return int(blockDim.x);
#else
  return host_thread.count;
#endif
}

/// Waits for all threads of the block and makes their writes visible to each other.
SCREE_FN void barrier() {
#ifdef __CUDA_ARCH__
  __syncthreads();
#else
  if (host_thread.wait != nullptr) host_thread.wait(host_thread.barrier);
#endif
}

/// *p += x while others do the same.
template <class T>
SCREE_FN void add(T* p, T x) {
#ifdef __CUDA_ARCH__
  atomicAdd(p, x);
#else
  std::atomic_ref<T>(*p).fetch_add(x);
#endif
}

/// Replaces `expected` by `desired`; true for the one caller that did.
template <class Enum>
SCREE_FN bool claim(Enum* p, Enum expected, Enum desired) {
  static_assert(sizeof(Enum) == sizeof(int));
#ifdef __CUDA_ARCH__
  return atomicCAS(reinterpret_cast<int*>(p), int(expected), int(desired)) == int(expected);
#else
  return std::atomic_ref<Enum>(*p).compare_exchange_strong(expected, desired);
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
  std::atomic_ref<T> shared(*p);
  T old = shared.load();
  while (x > old && !shared.compare_exchange_weak(old, x)) {
  }
#endif
}

}  // namespace scree::cuda

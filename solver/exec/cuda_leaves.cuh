// SPDX-License-Identifier: Apache-2.0
/// \file
/// What only a CUDA device has: thread numbers, barriers, atomics, sums over a block.
#pragma once

#include <cstdint>

#include "solver/exec/cuda_dialect.cuh"

namespace scree {
inline namespace SCREE_SIDE {
namespace device {

SCREE_FN int thread() {
#if SCREE_IN_KERNEL
  return int(threadIdx.x);
#else
  return 0;
#endif
}

SCREE_FN int threads() {
#if SCREE_IN_KERNEL
  return int(blockDim.x);
#else
  return 1;
#endif
}

SCREE_FN int block() {
#if SCREE_IN_KERNEL
  return int(blockIdx.x);
#else
  return 0;
#endif
}

/// Waits for all threads of the block and makes their writes visible to each other.
SCREE_FN void barrier([[maybe_unused]] CallPlace at = SCREE_CALL_PLACE) {
#if defined(__CUDA_ARCH__)
  __syncthreads();
#elif SCREE_IN_KERNEL
  __syncthreads(at);
#endif
}

/// i, but the compiler may not work out ahead of a loop what hangs on it, and keep the result in a
/// register.
SCREE_FN int not_ahead(int i) {
#ifdef __CUDA_ARCH__
  asm volatile("" : "+r"(i));
#endif
  return i;
}

/// *p += x while others do the same.
template <class T>
SCREE_FN void add([[maybe_unused]] T* p, [[maybe_unused]] T x) {
#if SCREE_IN_KERNEL
  atomicAdd(p, x);
#endif
}

/// *flag = 1 while others do the same.
SCREE_FN void raise_flag([[maybe_unused]] std::int32_t* flag) {
#if SCREE_IN_KERNEL
  atomicMax(flag, std::int32_t(1));
#endif
}

/// Replaces `expected` by `desired`; true for the one caller that did.
template <class Enum>
SCREE_FN bool claim([[maybe_unused]] Enum* p, [[maybe_unused]] Enum expected,
                    [[maybe_unused]] Enum desired) {
  static_assert(sizeof(Enum) == sizeof(int));
#if SCREE_IN_KERNEL
  return atomicCAS(reinterpret_cast<int*>(p), int(expected), int(desired)) == int(expected);
#else
  return false;
#endif
}

/// *p = max(*p, x) while others do the same, for x >= 0, whose bits sort like integers; NaN leaves
/// *p alone.
template <class T>
SCREE_FN void raise([[maybe_unused]] T* p, [[maybe_unused]] T x) {
#if SCREE_IN_KERNEL
  // What is read may be an old, smaller value: then the atomic operation decides.
#ifdef __CUDA_ARCH__
  const T old = *p;
#else
  const T old = std::atomic_ref<T>(*p).load(std::memory_order_relaxed);
#endif
  if (!(x > old)) return;
  if constexpr (sizeof(T) == 4) {
    atomicMax(reinterpret_cast<int*>(p), __float_as_int(x));
  } else {
    atomicMax(reinterpret_cast<long long*>(p), __double_as_longlong(x));
  }
#endif
}

/// Sum of x over the threads of a block, always in the same order; the result is thread 0's.
/// `room`: shared memory for one number a thread; its content is lost. The number of threads is a
/// power of two.
SCREE_FN double block_sum(double x, double* room) {
  room[thread()] = x;
  barrier();
  for (int half = threads() / 2; half > 0; half /= 2) {
    if (thread() < half) room[thread()] += room[thread() + half];
    barrier();
  }
  const double sum = room[0];
  barrier();
  return sum;
}

}  // namespace device
}  // namespace SCREE_SIDE
}  // namespace scree

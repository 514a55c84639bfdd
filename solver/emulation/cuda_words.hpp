// SPDX-License-Identifier: Apache-2.0
/// \file
/// The words of CUDA C++ that the kernels use, for a C++ compiler. Macros and global names: only
/// for units that compile kernels.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>
#include <source_location>

#include "solver/emulation/launch.hpp"

#define __global__
#define __launch_bounds__(...)
#define __grid_constant__

// threadIdx.x and the like, for one axis.
inline constexpr struct {
  struct {
    operator unsigned() const { return unsigned(scree::emulation::place().thread); }
  } x;
} threadIdx;
inline constexpr struct {
  struct {
    operator unsigned() const { return unsigned(scree::emulation::place().threads); }
  } x;
} blockDim;
inline constexpr struct {
  struct {
    operator unsigned() const { return unsigned(scree::emulation::place().block); }
  } x;
} blockIdx;
inline constexpr struct {
  struct {
    operator unsigned() const { return unsigned(scree::emulation::place().blocks); }
  } x;
} gridDim;

inline void __syncthreads(std::source_location at = std::source_location::current()) {
  scree::emulation::block_barrier(at);
}

template <class T>
T __shfl_xor_sync(unsigned, T x, int lane_mask,
                  std::source_location at = std::source_location::current()) {
  static_assert(sizeof(T) <= 8);
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof x);
  bits = scree::emulation::exchange(bits, int(threadIdx.x) % 32 ^ lane_mask, at);
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

template <class T>
T atomicAdd(T* p, T x) {
  return std::atomic_ref<T>(*p).fetch_add(x, std::memory_order_relaxed);
}

template <class T>
T atomicMax(T* p, T x) {
  std::atomic_ref<T> shared(*p);
  T old = shared.load(std::memory_order_relaxed);
  while (x > old && !shared.compare_exchange_weak(old, x)) {
  }
  return old;
}

inline int atomicCAS(int* p, int expected, int desired) {
  std::atomic_ref<int>(*p).compare_exchange_strong(expected, desired);
  return expected;
}

inline int __float_as_int(float x) { return std::bit_cast<int>(x); }
inline long long __double_as_longlong(double x) { return std::bit_cast<long long>(x); }

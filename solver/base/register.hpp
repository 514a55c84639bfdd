// SPDX-License-Identifier: Apache-2.0
/// \file
/// The operations on one machine register that lanes (Pack) are built from. Compiler vector
/// extensions do the arithmetic; what they do not know, or do element by element, is here: in plain
/// loops, and in register_x86.hpp with the instructions of the machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "solver/base/config.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && !defined(__CUDACC__)
#define SCREE_AVX512 1
#endif
#if defined(__SSE2__) && !defined(__CUDACC__)
#include <immintrin.h>
#endif

namespace scree::detail {

/// Bytes of the widest vector register of this build. A vector type beyond it is taken apart by GCC
/// 12 element by element wherever lanes are compared, chosen or moved; Packs are taken apart
/// register by register instead. (nvcc compiles no lanes for the device.)
#if defined(SCREE_AVX512) || defined(__CUDACC__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

template <class T>
using IntOfSize = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

template <class T, int W>
struct VectorOf {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};

/// W lanes of T in one register: the portable form.
template <class T, int W>
struct PlainRegister {
  using Vector = typename VectorOf<T, W>::type;
  using IntVector = typename VectorOf<IntOfSize<T>, W>::type;
  /// All bits of a lane set for true.
  using MaskVector = IntVector;
  static constexpr bool mask_bits = false;  ///< a mask is a number with one bit a lane

  static SCREE_FN MaskVector less(Vector a, Vector b) { return MaskVector(a < b); }
  static SCREE_FN MaskVector less_equal(Vector a, Vector b) { return MaskVector(a <= b); }
  static SCREE_FN MaskVector equal(Vector a, Vector b) { return MaskVector(a == b); }
  static SCREE_FN bool any(MaskVector m) {
    bool found = false;
    for (int i = 0; i < W; ++i) found = found | (m[i] != 0);
    return found;
  }
  static SCREE_FN Vector select(MaskVector m, Vector a, Vector b) { return m ? a : b; }
  static SCREE_FN Vector min(Vector a, Vector b) { return a < b ? a : b; }
  static SCREE_FN Vector max(Vector a, Vector b) { return a > b ? a : b; }
  static SCREE_FN Vector floor(Vector a) {
    SCREE_UNROLL for (int i = 0; i < W; ++i) a[i] = std::floor(T(a[i]));
    return a;
  }
  static SCREE_FN Vector sqrt(Vector a) {
    SCREE_UNROLL for (int i = 0; i < W; ++i) a[i] = std::sqrt(T(a[i]));
    return a;
  }
  static SCREE_FN Vector fma(Vector a, Vector b, Vector c) {
    SCREE_UNROLL for (int i = 0; i < W; ++i) a[i] = std::fma(T(a[i]), T(b[i]), T(c[i]));
    return a;
  }
  /// Integers, arithmetic shift.
  static SCREE_FN Vector shift_right(Vector a, int n) { return a >> n; }
  /// Towards zero.
  static SCREE_FN IntVector to_int(Vector a) {
#if defined(__CUDACC__)
    IntVector r{};
    for (int i = 0; i < W; ++i) r[i] = IntOfSize<T>(a[i]);
    return r;
#else
    return __builtin_convertvector(a, IntVector);
#endif
  }
};

template <class T, int W>
struct Register : PlainRegister<T, W> {};

}  // namespace scree::detail

#if defined(__SSE2__) && !defined(__CUDACC__)
#include "solver/base/register_x86.hpp"
#endif

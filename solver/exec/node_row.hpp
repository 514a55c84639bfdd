// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>

#include "solver/base/config.hpp"

#if defined(__AVX512F__) && !defined(__CUDACC__)
#include <immintrin.h>
#endif

namespace scree {

/// 16 numbers in registers: four quads {vector, mass}, one for each of 2 x 2 neighbouring nodes
/// (the last axis fastest), or one record of a particle.
template <class T>
struct NodeRow {
  static constexpr int values = 16;
  static constexpr int lanes = 64 / sizeof(T);  ///< numbers in one vector
  static constexpr int parts = values / lanes;  ///< vectors
  typedef T Native __attribute__((vector_size(64), may_alias));
  Native part[parts];

  static SCREE_FN NodeRow load(const T* p) {
    NodeRow r;
    SCREE_UNROLL for (int i = 0; i < parts; ++i) r.part[i] = reinterpret_cast<const Native*>(p)[i];
    return r;
  }
  SCREE_FN void store(T* p) const {
    SCREE_UNROLL for (int i = 0; i < parts; ++i) reinterpret_cast<Native*>(p)[i] = part[i];
  }

  /// The same quad four times; p: 4 numbers, aligned to their size together.
  static SCREE_FN NodeRow repeat(const T* p) {
    NodeRow r;
#ifdef __AVX512F__
    // The forms with a mask: GCC 12 warns about its own header in the ones without.
    if constexpr (parts == 1) {
      r.part[0] = Native(_mm512_maskz_broadcast_f32x4(__mmask16(0xffff), _mm_load_ps(p)));
    } else {
      r.part[0] = r.part[1] =
          Native(_mm512_maskz_broadcast_f64x4(__mmask8(0xff), _mm256_load_pd(p)));
    }
#else
    T all[values];
    SCREE_UNROLL for (int i = 0; i < 4; ++i) std::memcpy(all + 4 * i, p, 4 * sizeof(T));
    std::memcpy(&r, all, sizeof r);
#endif
    return r;
  }

  friend SCREE_FN NodeRow operator+(NodeRow a, const NodeRow& b) {
    SCREE_UNROLL for (int i = 0; i < parts; ++i) a.part[i] += b.part[i];
    return a;
  }
  friend SCREE_FN NodeRow operator*(NodeRow a, const NodeRow& b) {
    SCREE_UNROLL for (int i = 0; i < parts; ++i) a.part[i] *= b.part[i];
    return a;
  }
  /// a b + c, fused.
  friend SCREE_FN NodeRow multiply_add(NodeRow a, const NodeRow& b, const NodeRow& c) {
    SCREE_UNROLL for (int i = 0; i < parts; ++i) a.part[i] = a.part[i] * b.part[i] + c.part[i];
    return a;
  }
};

namespace detail {

/// Quads a and b (0 .. 3 of x, 4 .. 7 of y) and, with 16 lanes, c and d, as one vector.
template <class T, int a, int b, int c, int d>
SCREE_FN typename NodeRow<T>::Native pick_quads(const NodeRow<T>& x, const NodeRow<T>& y) {
  if constexpr (NodeRow<T>::parts == 1) {
    return __builtin_shufflevector(x.part[0], y.part[0], 4 * a, 4 * a + 1, 4 * a + 2, 4 * a + 3,
                                   4 * b, 4 * b + 1, 4 * b + 2, 4 * b + 3, 4 * c, 4 * c + 1,
                                   4 * c + 2, 4 * c + 3, 4 * d, 4 * d + 1, 4 * d + 2, 4 * d + 3);
  } else {
    const auto& first = a < 4 ? x.part[a / 2 % 2] : y.part[a / 2 % 2];
    const auto& second = b < 4 ? x.part[b / 2 % 2] : y.part[b / 2 % 2];
    constexpr int i = a % 2 * 4;
    constexpr int j = b % 2 * 4 + 8;
    return __builtin_shufflevector(first, second, i, i + 1, i + 2, i + 3, j, j + 1, j + 2, j + 3);
  }
}

}  // namespace detail

/// The quads a, b, c, d of x (0 .. 3) and y (4 .. 7).
template <int a, int b, int c, int d, class T>
SCREE_FN NodeRow<T> quads(const NodeRow<T>& x, const NodeRow<T>& y) {
  if constexpr (NodeRow<T>::parts == 1) {
    return {{detail::pick_quads<T, a, b, c, d>(x, y)}};
  } else {
    return {{detail::pick_quads<T, a, b, 0, 0>(x, y), detail::pick_quads<T, c, d, 0, 0>(x, y)}};
  }
}

/// Each number of quad q four times.
template <int q, class T>
SCREE_FN NodeRow<T> spread(const NodeRow<T>& x) {
  constexpr int i = 4 * q;
  if constexpr (NodeRow<T>::parts == 1) {
    return {{__builtin_shufflevector(x.part[0], x.part[0], i, i, i, i, i + 1, i + 1, i + 1, i + 1,
                                     i + 2, i + 2, i + 2, i + 2, i + 3, i + 3, i + 3, i + 3)}};
  } else {
    const auto& p = x.part[q / 2];
    constexpr int j = i % 8;
    return {
        {__builtin_shufflevector(p, p, j, j, j, j, j + 1, j + 1, j + 1, j + 1),
         __builtin_shufflevector(p, p, j + 2, j + 2, j + 2, j + 2, j + 3, j + 3, j + 3, j + 3)}};
  }
}

/// The sum of the four quads, four times.
template <class T>
SCREE_FN NodeRow<T> total(const NodeRow<T>& x) {
  const NodeRow<T> pairs = x + quads<2, 3, 0, 1>(x, x);
  return pairs + quads<1, 0, 3, 2>(pairs, pairs);
}

/// A row whose quads are a, b, c, d four times each.
template <class T>
struct QuadPattern {
  alignas(64) T value[16];
  constexpr QuadPattern(T a, T b, T c, T d)
      : value{a, a, a, a, b, b, b, b, c, c, c, c, d, d, d, d} {}
};

}  // namespace scree

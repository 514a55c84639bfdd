// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "solver/base/config.hpp"

namespace scree {

/// Register transposes between "lanes = particles" (one vector a quantity) and "one record of 16
/// numbers a particle", for vectors of 64 bytes: log2(W) rounds of interleaving.
template <class T>
struct LaneTranspose {
  static constexpr int width = 64 / sizeof(T);
  typedef T Native __attribute__((vector_size(64), may_alias));

  static constexpr int record = 16;

  /// n quantities, one a row, of all lanes -> the n quantities of lane 0, of lane 1, ..., in
  /// place; n is a power of two.
  template <int n>
  [[gnu::always_inline]] static inline void weave(Native (&rows)[n]) {
    constexpr std::make_integer_sequence<int, width> lanes;
    SCREE_UNROLL for (int round = 1; round < n; round *= 2) {
      Native next[n];
      SCREE_UNROLL for (int i = 0; i < n / 2; ++i) {
        next[2 * i] = interleave<0>(rows[i], rows[i + n / 2], lanes);
        next[2 * i + 1] = interleave<width / 2>(rows[i], rows[i + n / 2], lanes);
      }
      SCREE_UNROLL for (int i = 0; i < n; ++i) rows[i] = next[i];
    }
  }

  /// rows[i] lane j -> rows[j] lane i, in place.
  [[gnu::always_inline]] static inline void square(Native (&rows)[width]) { weave(rows); }

  /// in: 4 vectors (quantity q of all lanes at in + q * width); out: quad of lane l at out + 4 l.
  [[gnu::always_inline]] static inline void to_quads(const T* in, T* out) {
    Native rows[4];
    SCREE_UNROLL for (int i = 0; i < 4; ++i) rows[i] = at(in, i);
    weave(rows);
    SCREE_UNROLL for (int i = 0; i < 4; ++i) at(out, i) = rows[i];
  }

  /// in: 16 vectors (quantity q of all lanes at in + q * width); out: record of lane l at out + 16
  /// l.
  [[gnu::always_inline]] static inline void to_records(const T* in, T* out) {
    for (int c = 0; c < record / width; ++c) {
      Native rows[width];
      SCREE_UNROLL for (int i = 0; i < width; ++i) rows[i] = at(in, c * width + i);
      square(rows);
      SCREE_UNROLL for (int l = 0; l < width; ++l) at(out, l * (record / width) + c) = rows[l];
    }
  }

  /// The inverse of to_records.
  [[gnu::always_inline]] static inline void to_lanes(const T* in, T* out) {
    for (int c = 0; c < record / width; ++c) {
      Native rows[width];
      SCREE_UNROLL for (int l = 0; l < width; ++l) rows[l] = at(in, l * (record / width) + c);
      square(rows);
      SCREE_UNROLL for (int i = 0; i < width; ++i) at(out, c * width + i) = rows[i];
    }
  }

 private:
  /// The i-th vector of 64 bytes behind p.
  [[gnu::always_inline]] static inline Native& at(T* p, int i) {
    return reinterpret_cast<Native*>(p)[i];
  }
  [[gnu::always_inline]] static inline Native at(const T* p, int i) {
    return reinterpret_cast<const Native*>(p)[i];
  }

  /// a[first], b[first], a[first + 1], b[first + 1], ...
  template <int first, int... I>
  [[gnu::always_inline]] static inline Native interleave(Native a, Native b,
                                                         std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (first + I / 2 + (I % 2) * width)...);
  }
};

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "solver/base/config.hpp"

namespace scree {

/// Register transposes between "lanes = particles" (one vector a quantity) and "one record of 16
/// numbers a particle", for vectors of 64 bytes: log2(W) rounds of interleaving.
template <class T>
struct LaneTranspose {
  static constexpr int width = 64 / sizeof(T);
  typedef T Native __attribute__((vector_size(64), may_alias));
  using Index = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  typedef Index Shuffle __attribute__((vector_size(64)));

  static constexpr int record = 16;

  /// rows[i] lane j -> rows[j] lane i, in place.
  [[gnu::always_inline]] static inline void square(Native (&rows)[width]) {
    const Shuffle low = interleave(0, std::make_integer_sequence<int, width>{});
    const Shuffle high = interleave(width / 2, std::make_integer_sequence<int, width>{});
    SCREE_UNROLL for (int round = 1; round < width; round *= 2) {
      Native next[width];
      SCREE_UNROLL for (int i = 0; i < width / 2; ++i) {
        next[2 * i] = __builtin_shuffle(rows[i], rows[i + width / 2], low);
        next[2 * i + 1] = __builtin_shuffle(rows[i], rows[i + width / 2], high);
      }
      SCREE_UNROLL for (int i = 0; i < width; ++i) rows[i] = next[i];
    }
  }

  /// in: 16 vectors (quantity q of all lanes at in + q * width); out: record of lane l at out + 16 l.
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
  [[gnu::always_inline]] static inline Native& at(T* p, int i) { return reinterpret_cast<Native*>(p)[i]; }
  [[gnu::always_inline]] static inline Native at(const T* p, int i) {
    return reinterpret_cast<const Native*>(p)[i];
  }

  template <int... I>
  [[gnu::always_inline]] static inline Shuffle interleave(int first, std::integer_sequence<int, I...>) {
    return Shuffle{Index(first + I / 2 + (I % 2) * width)...};
  }
};

}  // namespace scree

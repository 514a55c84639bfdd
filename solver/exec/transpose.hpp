// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "solver/base/pack.hpp"

namespace scree {

/// Register transposes between "lanes = particles" (one register a quantity) and "one record of 16
/// numbers a particle": squares of one register each, first within pieces of 16 bytes
/// (interleaving, cheap), then whole pieces.
template <class T>
struct LaneTranspose {
  using V = RegisterLanes<T>;
  static constexpr int width = detail::register_bytes / int(sizeof(T));
  static constexpr int record = 16;

  /// in: 16 vectors (quantity q of all lanes at in + q * width); out: record of lane l at out + 16
  /// l.
  [[gnu::always_inline]] static inline void to_records(const T* in, T* out) {
    turn<record, width>(in, width, out, record);
  }

  /// The inverse of to_records.
  [[gnu::always_inline]] static inline void to_lanes(const T* in, T* out) {
    turn<width, record>(in, record, out, width);
  }

  /// Quads {a, b, c, d} of all lanes; that of lane l at out + quad_place(l).
  [[gnu::always_inline]] static inline void to_quads(const V& a, const V& b, const V& c, const V& d,
                                                     T* out) {
    Native rows[4] = {Native(a.v), Native(b.v), Native(c.v), Native(d.v)};
    within_pieces(rows);
    if constexpr (piece == 2) pair_pieces(rows);
    SCREE_UNROLL for (int i = 0; i < 4; ++i) at(out + i * size) = rows[i];
  }
  /// The inverse: the first three numbers of the quads at `in`.
  [[gnu::always_inline]] static inline void from_quads(const T* in, V& a, V& b, V& c) {
    Native rows[4];
    SCREE_UNROLL for (int i = 0; i < 4; ++i) rows[i] = at(in + i * size);
    if constexpr (piece == 2) part_pieces(rows);
    within_pieces(rows);
    a.v = typename V::Vector(rows[0]);
    b.v = typename V::Vector(rows[1]);
    c.v = typename V::Vector(rows[2]);
  }
  /// Places are such that most quads need no more than interleaving: quad_lane(r, j) is the lane of
  /// the j-th quad in the r-th register of them, or of a register and a quad of several.
  static constexpr int quad_lane(int r, int j) {
    return piece == 2 && pieces == 4 ? r % 2 * 2 + r / 2 + 4 * j : r + 4 * j;
  }
  static constexpr int quad_place(int l) {
    if (piece == 4) return l % 4 * size + l / 4 * 4;
    if (pieces == 4) return (l % 2 * 2 + l / 2 % 2) * size + l / 4 * 4;
    return 4 * l;
  }

 private:
  static constexpr int bytes = detail::register_bytes;
  static constexpr int size = width;                 ///< numbers in a register
  static constexpr int piece = 16 / int(sizeof(T));  ///< numbers in 16 bytes
  static constexpr int pieces = bytes / 16;
  typedef T Native __attribute__((vector_size(bytes), may_alias));

  [[gnu::always_inline]] static inline Native& at(T* p) { return *reinterpret_cast<Native*>(p); }
  [[gnu::always_inline]] static inline Native at(const T* p) {
    return *reinterpret_cast<const Native*>(p);
  }

  /// out[c][r] = in[r][c] for `rows` x `columns` numbers.
  template <int rows, int columns>
  [[gnu::always_inline]] static inline void turn(const T* in, int in_step, T* out, int out_step) {
    for (int r = 0; r < rows; r += size) {
      for (int c = 0; c < columns; c += size) {
        Native square[size];
        SCREE_UNROLL for (int i = 0; i < size; ++i) square[i] = at(in + (r + i) * in_step + c);
        within_pieces(square);
        whole_pieces(square);
        SCREE_UNROLL for (int i = 0; i < size; ++i) at(out + (c + i) * out_step + r) = square[i];
      }
    }
  }

  /// Transposes the piece x piece numbers of each 16 bytes: rows g piece .. g piece + piece - 1
  /// belong together.
  template <int n>
  [[gnu::always_inline]] static inline void within_pieces(Native (&rows)[n]) {
    constexpr std::make_integer_sequence<int, size> lanes;
    SCREE_UNROLL for (int g = 0; g < n; g += piece) {
      if constexpr (piece == 2) {
        const Native a = rows[g], b = rows[g + 1];
        rows[g] = interleave<1, 0>(a, b, lanes);
        rows[g + 1] = interleave<1, 1>(a, b, lanes);
      } else {
        const Native a = interleave<1, 0>(rows[g], rows[g + 1], lanes);
        const Native b = interleave<1, 1>(rows[g], rows[g + 1], lanes);
        const Native c = interleave<1, 0>(rows[g + 2], rows[g + 3], lanes);
        const Native d = interleave<1, 1>(rows[g + 2], rows[g + 3], lanes);
        rows[g] = interleave<2, 0>(a, c, lanes);
        rows[g + 1] = interleave<2, 1>(a, c, lanes);
        rows[g + 2] = interleave<2, 0>(b, d, lanes);
        rows[g + 3] = interleave<2, 1>(b, d, lanes);
      }
    }
  }

  /// Transposes the pieces of 16 bytes: piece j of row i piece + k <-> piece i of row j piece + k.
  [[gnu::always_inline]] static inline void whole_pieces(Native (&rows)[size]) {
    if constexpr (pieces == 2) {
      SCREE_UNROLL for (int k = 0; k < piece; ++k) {
        const Native a = rows[k], b = rows[piece + k];
        rows[k] = join<0, 2>(a, b);
        rows[piece + k] = join<1, 3>(a, b);
      }
    } else if constexpr (pieces == 4) {
      SCREE_UNROLL for (int k = 0; k < piece; ++k) {
        const Native a = rows[k], b = rows[piece + k];
        const Native c = rows[2 * piece + k], d = rows[3 * piece + k];
        const Native even_low = join<0, 2, 4, 6>(a, b), odd_low = join<1, 3, 5, 7>(a, b);
        const Native even_high = join<0, 2, 4, 6>(c, d), odd_high = join<1, 3, 5, 7>(c, d);
        rows[k] = join<0, 2, 4, 6>(even_low, even_high);
        rows[piece + k] = join<0, 2, 4, 6>(odd_low, odd_high);
        rows[2 * piece + k] = join<1, 3, 5, 7>(even_low, even_high);
        rows[3 * piece + k] = join<1, 3, 5, 7>(odd_low, odd_high);
      }
    }
  }

  /// Doubles: rows 0, 1 hold quantities 0, 1 and rows 2, 3 quantities 2, 3 of even and odd lanes;
  /// puts the two halves of each quad side by side.
  [[gnu::always_inline]] static inline void pair_pieces(Native (&rows)[4]) {
    const Native a = rows[0], b = rows[1], c = rows[2], d = rows[3];
    if constexpr (pieces == 1) {
      rows[1] = c;
      rows[2] = b;
    } else if constexpr (pieces == 2) {
      rows[0] = join<0, 2>(a, c);
      rows[1] = join<0, 2>(b, d);
      rows[2] = join<1, 3>(a, c);
      rows[3] = join<1, 3>(b, d);
    } else {
      rows[0] = join<0, 4, 2, 6>(a, c);
      rows[1] = join<1, 5, 3, 7>(a, c);
      rows[2] = join<0, 4, 2, 6>(b, d);
      rows[3] = join<1, 5, 3, 7>(b, d);
    }
  }
  /// The inverse of pair_pieces.
  [[gnu::always_inline]] static inline void part_pieces(Native (&rows)[4]) {
    const Native a = rows[0], b = rows[1], c = rows[2], d = rows[3];
    if constexpr (pieces == 1) {
      rows[1] = c;
      rows[2] = b;
    } else if constexpr (pieces == 2) {
      rows[0] = join<0, 2>(a, c);
      rows[1] = join<0, 2>(b, d);
      rows[2] = join<1, 3>(a, c);
      rows[3] = join<1, 3>(b, d);
    } else {
      rows[0] = join<0, 4, 2, 6>(a, b);
      rows[1] = join<0, 4, 2, 6>(c, d);
      rows[2] = join<1, 5, 3, 7>(a, b);
      rows[3] = join<1, 5, 3, 7>(c, d);
    }
  }

  /// Within each 16 bytes: runs of `run` numbers of a and b in turn, from their lower (half 0) or
  /// upper (half 1) half.
  template <int run, int half, int... I>
  [[gnu::always_inline]] static inline Native interleave(Native a, Native b,
                                                         std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(
        a, b,
        (I / piece * piece + half * piece / 2 + I % piece / (2 * run) * run + I % run +
         (I % piece / run % 2) * size)...);
  }

  /// The pieces of 16 bytes with these numbers; those of a, then those of b.
  template <int... P>
  [[gnu::always_inline]] static inline Native join(Native a, Native b) {
    return join_numbers<P...>(a, b, std::make_integer_sequence<int, size>{});
  }
  template <int... P, int... I>
  [[gnu::always_inline]] static inline Native join_numbers(Native a, Native b,
                                                           std::integer_sequence<int, I...>) {
    constexpr int place[] = {P...};
    return __builtin_shufflevector(a, b, (place[I / piece] * piece + I % piece)...);
  }
};

}  // namespace scree

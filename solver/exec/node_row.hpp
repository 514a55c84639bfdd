// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>

#include "solver/base/register.hpp"

namespace scree {

/// Four quads {vector, mass} in registers: one for each of 2 x 2 neighbouring nodes (the last axis
/// fastest), or one record of a particle. `used`: quads that matter; parts of others are left out.
template <class T, int used = 4>
struct NodeRow {
  /// A part is a register, but at least a quad: quads then move as parts, without instructions.
  static constexpr int part_bytes = std::max(detail::register_bytes, 4 * int(sizeof(T)));
  static constexpr int lanes = part_bytes / int(sizeof(T));  ///< numbers in one part
  static constexpr int part_quads = lanes / 4;
  static constexpr int parts = (used + part_quads - 1) / part_quads;
  static constexpr int values = parts * lanes;
  typedef T Native __attribute__((vector_size(part_bytes), may_alias));
  Native part[parts];

  static SCREE_FN NodeRow load(const T* p) {
    NodeRow r;
    SCREE_UNROLL for (int i = 0; i < parts; ++i) r.part[i] = at(p + i * lanes);
    return r;
  }
  SCREE_FN void store(T* p) const {
    SCREE_UNROLL for (int i = 0; i < parts; ++i) at(p + i * lanes) = part[i];
  }

  /// The nodes of a cell in the rows of an arena (RowArena): two pairs, the second `line_step`
  /// numbers behind the first; one row, two or four.
  static SCREE_FN NodeRow load_cell(const T* p, int line_step) {
    NodeRow r;
    SCREE_UNROLL for (int i = 0; i < parts; ++i) r.part[i] = at(cell_part(p, line_step, i));
    return r;
  }
  SCREE_FN void store_cell(T* p, int line_step) const {
    SCREE_UNROLL for (int i = 0; i < parts; ++i) at(cell_part(p, line_step, i)) = part[i];
  }

  /// The same for nodes along the last axis, in rows that follow each other.
  static SCREE_FN NodeRow load_line(const T* p) {
    NodeRow r;
    SCREE_UNROLL for (int i = 0; i < parts; ++i) r.part[i] = at(p + i * part_quads * lanes);
    return r;
  }
  SCREE_FN void store_line(T* p) const {
    SCREE_UNROLL for (int i = 0; i < parts; ++i) at(p + i * part_quads * lanes) = part[i];
  }

  /// The same quad four times; p: 4 numbers, aligned to their size together.
  static SCREE_FN NodeRow repeat(const T* p) {
    NodeRow r;
    const Native quads = repeated_quad(p);
    SCREE_UNROLL for (int i = 0; i < parts; ++i) r.part[i] = quads;
    return r;
  }

  /// The same number everywhere.
  static SCREE_FN NodeRow all_of(T x) {
    NodeRow r;
    SCREE_UNROLL for (int i = 0; i < parts; ++i) r.part[i] = x - Native{};
    return r;
  }

  static SCREE_FN void store_part(T* p, const Native& x) { at(p) = x; }

  /// Each number of the j-th of the quads that fill the register at p, four times.
  template <int j>
  static SCREE_FN NodeRow spread(const T* p) {
    if constexpr (part_bytes < 64) {
      return spread(p + 4 * j);
    } else {
      constexpr int f = 4 * j;
      const Native q = at(p);
      if constexpr (part_quads == 4) {
        return {{__builtin_shufflevector(q, q, f, f, f, f, f + 1, f + 1, f + 1, f + 1, f + 2, f + 2,
                                         f + 2, f + 2, f + 3, f + 3, f + 3, f + 3)}};
      } else {
        return {{__builtin_shufflevector(q, q, f, f, f, f, f + 1, f + 1, f + 1, f + 1),
                 __builtin_shufflevector(q, q, f + 2, f + 2, f + 2, f + 2, f + 3, f + 3, f + 3,
                                         f + 3)}};
      }
    }
  }

  /// Each of 4 numbers, aligned to their size together, four times.
  static SCREE_FN NodeRow spread(const T* p) {
    NodeRow r;
    if constexpr (part_quads == 1) {
      SCREE_UNROLL for (int i = 0; i < parts; ++i) r.part[i] = p[i] - Native{};
    } else if constexpr (part_quads == 2) {
      const Native q = repeated_quad(p);
      constexpr int h = lanes / 2;  // the second half's numbers come from the second half
      r.part[0] = __builtin_shufflevector(q, q, 0, 0, 0, 0, h + 1, h + 1, h + 1, h + 1);
      r.part[1] = __builtin_shufflevector(q, q, 2, 2, 2, 2, h + 3, h + 3, h + 3, h + 3);
    } else {
      const Native q = repeated_quad(p);
      r.part[0] =
          __builtin_shufflevector(q, q, 0, 0, 0, 0, 5, 5, 5, 5, 10, 10, 10, 10, 15, 15, 15, 15);
    }
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

 private:
  static SCREE_FN Native& at(T* p) { return *reinterpret_cast<Native*>(p); }
  static SCREE_FN const Native& at(const T* p) { return *reinterpret_cast<const Native*>(p); }

  template <class P>
  static SCREE_FN P* cell_part(P* p, int line_step, int i) {
    if constexpr (part_quads == 1) return p + i % 2 * lanes + i / 2 * line_step;
    return p + i * line_step;
  }

  static SCREE_FN Native repeated_quad(const T* p) {
#ifdef SCREE_AVX512
    // The forms with a mask: GCC 12 warns about its own header in the ones without.
    if constexpr (part_quads == 4) {
      return Native(_mm512_maskz_broadcast_f32x4(__mmask16(0xffff), _mm_load_ps(p)));
    } else {
      return Native(_mm512_maskz_broadcast_f64x4(__mmask8(0xff), _mm256_load_pd(p)));
    }
#else
    typedef T Quad __attribute__((vector_size(4 * sizeof(T)), may_alias));
    const Quad quad = *reinterpret_cast<const Quad*>(p);
    if constexpr (part_quads == 1) {
      return Native(quad);
    } else if constexpr (part_quads == 2) {
      return __builtin_shufflevector(quad, quad, 0, 1, 2, 3, 0, 1, 2, 3);
    } else {
      return __builtin_shufflevector(quad, quad, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
    }
#endif
  }
};

/// Three nodes along the last axis; the fourth quad, where there is one, is zero.
template <class T>
using LineRow = NodeRow<T, 3>;

namespace detail {

/// Quads a and b (0 .. 3 of x, 4 .. 7 of y) and, with 16 lanes, c and d, as one part.
template <class T, int a, int b, int c, int d>
SCREE_FN typename NodeRow<T>::Native pick_quads(const NodeRow<T>& x, const NodeRow<T>& y) {
  if constexpr (NodeRow<T>::part_quads == 4) {
    return __builtin_shufflevector(x.part[0], y.part[0], 4 * a, 4 * a + 1, 4 * a + 2, 4 * a + 3,
                                   4 * b, 4 * b + 1, 4 * b + 2, 4 * b + 3, 4 * c, 4 * c + 1,
                                   4 * c + 2, 4 * c + 3, 4 * d, 4 * d + 1, 4 * d + 2, 4 * d + 3);
  } else if constexpr (NodeRow<T>::part_quads == 2) {
    const auto& first = a < 4 ? x.part[a / 2 % 2] : y.part[a / 2 % 2];
    const auto& second = b < 4 ? x.part[b / 2 % 2] : y.part[b / 2 % 2];
    constexpr int i = a % 2 * 4;
    constexpr int j = b % 2 * 4 + 8;
    return __builtin_shufflevector(first, second, i, i + 1, i + 2, i + 3, j, j + 1, j + 2, j + 3);
  } else {
    return a < 4 ? x.part[a % 4] : y.part[a % 4];
  }
}

}  // namespace detail

/// The quads a, b, c, d of x (0 .. 3) and y (4 .. 7).
template <int a, int b, int c, int d, class T>
SCREE_FN NodeRow<T> quads(const NodeRow<T>& x, const NodeRow<T>& y) {
  using detail::pick_quads;
  if constexpr (NodeRow<T>::parts == 1) {
    return {{pick_quads<T, a, b, c, d>(x, y)}};
  } else if constexpr (NodeRow<T>::parts == 2) {
    return {{pick_quads<T, a, b, 0, 0>(x, y), pick_quads<T, c, d, 0, 0>(x, y)}};
  } else {
    return {{pick_quads<T, a, 0, 0, 0>(x, y), pick_quads<T, b, 0, 0, 0>(x, y),
             pick_quads<T, c, 0, 0, 0>(x, y), pick_quads<T, d, 0, 0, 0>(x, y)}};
  }
}

namespace detail {

/// Half of the quads of x and of y: the even ones or the odd ones.
template <class T, int odd>
SCREE_FN typename NodeRow<T>::Native half_quads(const typename NodeRow<T>::Native& x,
                                                const typename NodeRow<T>::Native& y) {
  constexpr int f = 4 * odd;
  if constexpr (NodeRow<T>::part_quads == 4) {
    return __builtin_shufflevector(x, y, f, f + 1, f + 2, f + 3, f + 8, f + 9, f + 10, f + 11,
                                   f + 16, f + 17, f + 18, f + 19, f + 24, f + 25, f + 26, f + 27);
  } else if constexpr (NodeRow<T>::part_quads == 2) {
    return __builtin_shufflevector(x, y, f, f + 1, f + 2, f + 3, f + 8, f + 9, f + 10, f + 11);
  } else {
    return x;
  }
}

}  // namespace detail

/// As many rows as a part has quads: node[n] holds quad n of each row, one behind the other.
template <class T>
SCREE_FN void node_quads(const NodeRow<T> (&rows)[NodeRow<T>::part_quads],
                         typename NodeRow<T>::Native (&node)[4]) {
  constexpr auto even = detail::half_quads<T, 0>;
  constexpr auto odd = detail::half_quads<T, 1>;
  if constexpr (NodeRow<T>::part_quads == 1) {
    SCREE_UNROLL for (int n = 0; n < 4; ++n) node[n] = rows[0].part[n];
  } else if constexpr (NodeRow<T>::part_quads == 2) {
    SCREE_UNROLL for (int i = 0; i < 2; ++i) {
      node[2 * i] = even(rows[0].part[i], rows[1].part[i]);
      node[2 * i + 1] = odd(rows[0].part[i], rows[1].part[i]);
    }
  } else {
    const auto a = even(rows[0].part[0], rows[1].part[0]);
    const auto b = odd(rows[0].part[0], rows[1].part[0]);
    const auto c = even(rows[2].part[0], rows[3].part[0]);
    const auto d = odd(rows[2].part[0], rows[3].part[0]);
    node[0] = even(a, c);
    node[1] = even(b, d);
    node[2] = odd(a, c);
    node[3] = odd(b, d);
  }
}

/// As many rows as a part has quads: the sum of the four quads of each row, one behind the other.
template <class T>
SCREE_FN typename NodeRow<T>::Native totals(const NodeRow<T> (&rows)[NodeRow<T>::part_quads]) {
  const auto folded = [](const auto& x, const auto& y) __attribute__((always_inline)) {
    return detail::half_quads<T, 0>(x, y) + detail::half_quads<T, 1>(x, y);
  };
  if constexpr (NodeRow<T>::part_quads == 1) {
    const auto& p = rows[0].part;
    return (p[0] + p[2]) + (p[1] + p[3]);
  } else if constexpr (NodeRow<T>::part_quads == 2) {
    return folded(rows[0].part[0] + rows[0].part[1], rows[1].part[0] + rows[1].part[1]);
  } else {
    return folded(folded(rows[0].part[0], rows[1].part[0]),
                  folded(rows[2].part[0], rows[3].part[0]));
  }
}

/// f(0), ..., f(n - 1), numbers as types.
template <int n, class F>
SCREE_FN void each_index(F&& f) {
  [&]<int... j>(std::integer_sequence<int, j...>) __attribute__((always_inline)) {
    (f(std::integral_constant<int, j>{}), ...);
  }
  (std::make_integer_sequence<int, n>{});
}

/// A row whose quads are a, b, c, d four times each.
template <class T>
struct QuadPattern {
  alignas(64) T value[16];
  constexpr QuadPattern(T a, T b, T c, T d)
      : value{a, a, a, a, b, b, b, b, c, c, c, c, d, d, d, d} {}
};

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
/// \file
/// SIMD lanes. Point physics is written once over a type V that is either a scalar (float, double)
/// or a Pack of them; every operation below exists for both under the same name and gives the same
/// value in each lane as for a scalar. Compiler vector extensions do the arithmetic; intrinsics are
/// in register_x86.hpp, with portable fallbacks.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "solver/base/config.hpp"
#include "solver/base/register.hpp"

namespace scree {

namespace detail {
/// Whether W lanes of T fit into one register; a wider Pack is two halves.
template <class T, int W>
inline constexpr bool in_one_register = W* int(sizeof(T)) <= register_bytes;
}  // namespace detail

/// One truth value per lane. Integer lanes share the mask of the real lanes of the same size.
template <class T, int W, bool whole = detail::in_one_register<T, W>>
struct Mask {
  Mask<T, W / 2> low, high;

  friend SCREE_FN Mask operator&(Mask a, Mask b) { return {a.low & b.low, a.high & b.high}; }
  friend SCREE_FN Mask operator|(Mask a, Mask b) { return {a.low | b.low, a.high | b.high}; }
  friend SCREE_FN Mask operator!(Mask a) { return {!a.low, !a.high}; }
};

template <class T, int W>
struct Mask<T, W, true> {
  using Bits = typename detail::Register<T, W>::MaskVector;
  Bits bits;

  friend SCREE_FN Mask operator&(Mask a, Mask b) { return {Bits(a.bits & b.bits)}; }
  friend SCREE_FN Mask operator|(Mask a, Mask b) { return {Bits(a.bits | b.bits)}; }
  friend SCREE_FN Mask operator!(Mask a) { return {Bits(~a.bits)}; }
};

/// W lanes of T (float, double, std::int32_t or std::int64_t). Aligned to its size.
template <class T, int W, bool whole = detail::in_one_register<T, W>>
struct alignas(W * sizeof(T)) Pack {
  using Half = Pack<T, W / 2>;
  using MaskType = Mask<T, W>;
  Half low, high;

  friend SCREE_FN Pack operator+(Pack a, Pack b) { return {a.low + b.low, a.high + b.high}; }
  friend SCREE_FN Pack operator-(Pack a, Pack b) { return {a.low - b.low, a.high - b.high}; }
  friend SCREE_FN Pack operator*(Pack a, Pack b) { return {a.low * b.low, a.high * b.high}; }
  friend SCREE_FN Pack operator/(Pack a, Pack b) { return {a.low / b.low, a.high / b.high}; }
  friend SCREE_FN Pack operator+(Pack a, T b) { return {a.low + b, a.high + b}; }
  friend SCREE_FN Pack operator-(Pack a, T b) { return {a.low - b, a.high - b}; }
  friend SCREE_FN Pack operator*(Pack a, T b) { return {a.low * b, a.high * b}; }
  friend SCREE_FN Pack operator/(Pack a, T b) { return {a.low / b, a.high / b}; }
  friend SCREE_FN Pack operator+(T a, Pack b) { return {a + b.low, a + b.high}; }
  friend SCREE_FN Pack operator-(T a, Pack b) { return {a - b.low, a - b.high}; }
  friend SCREE_FN Pack operator*(T a, Pack b) { return {a * b.low, a * b.high}; }
  friend SCREE_FN Pack operator/(T a, Pack b) { return {a / b.low, a / b.high}; }
  friend SCREE_FN Pack operator-(Pack a) { return {-a.low, -a.high}; }

  SCREE_FN Pack& operator+=(Pack b) { return *this = *this + b; }
  SCREE_FN Pack& operator-=(Pack b) { return *this = *this - b; }
  SCREE_FN Pack& operator*=(Pack b) { return *this = *this * b; }

  friend SCREE_FN MaskType operator<(Pack a, Pack b) { return {a.low < b.low, a.high < b.high}; }
  friend SCREE_FN MaskType operator<=(Pack a, Pack b) { return {a.low <= b.low, a.high <= b.high}; }
  friend SCREE_FN MaskType operator>(Pack a, Pack b) { return b < a; }
  friend SCREE_FN MaskType operator>=(Pack a, Pack b) { return b <= a; }
  friend SCREE_FN MaskType operator==(Pack a, Pack b) { return {a.low == b.low, a.high == b.high}; }
  friend SCREE_FN MaskType operator<(Pack a, T b) { return a < all_of(b); }
  friend SCREE_FN MaskType operator<=(Pack a, T b) { return a <= all_of(b); }
  friend SCREE_FN MaskType operator>(Pack a, T b) { return a > all_of(b); }
  friend SCREE_FN MaskType operator>=(Pack a, T b) { return a >= all_of(b); }
  friend SCREE_FN MaskType operator==(Pack a, T b) { return a == all_of(b); }

  // Bit operations, integer lanes only.
  friend SCREE_FN Pack operator&(Pack a, Pack b) { return {a.low & b.low, a.high & b.high}; }
  friend SCREE_FN Pack operator|(Pack a, Pack b) { return {a.low | b.low, a.high | b.high}; }
  friend SCREE_FN Pack operator<<(Pack a, int n) { return {a.low << n, a.high << n}; }
  friend SCREE_FN Pack operator>>(Pack a, int n) { return {a.low >> n, a.high >> n}; }

  /// The same value in every lane.
  static SCREE_FN Pack all_of(T x) { return {Half::all_of(x), Half::all_of(x)}; }
};

template <class T, int W>
struct alignas(W * sizeof(T)) Pack<T, W, true> {
  using Register = detail::Register<T, W>;
  using Vector = typename Register::Vector;
  using MaskType = Mask<T, W>;
  Vector v;

  friend SCREE_FN Pack operator+(Pack a, Pack b) { return {a.v + b.v}; }
  friend SCREE_FN Pack operator-(Pack a, Pack b) { return {a.v - b.v}; }
  friend SCREE_FN Pack operator*(Pack a, Pack b) { return {a.v * b.v}; }
  friend SCREE_FN Pack operator/(Pack a, Pack b) { return {a.v / b.v}; }
  friend SCREE_FN Pack operator+(Pack a, T b) { return {a.v + b}; }
  friend SCREE_FN Pack operator-(Pack a, T b) { return {a.v - b}; }
  friend SCREE_FN Pack operator*(Pack a, T b) { return {a.v * b}; }
  friend SCREE_FN Pack operator/(Pack a, T b) { return {a.v / b}; }
  friend SCREE_FN Pack operator+(T a, Pack b) { return {a + b.v}; }
  friend SCREE_FN Pack operator-(T a, Pack b) { return {a - b.v}; }
  friend SCREE_FN Pack operator*(T a, Pack b) { return {a * b.v}; }
  friend SCREE_FN Pack operator/(T a, Pack b) { return {a / b.v}; }
  friend SCREE_FN Pack operator-(Pack a) { return {-a.v}; }

  SCREE_FN Pack& operator+=(Pack b) { return *this = *this + b; }
  SCREE_FN Pack& operator-=(Pack b) { return *this = *this - b; }
  SCREE_FN Pack& operator*=(Pack b) { return *this = *this * b; }

  friend SCREE_FN MaskType operator<(Pack a, Pack b) { return {Register::less(a.v, b.v)}; }
  friend SCREE_FN MaskType operator<=(Pack a, Pack b) { return {Register::less_equal(a.v, b.v)}; }
  friend SCREE_FN MaskType operator>(Pack a, Pack b) { return b < a; }
  friend SCREE_FN MaskType operator>=(Pack a, Pack b) { return b <= a; }
  friend SCREE_FN MaskType operator==(Pack a, Pack b) { return {Register::equal(a.v, b.v)}; }
  friend SCREE_FN MaskType operator<(Pack a, T b) { return a < all_of(b); }
  friend SCREE_FN MaskType operator<=(Pack a, T b) { return a <= all_of(b); }
  friend SCREE_FN MaskType operator>(Pack a, T b) { return a > all_of(b); }
  friend SCREE_FN MaskType operator>=(Pack a, T b) { return a >= all_of(b); }
  friend SCREE_FN MaskType operator==(Pack a, T b) { return a == all_of(b); }

  friend SCREE_FN Pack operator&(Pack a, Pack b) { return {a.v & b.v}; }
  friend SCREE_FN Pack operator|(Pack a, Pack b) { return {a.v | b.v}; }
  friend SCREE_FN Pack operator<<(Pack a, int n) { return {a.v << n}; }
  friend SCREE_FN Pack operator>>(Pack a, int n) { return {Register::shift_right(a.v, n)}; }

  static SCREE_FN Pack all_of(T x) { return {x - Vector{}}; }
};

/// The project's lane type: 64 bytes whatever the instruction set (16 floats or 8 doubles), so that
/// stored data and results do not depend on it.
template <class T>
using Lanes = Pack<T, 64 / int(sizeof(T))>;

/// The lanes of one register. Long chains of operations on wider packs would keep more values alive
/// than there are registers, and spend their time on moving them to the stack and back.
template <class T>
using RegisterLanes = Pack<T, detail::register_bytes / int(sizeof(T))>;

namespace detail {
template <class V>
struct LaneTraits {
  using Scalar = V;
  using Mask = bool;
  using Int = int;
  using Bits = IntOfSize<V>;
  static constexpr int lanes = 1;
};
template <class T, int W>
struct LaneTraits<Pack<T, W>> {
  using Scalar = T;
  using Mask = scree::Mask<T, W>;
  using Int = Pack<IntOfSize<T>, W>;
  using Bits = Int;
  static constexpr int lanes = W;
};
}  // namespace detail

/// Number of lanes: 1 for a scalar.
template <class V>
inline constexpr int lanes_of = detail::LaneTraits<V>::lanes;
/// Scalar type of a lane.
template <class V>
using Scalar = typename detail::LaneTraits<V>::Scalar;
/// Result of a comparison: bool for a scalar.
template <class V>
using MaskOf = typename detail::LaneTraits<V>::Mask;
/// Integers that to_int gives: int for scalars, 32-bit lanes for float, 64-bit lanes for double.
template <class V>
using IntOf = typename detail::LaneTraits<V>::Int;
/// Integers as wide as the reals, for work on their bits.
template <class V>
using BitsOf = typename detail::LaneTraits<V>::Bits;

}  // namespace scree

#include "solver/base/pack_functions.hpp"

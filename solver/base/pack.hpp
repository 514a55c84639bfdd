// SPDX-License-Identifier: Apache-2.0
/// \file
/// SIMD lanes. Point physics is written once over a type V that is either a scalar (float, double)
/// or a Pack of them; every operation below exists for both under the same name and gives the same
/// value in each lane as for a scalar. Compiler vector extensions do the arithmetic; the few
/// intrinsics of the project are in this file, with portable fallbacks.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "solver/base/config.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && !defined(__CUDACC__)
#define SCREE_AVX512 1
#include <immintrin.h>
#elif defined(__SSE2__) && !defined(__CUDACC__)
#include <immintrin.h>
#endif

namespace scree {

namespace detail {

template <class T>
using IntOfSize = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

template <class T, int W>
struct VectorOf {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};

#ifdef SCREE_AVX512
/// Lanes of one 64-byte register use the mask registers of AVX-512.
template <class T, int W>
inline constexpr bool uses_mask_register = W * sizeof(T) == 64;
#else
template <class T, int W>
inline constexpr bool uses_mask_register = false;
#endif

template <class T, int W>
struct MaskStorage {
  using type = typename VectorOf<IntOfSize<T>, W>::type;
};
#ifdef SCREE_AVX512
template <>
struct MaskStorage<float, 16> {
  using type = __mmask16;
};
template <>
struct MaskStorage<double, 8> {
  using type = __mmask8;
};
template <>
struct MaskStorage<std::int32_t, 16> {
  using type = __mmask16;
};
template <>
struct MaskStorage<std::int64_t, 8> {
  using type = __mmask8;
};
#endif

}  // namespace detail

/// One truth value per lane. Integer lanes share the mask of the real lanes of the same size.
template <class T, int W>
struct Mask {
  using Storage = typename detail::MaskStorage<T, W>::type;
  Storage bits;

  friend SCREE_FN Mask operator&(Mask a, Mask b) { return {Storage(a.bits & b.bits)}; }
  friend SCREE_FN Mask operator|(Mask a, Mask b) { return {Storage(a.bits | b.bits)}; }
  friend SCREE_FN Mask operator!(Mask a) { return {Storage(~a.bits)}; }
};

/// W lanes of T (float, double, std::int32_t or std::int64_t). Aligned to its size.
template <class T, int W>
struct alignas(W * sizeof(T)) Pack {
  using Vector = typename detail::VectorOf<T, W>::type;
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

  friend SCREE_FN MaskType operator<(Pack a, Pack b) { return compare<0>(a, b); }
  friend SCREE_FN MaskType operator<=(Pack a, Pack b) { return compare<1>(a, b); }
  friend SCREE_FN MaskType operator>(Pack a, Pack b) { return compare<0>(b, a); }
  friend SCREE_FN MaskType operator>=(Pack a, Pack b) { return compare<1>(b, a); }
  friend SCREE_FN MaskType operator==(Pack a, Pack b) { return compare<2>(a, b); }
  friend SCREE_FN MaskType operator<(Pack a, T b) { return a < all_of(b); }
  friend SCREE_FN MaskType operator<=(Pack a, T b) { return a <= all_of(b); }
  friend SCREE_FN MaskType operator>(Pack a, T b) { return a > all_of(b); }
  friend SCREE_FN MaskType operator>=(Pack a, T b) { return a >= all_of(b); }
  friend SCREE_FN MaskType operator==(Pack a, T b) { return a == all_of(b); }

  // Bit operations, integer lanes only.
  friend SCREE_FN Pack operator&(Pack a, Pack b) { return {a.v & b.v}; }
  friend SCREE_FN Pack operator|(Pack a, Pack b) { return {a.v | b.v}; }
  friend SCREE_FN Pack operator<<(Pack a, int n) { return {a.v << n}; }
  friend SCREE_FN Pack operator>>(Pack a, int n) { return {a.v >> n}; }

  /// The same value in every lane.
  static SCREE_FN Pack all_of(T x) { return {x - Vector{}}; }

 private:
  template <int Op>  // 0: <, 1: <=, 2: ==
  static SCREE_FN MaskType compare(Pack a, Pack b) {
#ifdef SCREE_AVX512
    constexpr int real_op = Op == 0 ? _CMP_LT_OQ : Op == 1 ? _CMP_LE_OQ : _CMP_EQ_OQ;
    constexpr auto int_op = Op == 0 ? _MM_CMPINT_LT : Op == 1 ? _MM_CMPINT_LE : _MM_CMPINT_EQ;
    if constexpr (std::is_same_v<T, float> && W == 16) {
      return {_mm512_cmp_ps_mask(__m512(a.v), __m512(b.v), real_op)};
    } else if constexpr (std::is_same_v<T, double> && W == 8) {
      return {_mm512_cmp_pd_mask(__m512d(a.v), __m512d(b.v), real_op)};
    } else if constexpr (std::is_same_v<T, std::int32_t> && W == 16) {
      return {_mm512_cmp_epi32_mask(__m512i(a.v), __m512i(b.v), int_op)};
    } else if constexpr (std::is_same_v<T, std::int64_t> && W == 8) {
      return {_mm512_cmp_epi64_mask(__m512i(a.v), __m512i(b.v), int_op)};
    } else
#endif
        if constexpr (Op == 0) {
      return {typename MaskType::Storage(a.v < b.v)};
    } else if constexpr (Op == 1) {
      return {typename MaskType::Storage(a.v <= b.v)};
    } else {
      return {typename MaskType::Storage(a.v == b.v)};
    }
  }
};

/// The project's lane type: 64 bytes whatever the instruction set (16 floats or 8 doubles), so that
/// stored data and results do not depend on it.
template <class T>
using Lanes = Pack<T, 64 / int(sizeof(T))>;

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

// SPDX-License-Identifier: Apache-2.0
/// \file
/// Functions on scalars and Packs alike; included through pack.hpp.
#pragma once

#include "solver/base/pack.hpp"

namespace scree {

#ifdef SCREE_AVX512
namespace detail {
// The forms with a full mask compile to the plain instructions; the plain intrinsics of GCC 12 pass
// an uninitialised operand, which -Wmaybe-uninitialized reports.
inline constexpr int every_lane = -1;
}  // namespace detail
#endif

// ---- broadcast, memory, single lanes ----

/// V with x in every lane.
template <class V>
SCREE_FN V broadcast(Scalar<V> x) {
  if constexpr (lanes_of<V> == 1) {
    return x;
  } else {
    return V::all_of(x);
  }
}

/// Reads lanes_of<V> consecutive scalars; p is aligned to sizeof(V).
template <class V>
SCREE_FN V load(const Scalar<V>* p) {
  if constexpr (lanes_of<V> == 1) {
    return *p;
  } else {
    typedef typename V::Vector __attribute__((may_alias)) Aliased;
    return {typename V::Vector(*reinterpret_cast<const Aliased*>(p))};
  }
}

/// Writes lanes_of<V> consecutive scalars; p is aligned to sizeof(V).
template <class V>
SCREE_FN void store(Scalar<V>* p, V x) {
  if constexpr (lanes_of<V> == 1) {
    *p = x;
  } else {
    typedef typename V::Vector __attribute__((may_alias)) Aliased;
    *reinterpret_cast<Aliased*>(p) = x.v;
  }
}

/// Value of lane i, 0 <= i < lanes_of<V>.
template <class V>
SCREE_FN Scalar<V> lane(const V& x, int i) {
  if constexpr (lanes_of<V> == 1) {
    (void)i;
    return x;
  } else {
    return x.v[i];
  }
}

/// Sets lane i, 0 <= i < lanes_of<V>.
template <class V>
SCREE_FN void set_lane(V& x, int i, Scalar<V> value) {
  if constexpr (lanes_of<V> == 1) {
    (void)i;
    x = value;
  } else {
    x.v[i] = value;
  }
}

// ---- masks ----

SCREE_FN bool any(bool m) { return m; }
SCREE_FN bool all(bool m) { return m; }
SCREE_FN bool lane(bool m, int) { return m; }

/// Truth value of lane i.
template <class T, int W>
SCREE_FN bool lane(Mask<T, W> m, int i) {
  if constexpr (detail::uses_mask_register<T, W>) {
    return (m.bits >> i) & 1;
  } else {
    return m.bits[i] != 0;
  }
}

/// True if any lane is true.
template <class T, int W>
SCREE_FN bool any(Mask<T, W> m) {
  if constexpr (detail::uses_mask_register<T, W>) {
    return m.bits != 0;
  } else {
    bool found = false;
    for (int i = 0; i < W; ++i) found = found | (m.bits[i] != 0);
    return found;
  }
}

/// True if every lane is true.
template <class T, int W>
SCREE_FN bool all(Mask<T, W> m) {
  return !any(!m);
}

/// True in the first n lanes: the lanes in use at the end of a list.
template <class V>
SCREE_FN MaskOf<V> first_lanes(int n) {
  if constexpr (lanes_of<V> == 1) {
    return n > 0;
  } else {
    V index{};
    SCREE_UNROLL for (int i = 0; i < lanes_of<V>; ++i) index.v[i] = Scalar<V>(i);
    return index < Scalar<V>(n);
  }
}

SCREE_FN float select(bool m, float a, float b) { return m ? a : b; }
SCREE_FN double select(bool m, double a, double b) { return m ? a : b; }

/// a where the mask is true, else b. Both are computed: the branch not taken must not divide by
/// zero.
template <class T, int W>
SCREE_FN Pack<T, W> select(Mask<T, W> m, Pack<T, W> a, Pack<T, W> b) {
#ifdef SCREE_AVX512
  if constexpr (std::is_same_v<T, float> && W == 16) {
    return {typename Pack<T, W>::Vector(_mm512_mask_blend_ps(m.bits, __m512(b.v), __m512(a.v)))};
  } else if constexpr (std::is_same_v<T, double> && W == 8) {
    return {typename Pack<T, W>::Vector(_mm512_mask_blend_pd(m.bits, __m512d(b.v), __m512d(a.v)))};
  } else if constexpr (std::is_same_v<T, std::int32_t> && W == 16) {
    return {
        typename Pack<T, W>::Vector(_mm512_mask_blend_epi32(m.bits, __m512i(b.v), __m512i(a.v)))};
  } else if constexpr (std::is_same_v<T, std::int64_t> && W == 8) {
    return {
        typename Pack<T, W>::Vector(_mm512_mask_blend_epi64(m.bits, __m512i(b.v), __m512i(a.v)))};
  } else
#endif
  {
    return {m.bits ? a.v : b.v};
  }
}
template <class T, int W>
SCREE_FN Pack<T, W> select(Mask<T, W> m, Pack<T, W> a, std::type_identity_t<T> b) {
  return select(m, a, Pack<T, W>::all_of(b));
}
template <class T, int W>
SCREE_FN Pack<T, W> select(Mask<T, W> m, std::type_identity_t<T> a, Pack<T, W> b) {
  return select(m, Pack<T, W>::all_of(a), b);
}

// ---- min, max, abs, rounding, roots ----

SCREE_FN float min(float a, float b) { return a < b ? a : b; }
SCREE_FN double min(double a, double b) { return a < b ? a : b; }
SCREE_FN float max(float a, float b) { return a > b ? a : b; }
SCREE_FN double max(double a, double b) { return a > b ? a : b; }
SCREE_FN float abs(float a) { return ::fabsf(a); }
SCREE_FN double abs(double a) { return ::fabs(a); }
SCREE_FN float floor(float a) { return ::floorf(a); }
SCREE_FN double floor(double a) { return ::floor(a); }
SCREE_FN float sqrt(float a) { return ::sqrtf(a); }
SCREE_FN double sqrt(double a) { return ::sqrt(a); }
SCREE_FN float fma(float a, float b, float c) { return ::fmaf(a, b, c); }
SCREE_FN double fma(double a, double b, double c) { return ::fma(a, b, c); }
SCREE_FN int to_int(float a) { return int(a); }
SCREE_FN int to_int(double a) { return int(a); }

/// a < b ? a : b; the second operand where either is not a number (like the machine instruction).
template <class T, int W>
SCREE_FN Pack<T, W> min(Pack<T, W> a, Pack<T, W> b) {
  return select(a < b, a, b);
}
template <class T, int W>
SCREE_FN Pack<T, W> min(Pack<T, W> a, std::type_identity_t<T> b) {
  return min(a, Pack<T, W>::all_of(b));
}
template <class T, int W>
SCREE_FN Pack<T, W> max(Pack<T, W> a, Pack<T, W> b) {
  return select(a > b, a, b);
}
template <class T, int W>
SCREE_FN Pack<T, W> max(Pack<T, W> a, std::type_identity_t<T> b) {
  return max(a, Pack<T, W>::all_of(b));
}

#ifdef SCREE_AVX512
SCREE_FN Pack<float, 16> min(Pack<float, 16> a, Pack<float, 16> b) {
  return {
      Pack<float, 16>::Vector(_mm512_maskz_min_ps(detail::every_lane, __m512(a.v), __m512(b.v)))};
}
SCREE_FN Pack<double, 8> min(Pack<double, 8> a, Pack<double, 8> b) {
  return {
      Pack<double, 8>::Vector(_mm512_maskz_min_pd(detail::every_lane, __m512d(a.v), __m512d(b.v)))};
}
SCREE_FN Pack<float, 16> max(Pack<float, 16> a, Pack<float, 16> b) {
  return {
      Pack<float, 16>::Vector(_mm512_maskz_max_ps(detail::every_lane, __m512(a.v), __m512(b.v)))};
}
SCREE_FN Pack<double, 8> max(Pack<double, 8> a, Pack<double, 8> b) {
  return {
      Pack<double, 8>::Vector(_mm512_maskz_max_pd(detail::every_lane, __m512d(a.v), __m512d(b.v)))};
}
#endif

/// Absolute value: clears the sign bit.
template <class T, int W>
SCREE_FN Pack<T, W> abs(Pack<T, W> a) {
  using Bits = typename Pack<detail::IntOfSize<T>, W>::Vector;
  constexpr auto sign = std::make_unsigned_t<detail::IntOfSize<T>>(1) << (8 * sizeof(T) - 1);
  return {typename Pack<T, W>::Vector(Bits(a.v) & detail::IntOfSize<T>(~sign))};
}

/// Largest integer not above a.
template <class T, int W>
SCREE_FN Pack<T, W> floor(Pack<T, W> a) {
#ifdef SCREE_AVX512
  constexpr int down = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
  if constexpr (std::is_same_v<T, float> && W == 16) {
    return {typename Pack<T, W>::Vector(
        _mm512_maskz_roundscale_ps(detail::every_lane, __m512(a.v), down))};
  } else if constexpr (std::is_same_v<T, double> && W == 8) {
    return {typename Pack<T, W>::Vector(
        _mm512_maskz_roundscale_pd(detail::every_lane, __m512d(a.v), down))};
  } else
#endif
  {
    SCREE_UNROLL for (int i = 0; i < W; ++i) a.v[i] = floor(T(a.v[i]));
    return a;
  }
}

/// Square root; the argument must not be negative.
template <class T, int W>
SCREE_FN Pack<T, W> sqrt(Pack<T, W> a) {
#ifdef SCREE_AVX512
  if constexpr (std::is_same_v<T, float> && W == 16) {
    return {typename Pack<T, W>::Vector(_mm512_maskz_sqrt_ps(detail::every_lane, __m512(a.v)))};
  } else if constexpr (std::is_same_v<T, double> && W == 8) {
    return {typename Pack<T, W>::Vector(_mm512_maskz_sqrt_pd(detail::every_lane, __m512d(a.v)))};
  } else
#endif
  {
    SCREE_UNROLL for (int i = 0; i < W; ++i) a.v[i] = sqrt(T(a.v[i]));
    return a;
  }
}

/// a b + c with one rounding.
template <class T, int W>
SCREE_FN Pack<T, W> fma(Pack<T, W> a, Pack<T, W> b, Pack<T, W> c) {
#ifdef SCREE_AVX512
  if constexpr (std::is_same_v<T, float> && W == 16) {
    return {typename Pack<T, W>::Vector(_mm512_fmadd_ps(__m512(a.v), __m512(b.v), __m512(c.v)))};
  } else if constexpr (std::is_same_v<T, double> && W == 8) {
    return {typename Pack<T, W>::Vector(_mm512_fmadd_pd(__m512d(a.v), __m512d(b.v), __m512d(c.v)))};
  } else
#endif
  {
    SCREE_UNROLL for (int i = 0; i < W; ++i) a.v[i] = fma(T(a.v[i]), T(b.v[i]), T(c.v[i]));
    return a;
  }
}

/// a b + c, fused where the machine can do so in one instruction (fma would call a slow library
/// function elsewhere). The same choice for scalars and lanes.
template <class V>
SCREE_FN V mul_add(V a, V b, V c) {
#if defined(__FMA__) || defined(__CUDA_ARCH__)
  return fma(a, b, c);
#else
  return a * b + c;
#endif
}

#ifdef SCREE_AVX512
namespace detail {
// Approximations of the machine with a relative error below 2^-14; no floating-point exceptions.
SCREE_FN float rsqrt14(float a) {
  return _mm_cvtss_f32(_mm_maskz_rsqrt14_ss(__mmask8(1), _mm_set_ss(a), _mm_set_ss(a)));
}
SCREE_FN double rsqrt14(double a) {
  return _mm_cvtsd_f64(_mm_maskz_rsqrt14_sd(__mmask8(1), _mm_set_sd(a), _mm_set_sd(a)));
}
SCREE_FN Lanes<float> rsqrt14(Lanes<float> a) {
  return {Lanes<float>::Vector(_mm512_maskz_rsqrt14_ps(every_lane, __m512(a.v)))};
}
SCREE_FN Lanes<double> rsqrt14(Lanes<double> a) {
  return {Lanes<double>::Vector(_mm512_maskz_rsqrt14_pd(every_lane, __m512d(a.v)))};
}
SCREE_FN float rcp14(float a) {
  return _mm_cvtss_f32(_mm_maskz_rcp14_ss(__mmask8(1), _mm_set_ss(a), _mm_set_ss(a)));
}
SCREE_FN double rcp14(double a) {
  return _mm_cvtsd_f64(_mm_maskz_rcp14_sd(__mmask8(1), _mm_set_sd(a), _mm_set_sd(a)));
}
SCREE_FN Lanes<float> rcp14(Lanes<float> a) {
  return {Lanes<float>::Vector(_mm512_maskz_rcp14_ps(every_lane, __m512(a.v)))};
}
SCREE_FN Lanes<double> rcp14(Lanes<double> a) {
  return {Lanes<double>::Vector(_mm512_maskz_rcp14_pd(every_lane, __m512d(a.v)))};
}
template <class V>
concept HasApproximations = requires(V a) {
  rsqrt14(a);
};
}  // namespace detail
#endif

/// 1/sqrt(a) for positive normal a whose root is normal; error below 2 units in the last place.
/// Newton steps from the machine's approximation where there is one (scalars use it too, so that
/// lanes and scalars agree): 512-bit roots and divisions are several times slower.
template <class V>
SCREE_FN V rsqrt(V a) {
#ifdef SCREE_AVX512
  if constexpr (detail::HasApproximations<V>) {
    using T = Scalar<V>;
    const V one = broadcast<V>(T(1));
    V y = detail::rsqrt14(a);
    SCREE_UNROLL for (int i = 0; i < (sizeof(T) == 4 ? 1 : 2); ++i) {
      y = fma(T(0.5) * y, fma(-(a * y), y, one), y);
    }
    return y;
  }
#endif
  return Scalar<V>(1) / sqrt(a);
}

/// 1/a for normal a whose reciprocal is normal; error below 2 units in the last place, as rsqrt.
template <class V>
SCREE_FN V rcp(V a) {
#ifdef SCREE_AVX512
  if constexpr (detail::HasApproximations<V>) {
    const V one = broadcast<V>(Scalar<V>(1));
    V y = detail::rcp14(a);
    SCREE_UNROLL for (int i = 0; i < (sizeof(Scalar<V>) == 4 ? 1 : 2); ++i) {
      y = fma(y, fma(-a, y, one), y);
    }
    return y;
  }
#endif
  return Scalar<V>(1) / a;
}

/// Conversion to integers, towards zero; the value must fit.
template <class T, int W>
SCREE_FN IntOf<Pack<T, W>> to_int(Pack<T, W> a) {
  using Int = IntOf<Pack<T, W>>;
#if defined(__CUDACC__)
  Int r{};
  for (int i = 0; i < W; ++i) r.v[i] = detail::IntOfSize<T>(a.v[i]);
  return r;
#else
  return {__builtin_convertvector(a.v, typename Int::Vector)};
#endif
}

// ---- bits ----

#if defined(__CUDA_ARCH__)
SCREE_FN std::int32_t to_bits(float a) { return __float_as_int(a); }
SCREE_FN std::int64_t to_bits(double a) { return __double_as_longlong(a); }
SCREE_FN float from_bits(std::int32_t a) { return __int_as_float(a); }
SCREE_FN double from_bits(std::int64_t a) { return __longlong_as_double(a); }
#else
SCREE_FN std::int32_t to_bits(float a) { return __builtin_bit_cast(std::int32_t, a); }
SCREE_FN std::int64_t to_bits(double a) { return __builtin_bit_cast(std::int64_t, a); }
SCREE_FN float from_bits(std::int32_t a) { return __builtin_bit_cast(float, a); }
SCREE_FN double from_bits(std::int64_t a) { return __builtin_bit_cast(double, a); }
#endif

/// The bits of a real as an integer of the same size, and back.
template <class T, int W>
SCREE_FN BitsOf<Pack<T, W>> to_bits(Pack<T, W> a) {
  return {typename BitsOf<Pack<T, W>>::Vector(a.v)};
}
template <int W>
SCREE_FN Pack<float, W> from_bits(Pack<std::int32_t, W> a) {
  return {typename Pack<float, W>::Vector(a.v)};
}
template <int W>
SCREE_FN Pack<double, W> from_bits(Pack<std::int64_t, W> a) {
  return {typename Pack<double, W>::Vector(a.v)};
}

}  // namespace scree

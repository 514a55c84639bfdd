// SPDX-License-Identifier: Apache-2.0
/// \file
/// Functions on scalars and Packs alike; included through pack.hpp.
#pragma once

#include "solver/base/pack.hpp"

namespace scree {

namespace detail {
template <class V>
inline constexpr bool is_split = requires {
  typename V::Half;
};
template <class I>
using RealOfSize = std::conditional_t<sizeof(I) == 4, float, double>;
}  // namespace detail

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
  } else if constexpr (detail::is_split<V>) {
    using Half = typename V::Half;
    return {load<Half>(p), load<Half>(p + lanes_of<Half>)};
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
  } else if constexpr (detail::is_split<V>) {
    store(p, x.low);
    store(p + lanes_of<V> / 2, x.high);
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
  } else if constexpr (detail::is_split<V>) {
    return i < lanes_of<V> / 2 ? lane(x.low, i) : lane(x.high, i - lanes_of<V> / 2);
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
  } else if constexpr (detail::is_split<V>) {
    if (i < lanes_of<V> / 2) {
      set_lane(x.low, i, value);
    } else {
      set_lane(x.high, i - lanes_of<V> / 2, value);
    }
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
  if constexpr (!detail::in_one_register<T, W>) {
    return i < W / 2 ? lane(m.low, i) : lane(m.high, i - W / 2);
  } else if constexpr (detail::Register<T, W>::mask_bits) {
    return (m.bits >> i) & 1;
  } else {
    return m.bits[i] != 0;
  }
}

/// True if any lane is true.
template <class T, int W>
SCREE_FN bool any(Mask<T, W> m) {
  if constexpr (!detail::in_one_register<T, W>) {
    return any(m.low | m.high);
  } else {
    return detail::Register<T, W>::any(m.bits);
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
    SCREE_UNROLL for (int i = 0; i < lanes_of<V>; ++i) set_lane(index, i, Scalar<V>(i));
    return index < Scalar<V>(n);
  }
}

SCREE_FN float select(bool m, float a, float b) { return m ? a : b; }
SCREE_FN double select(bool m, double a, double b) { return m ? a : b; }

/// a where the mask is true, else b. Both are computed: the branch not taken must not divide by
/// zero.
template <class T, int W>
SCREE_FN Pack<T, W> select(Mask<T, W> m, Pack<T, W> a, Pack<T, W> b) {
  if constexpr (!detail::in_one_register<T, W>) {
    return {select(m.low, a.low, b.low), select(m.high, a.high, b.high)};
  } else {
    return {detail::Register<T, W>::select(m.bits, a.v, b.v)};
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
  if constexpr (!detail::in_one_register<T, W>) {
    return {min(a.low, b.low), min(a.high, b.high)};
  } else {
    return {detail::Register<T, W>::min(a.v, b.v)};
  }
}
template <class T, int W>
SCREE_FN Pack<T, W> min(Pack<T, W> a, std::type_identity_t<T> b) {
  return min(a, Pack<T, W>::all_of(b));
}
template <class T, int W>
SCREE_FN Pack<T, W> max(Pack<T, W> a, Pack<T, W> b) {
  if constexpr (!detail::in_one_register<T, W>) {
    return {max(a.low, b.low), max(a.high, b.high)};
  } else {
    return {detail::Register<T, W>::max(a.v, b.v)};
  }
}
template <class T, int W>
SCREE_FN Pack<T, W> max(Pack<T, W> a, std::type_identity_t<T> b) {
  return max(a, Pack<T, W>::all_of(b));
}

/// Absolute value: clears the sign bit.
template <class T, int W>
SCREE_FN Pack<T, W> abs(Pack<T, W> a) {
  if constexpr (!detail::in_one_register<T, W>) {
    return {abs(a.low), abs(a.high)};
  } else {
    using Bits = typename detail::Register<T, W>::IntVector;
    constexpr auto sign = std::make_unsigned_t<detail::IntOfSize<T>>(1) << (8 * sizeof(T) - 1);
    return {typename Pack<T, W>::Vector(Bits(a.v) & detail::IntOfSize<T>(~sign))};
  }
}

/// Largest integer not above a.
template <class T, int W>
SCREE_FN Pack<T, W> floor(Pack<T, W> a) {
  if constexpr (!detail::in_one_register<T, W>) {
    return {floor(a.low), floor(a.high)};
  } else {
    return {detail::Register<T, W>::floor(a.v)};
  }
}

/// Square root; the argument must not be negative.
template <class T, int W>
SCREE_FN Pack<T, W> sqrt(Pack<T, W> a) {
  if constexpr (!detail::in_one_register<T, W>) {
    return {sqrt(a.low), sqrt(a.high)};
  } else {
    return {detail::Register<T, W>::sqrt(a.v)};
  }
}

/// a b + c with one rounding.
template <class T, int W>
SCREE_FN Pack<T, W> fma(Pack<T, W> a, Pack<T, W> b, Pack<T, W> c) {
  if constexpr (!detail::in_one_register<T, W>) {
    return {fma(a.low, b.low, c.low), fma(a.high, b.high, c.high)};
  } else {
    return {detail::Register<T, W>::fma(a.v, b.v, c.v)};
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
  if constexpr (detail::is_split<V>) {
    return {rsqrt(a.low), rsqrt(a.high)};
  } else if constexpr (detail::HasApproximations<V>) {
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
  if constexpr (detail::is_split<V>) {
    return {rcp(a.low), rcp(a.high)};
  } else if constexpr (detail::HasApproximations<V>) {
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

/// Conversion to integers, towards zero; the value must fit into 32 bits.
template <class T, int W>
SCREE_FN IntOf<Pack<T, W>> to_int(Pack<T, W> a) {
  if constexpr (!detail::in_one_register<T, W>) {
    return {to_int(a.low), to_int(a.high)};
  } else {
    return {detail::Register<T, W>::to_int(a.v)};
  }
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
  if constexpr (!detail::in_one_register<T, W>) {
    return {to_bits(a.low), to_bits(a.high)};
  } else {
    return {typename BitsOf<Pack<T, W>>::Vector(a.v)};
  }
}
template <class I, int W>
SCREE_FN Pack<detail::RealOfSize<I>, W> from_bits(Pack<I, W> a) {
  if constexpr (!detail::in_one_register<I, W>) {
    return {from_bits(a.low), from_bits(a.high)};
  } else {
    return {typename Pack<detail::RealOfSize<I>, W>::Vector(a.v)};
  }
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
/// \file
/// log, log1p, exp, expm1 and sin over scalars and SIMD lanes: one branch-free code, so that every
/// lane gets what a scalar gets. The polynomials are minimax fits (Remez exchange; that of sin is
/// an interpolation in Chebyshev points) made for this project. None raises a floating-point
/// exception inside its stated range.
#pragma once

#include "solver/base/pack.hpp"

namespace scree {

namespace detail {

/// Constants of the reductions x = m 2^k and x = r + n ln 2. ln2_hi has so many trailing zero bits
/// that k * ln2_hi is exact for every exponent k; ln2_hi + ln2_lo = ln 2.
template <class T>
struct MathConstants;

template <>
struct MathConstants<float> {
  static constexpr std::int32_t sqrt_half_bits = 0x3f3504f3;  // sqrt(1/2)
  static constexpr int mantissa_bits = 23;
  static constexpr float magic = 12582912.0f;  // 1.5 * 2^23: adding it rounds to an integer
  static constexpr std::int32_t magic_bits = 0x4b400000;
  static constexpr std::int32_t one_bits = 0x3f800000;
  static constexpr float ln2_hi = 0.693145751953125f;
  static constexpr float ln2_lo = 1.4286068203094172e-6f;
  static constexpr float exp_min = -87.0f, exp_max = 88.0f;
};

template <>
struct MathConstants<double> {
  static constexpr std::int64_t sqrt_half_bits = 0x3fe6a09e667f3bcd;
  static constexpr int mantissa_bits = 52;
  static constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52
  static constexpr std::int64_t magic_bits = 0x4338000000000000;
  static constexpr std::int64_t one_bits = 0x3ff0000000000000;
  static constexpr double ln2_hi = 0.69314718055989033;
  static constexpr double ln2_lo = 5.4979230187083712e-14;
  static constexpr double exp_min = -708.0, exp_max = 709.0;
};

template <class V, class T, int N>
SCREE_FN V horner(V x, const T (&c)[N]) {
  V p = broadcast<V>(c[N - 1]);
  SCREE_UNROLL for (int i = N - 2; i >= 0; --i) p = mul_add(p, x, broadcast<V>(c[i]));
  return p;
}

/// (2 atanh(s) - 2 s)/s^3 as a polynomial in z = s^2, |s| <= (sqrt 2 - 1)/(sqrt 2 + 1); relative
/// error of 2 atanh(s): 8e-10 (float), 1.3e-18 (double).
template <class V>
SCREE_FN V log_tail(V z) {
  if constexpr (sizeof(Scalar<V>) == 4) {
    constexpr float c[] = {0.66666777043930433f, 0.39977449540215278f, 0.29874431060749316f};
    return horner(z, c);
  } else {
    constexpr double c[] = {0.66666666666667352082, 0.39999999999408662238, 0.28571428743889169083,
                            0.22222198402555063706, 0.18183574026479947578, 0.15313781950321858566,
                            0.14798832379261598463};
    return horner(z, c);
  }
}

/// (e^r - 1 - r)/r^2 for |r| <= ln(2)/2; relative error of e^r - 1: 1.4e-8 (float), 1.9e-17
/// (double).
template <class V>
SCREE_FN V exp_tail(V r) {
  if constexpr (sizeof(Scalar<V>) == 4) {
    constexpr float c[] = {0.50000000630111575f, 0.16666542583018048f, 0.041666279428738979f,
                           0.0083666423386614074f, 0.0013946603363026183f};
    return horner(r, c);
  } else {
    constexpr double c[] = {0.5000000000000005577,      0.16666666666666687377,
                            0.041666666666573009503,    0.0083333333333136943105,
                            0.0013888888932618186702,   0.00019841269904931662479,
                            0.000024801504132749596165, 2.7557226300067518953e-6,
                            2.7626458099198196527e-7,   2.5114984221370784682e-8};
    return horner(r, c);
  }
}

/// (sin(x)/x - 1)/z as a polynomial in z = x^2, |x| <= pi/2; relative error of sin(x): 1.1e-10
/// (float), 1.3e-18 (double).
template <class V>
SCREE_FN V sin_tail(V z) {
  if constexpr (sizeof(Scalar<V>) == 4) {
    constexpr float c[] = {-0.166666667f, 0.00833333277f, -0.00019841086f, 2.75364224e-06f,
                           -2.4079237e-08f};
    return horner(z, c);
  } else {
    constexpr double c[] = {-0.16666666666666665741,    0.0083333333333333158705,
                            -0.00019841269841254884684, 2.7557319219139182692e-06,
                            -2.5052107613934760188e-08, 1.6058977114074673448e-10,
                            -7.6439639659253568759e-13, 2.7313658674940168867e-15};
    return horner(z, c);
  }
}

/// x = r + n ln 2 with |r| <= ln(2)/2: gives e^r - 1 and 2^n.
template <class V>
SCREE_FN V exp_parts(V x, V& scale) {
  using T = Scalar<V>;
  using C = MathConstants<T>;
  using Bits = decltype(C::one_bits);
  x = min(max(x, broadcast<V>(C::exp_min)), broadcast<V>(C::exp_max));
  const V shifted = mul_add(x, broadcast<V>(T(1.4426950408889634074)), broadcast<V>(C::magic));
  const V n = shifted - C::magic;
  const V r = mul_add(n, broadcast<V>(-C::ln2_lo), mul_add(n, broadcast<V>(-C::ln2_hi), x));
  scale =
      from_bits(((to_bits(shifted) - Bits(C::magic_bits)) << C::mantissa_bits) + Bits(C::one_bits));
  return mul_add(r * r, exp_tail(r), r);
}

}  // namespace detail

/// Natural logarithm of a positive normal number; error below 1 unit in the last place
/// (tested: 1.0). For other arguments the result is meaningless, but no exception is raised.
template <class V>
SCREE_FN V log(V x) {
  using T = Scalar<V>;
  using C = detail::MathConstants<T>;
  using Bits = decltype(C::one_bits);
  // x = m 2^k, m in [sqrt(1/2), sqrt 2): so f = m - 1 is exact and log(x) near 1 keeps full
  // accuracy.
  const auto bits = to_bits(x);
  const auto k = (bits - Bits(C::sqrt_half_bits)) >> C::mantissa_bits;
  const V f = from_bits(bits - (k << C::mantissa_bits)) - T(1);
  const V n = from_bits(k + Bits(C::magic_bits)) - C::magic;
  const V s = f * rcp(f + T(2));
  const V z = s * s;
  const V half_square = T(0.5) * f * f;
  const V tail = mul_add(s, half_square + z * detail::log_tail(z), n * C::ln2_lo);
  return mul_add(n, broadcast<V>(C::ln2_hi), f - (half_square - tail));
}

/// log(1 + x) for -1 < x, 1 + x normal, accurate also for small x; error below 2 units in the last
/// place.
template <class V>
SCREE_FN V log1p(V x) {
  using T = Scalar<V>;
  const V u = T(1) + x;
  const V lost = x - (u - T(1));  // what rounding took from 1 + x, exactly
  return log(u) + lost * rcp(u);
}

/// e^x; error below 1.5 units in the last place. x is limited to [-87, 88] (float), [-708, 709]
/// (double).
template <class V>
SCREE_FN V exp(V x) {
  V scale;
  const V e = detail::exp_parts(x, scale);
  return mul_add(scale, e, scale);
}

/// e^x - 1, accurate also for small x; error below 3 units in the last place, limits as for exp.
template <class V>
SCREE_FN V expm1(V x) {
  V scale;
  const V e = detail::exp_parts(x, scale);
  return mul_add(scale, e, scale - Scalar<V>(1));
}

/// Sine for |x| <= pi/2; error below 2 units in the last place.
template <class V>
SCREE_FN V sin(V x) {
  const V z = x * x;
  return mul_add(x * z, detail::sin_tail(z), x);
}

}  // namespace scree

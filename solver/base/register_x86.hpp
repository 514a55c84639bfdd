// SPDX-License-Identifier: Apache-2.0
/// \file
/// Registers of x86; included through register.hpp. Minimum and maximum are a < b ? a : b and
/// a > b ? a : b, as the instructions have it, hence the second operand where one is not a number.
#pragma once

#include "solver/base/register.hpp"

#if defined(__SSE2__) && !defined(__CUDACC__)
namespace scree::detail {

#ifdef SCREE_AVX512

// The forms with a full mask compile to the plain instructions; the plain intrinsics of GCC 12 pass
// an uninitialised operand, which -Wmaybe-uninitialized reports.
inline constexpr int every_lane = -1;
inline constexpr int round_down = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;

template <>
struct Register<float, 16> : PlainRegister<float, 16> {
  using MaskVector = __mmask16;
  static constexpr bool mask_bits = true;
  static SCREE_FN MaskVector less(Vector a, Vector b) {
    return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_LT_OQ);
  }
  static SCREE_FN MaskVector less_equal(Vector a, Vector b) {
    return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_LE_OQ);
  }
  static SCREE_FN MaskVector equal(Vector a, Vector b) {
    return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_EQ_OQ);
  }
  static SCREE_FN bool any(MaskVector m) { return m != 0; }
  static SCREE_FN Vector select(MaskVector m, Vector a, Vector b) {
    return Vector(_mm512_mask_blend_ps(m, __m512(b), __m512(a)));
  }
  static SCREE_FN Vector min(Vector a, Vector b) {
    return Vector(_mm512_maskz_min_ps(every_lane, __m512(a), __m512(b)));
  }
  static SCREE_FN Vector max(Vector a, Vector b) {
    return Vector(_mm512_maskz_max_ps(every_lane, __m512(a), __m512(b)));
  }
  static SCREE_FN Vector floor(Vector a) {
    return Vector(_mm512_maskz_roundscale_ps(every_lane, __m512(a), round_down));
  }
  static SCREE_FN Vector sqrt(Vector a) {
    return Vector(_mm512_maskz_sqrt_ps(every_lane, __m512(a)));
  }
  static SCREE_FN Vector fma(Vector a, Vector b, Vector c) {
    return Vector(_mm512_fmadd_ps(__m512(a), __m512(b), __m512(c)));
  }
};

template <>
struct Register<double, 8> : PlainRegister<double, 8> {
  using MaskVector = __mmask8;
  static constexpr bool mask_bits = true;
  static SCREE_FN MaskVector less(Vector a, Vector b) {
    return _mm512_cmp_pd_mask(__m512d(a), __m512d(b), _CMP_LT_OQ);
  }
  static SCREE_FN MaskVector less_equal(Vector a, Vector b) {
    return _mm512_cmp_pd_mask(__m512d(a), __m512d(b), _CMP_LE_OQ);
  }
  static SCREE_FN MaskVector equal(Vector a, Vector b) {
    return _mm512_cmp_pd_mask(__m512d(a), __m512d(b), _CMP_EQ_OQ);
  }
  static SCREE_FN bool any(MaskVector m) { return m != 0; }
  static SCREE_FN Vector select(MaskVector m, Vector a, Vector b) {
    return Vector(_mm512_mask_blend_pd(m, __m512d(b), __m512d(a)));
  }
  static SCREE_FN Vector min(Vector a, Vector b) {
    return Vector(_mm512_maskz_min_pd(every_lane, __m512d(a), __m512d(b)));
  }
  static SCREE_FN Vector max(Vector a, Vector b) {
    return Vector(_mm512_maskz_max_pd(every_lane, __m512d(a), __m512d(b)));
  }
  static SCREE_FN Vector floor(Vector a) {
    return Vector(_mm512_maskz_roundscale_pd(every_lane, __m512d(a), round_down));
  }
  static SCREE_FN Vector sqrt(Vector a) {
    return Vector(_mm512_maskz_sqrt_pd(every_lane, __m512d(a)));
  }
  static SCREE_FN Vector fma(Vector a, Vector b, Vector c) {
    return Vector(_mm512_fmadd_pd(__m512d(a), __m512d(b), __m512d(c)));
  }
};

template <>
struct Register<std::int32_t, 16> : PlainRegister<std::int32_t, 16> {
  using MaskVector = __mmask16;
  static constexpr bool mask_bits = true;
  static SCREE_FN MaskVector less(Vector a, Vector b) {
    return _mm512_cmp_epi32_mask(__m512i(a), __m512i(b), _MM_CMPINT_LT);
  }
  static SCREE_FN MaskVector less_equal(Vector a, Vector b) {
    return _mm512_cmp_epi32_mask(__m512i(a), __m512i(b), _MM_CMPINT_LE);
  }
  static SCREE_FN MaskVector equal(Vector a, Vector b) {
    return _mm512_cmp_epi32_mask(__m512i(a), __m512i(b), _MM_CMPINT_EQ);
  }
  static SCREE_FN bool any(MaskVector m) { return m != 0; }
  static SCREE_FN Vector select(MaskVector m, Vector a, Vector b) {
    return Vector(_mm512_mask_blend_epi32(m, __m512i(b), __m512i(a)));
  }
};

template <>
struct Register<std::int64_t, 8> : PlainRegister<std::int64_t, 8> {
  using MaskVector = __mmask8;
  static constexpr bool mask_bits = true;
  static SCREE_FN MaskVector less(Vector a, Vector b) {
    return _mm512_cmp_epi64_mask(__m512i(a), __m512i(b), _MM_CMPINT_LT);
  }
  static SCREE_FN MaskVector less_equal(Vector a, Vector b) {
    return _mm512_cmp_epi64_mask(__m512i(a), __m512i(b), _MM_CMPINT_LE);
  }
  static SCREE_FN MaskVector equal(Vector a, Vector b) {
    return _mm512_cmp_epi64_mask(__m512i(a), __m512i(b), _MM_CMPINT_EQ);
  }
  static SCREE_FN bool any(MaskVector m) { return m != 0; }
  static SCREE_FN Vector select(MaskVector m, Vector a, Vector b) {
    return Vector(_mm512_mask_blend_epi64(m, __m512i(b), __m512i(a)));
  }
};

#else

/// No shift of 64-bit lanes keeps the sign before AVX-512: (a + 2^63) >> n - 2^63 >> n, unsigned.
template <int W>
struct Register<std::int64_t, W> : PlainRegister<std::int64_t, W> {
  using typename PlainRegister<std::int64_t, W>::Vector;
  static SCREE_FN Vector shift_right(Vector a, int n) {
    using Unsigned = typename VectorOf<std::uint64_t, W>::type;
    constexpr std::uint64_t sign = std::uint64_t(1) << 63;
    return Vector(((Unsigned(a) ^ sign) >> n) - (sign >> n));
  }
};

#endif

#ifdef __AVX2__

template <>
struct Register<float, 8> : PlainRegister<float, 8> {
  static SCREE_FN bool any(MaskVector m) { return _mm256_movemask_ps(__m256(m)) != 0; }
  static SCREE_FN Vector select(MaskVector m, Vector a, Vector b) {
    return Vector(_mm256_blendv_ps(__m256(b), __m256(a), __m256(m)));
  }
  static SCREE_FN Vector min(Vector a, Vector b) {
    return Vector(_mm256_min_ps(__m256(a), __m256(b)));
  }
  static SCREE_FN Vector max(Vector a, Vector b) {
    return Vector(_mm256_max_ps(__m256(a), __m256(b)));
  }
  static SCREE_FN Vector floor(Vector a) { return Vector(_mm256_floor_ps(__m256(a))); }
  static SCREE_FN Vector sqrt(Vector a) { return Vector(_mm256_sqrt_ps(__m256(a))); }
#ifdef __FMA__
  static SCREE_FN Vector fma(Vector a, Vector b, Vector c) {
    return Vector(_mm256_fmadd_ps(__m256(a), __m256(b), __m256(c)));
  }
#endif
};

template <>
struct Register<double, 4> : PlainRegister<double, 4> {
  static SCREE_FN bool any(MaskVector m) { return _mm256_movemask_pd(__m256d(m)) != 0; }
  static SCREE_FN Vector select(MaskVector m, Vector a, Vector b) {
    return Vector(_mm256_blendv_pd(__m256d(b), __m256d(a), __m256d(m)));
  }
  static SCREE_FN Vector min(Vector a, Vector b) {
    return Vector(_mm256_min_pd(__m256d(a), __m256d(b)));
  }
  static SCREE_FN Vector max(Vector a, Vector b) {
    return Vector(_mm256_max_pd(__m256d(a), __m256d(b)));
  }
  static SCREE_FN Vector floor(Vector a) { return Vector(_mm256_floor_pd(__m256d(a))); }
  static SCREE_FN Vector sqrt(Vector a) { return Vector(_mm256_sqrt_pd(__m256d(a))); }
  static SCREE_FN IntVector to_int(Vector a) {
    return IntVector(_mm256_cvtepi32_epi64(_mm256_cvttpd_epi32(__m256d(a))));
  }
#ifdef __FMA__
  static SCREE_FN Vector fma(Vector a, Vector b, Vector c) {
    return Vector(_mm256_fmadd_pd(__m256d(a), __m256d(b), __m256d(c)));
  }
#endif
};

#endif

template <>
struct Register<float, 4> : PlainRegister<float, 4> {
  static SCREE_FN bool any(MaskVector m) { return _mm_movemask_ps(__m128(m)) != 0; }
  static SCREE_FN Vector min(Vector a, Vector b) {
    return Vector(_mm_min_ps(__m128(a), __m128(b)));
  }
  static SCREE_FN Vector max(Vector a, Vector b) {
    return Vector(_mm_max_ps(__m128(a), __m128(b)));
  }
  static SCREE_FN Vector sqrt(Vector a) { return Vector(_mm_sqrt_ps(__m128(a))); }
#ifdef __SSE4_1__
  static SCREE_FN Vector floor(Vector a) { return Vector(_mm_floor_ps(__m128(a))); }
#endif
#ifdef __FMA__
  static SCREE_FN Vector fma(Vector a, Vector b, Vector c) {
    return Vector(_mm_fmadd_ps(__m128(a), __m128(b), __m128(c)));
  }
#endif
};

template <>
struct Register<double, 2> : PlainRegister<double, 2> {
  static SCREE_FN bool any(MaskVector m) { return _mm_movemask_pd(__m128d(m)) != 0; }
  static SCREE_FN Vector min(Vector a, Vector b) {
    return Vector(_mm_min_pd(__m128d(a), __m128d(b)));
  }
  static SCREE_FN Vector max(Vector a, Vector b) {
    return Vector(_mm_max_pd(__m128d(a), __m128d(b)));
  }
  static SCREE_FN Vector sqrt(Vector a) { return Vector(_mm_sqrt_pd(__m128d(a))); }
#ifdef __SSE4_1__
  static SCREE_FN Vector floor(Vector a) { return Vector(_mm_floor_pd(__m128d(a))); }
  static SCREE_FN IntVector to_int(Vector a) {
    return IntVector(_mm_cvtepi32_epi64(_mm_cvttpd_epi32(__m128d(a))));
  }
#endif
#ifdef __FMA__
  static SCREE_FN Vector fma(Vector a, Vector b, Vector c) {
    return Vector(_mm_fmadd_pd(__m128d(a), __m128d(b), __m128d(c)));
  }
#endif
};

}  // namespace scree::detail
#endif

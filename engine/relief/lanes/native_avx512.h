// 16 lanes on AVX-512: what native.h does not have. A mask is a 16-bit mask register.
#pragma once

// g++ 12 takes the intrinsics' deliberately undefined pass-through operands for a mistake of ours (its bug 105593).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include "relief/lanes/native.h"

namespace relief::inline RELIEF_WIDTH::native {

typedef __mmask16 MaskVector;

inline MaskVector less(FloatVector a, FloatVector b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
}
inline MaskVector lessEqual(FloatVector a, FloatVector b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ);
}
inline MaskVector equal(FloatVector a, FloatVector b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_EQ_OQ);
}
inline MaskVector less(IntVector a, IntVector b)
{
    return _mm512_cmplt_epi32_mask((__m512i)a, (__m512i)b);
}
inline MaskVector equal(IntVector a, IntVector b)
{
    return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b);
}
inline MaskVector maskAnd(MaskVector a, MaskVector b)
{
    return static_cast<MaskVector>(a & b);
}
inline MaskVector maskOr(MaskVector a, MaskVector b)
{
    return static_cast<MaskVector>(a | b);
}
inline MaskVector maskNot(MaskVector a)
{
    return static_cast<MaskVector>(~a);
}
inline unsigned maskBits(MaskVector a)
{
    return a;
}
inline MaskVector maskFromBits(unsigned bits)
{
    return static_cast<MaskVector>(bits);
}
inline FloatVector select(MaskVector m, FloatVector a, FloatVector b)
{
    return (FloatVector)_mm512_mask_blend_ps(m, (__m512)b, (__m512)a);
}
inline IntVector select(MaskVector m, IntVector a, IntVector b)
{
    return (IntVector)_mm512_mask_blend_epi32(m, (__m512i)b, (__m512i)a);
}
inline unsigned signBits(IntVector a)
{
    return _mm512_movepi32_mask((__m512i)a);
}

// The second operand where one of the two is NaN.
inline FloatVector min(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm512_min_ps((__m512)a, (__m512)b);
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm512_max_ps((__m512)a, (__m512)b);
}
// The larger of two numbers that are not negative, NaN where one of them is NaN: in the order of their bits NaN is the
// largest.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm512_max_epu32((__m512i)a, (__m512i)b);
}
inline IntVector min(IntVector a, IntVector b)
{
    return (IntVector)_mm512_min_epi32((__m512i)a, (__m512i)b);
}
inline IntVector max(IntVector a, IntVector b)
{
    return (IntVector)_mm512_max_epi32((__m512i)a, (__m512i)b);
}
inline FloatVector sqrt(FloatVector a)
{
    return (FloatVector)_mm512_sqrt_ps((__m512)a);
}
inline FloatVector floor(FloatVector a)
{
    return (FloatVector)_mm512_roundscale_ps((__m512)a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
inline IntVector roundToInt(FloatVector a)
{
    return (IntVector)_mm512_cvtps_epi32((__m512)a);
}

// Lane i of the result is lane from[i] of a, in 0..kLanes - 1.
inline FloatVector permute(FloatVector a, IntVector from)
{
    return (FloatVector)_mm512_permutexvar_ps((__m512i)from, (__m512)a);
}
inline IntVector permute(IntVector a, IntVector from)
{
    return (IntVector)_mm512_permutexvar_epi32((__m512i)from, (__m512i)a);
}

inline DoubleVector lowToDouble(IntVector a)
{
    return (DoubleVector)_mm512_cvtepi32_pd(_mm512_castsi512_si256((__m512i)a));
}
inline DoubleVector highToDouble(IntVector a)
{
    return (DoubleVector)_mm512_cvtepi32_pd(_mm512_extracti64x4_epi64((__m512i)a, 1));
}
inline FloatVector toFloat(DoubleVector low, DoubleVector high)
{
    const __m256 l = _mm512_cvtpd_ps((__m512d)low);
    const __m256 h = _mm512_cvtpd_ps((__m512d)high);
    return (FloatVector)_mm512_insertf32x8(_mm512_castps256_ps512(l), h, 1);
}
inline unsigned negativeBits(DoubleVector low, DoubleVector high)
{
    const __m512d zero = _mm512_setzero_pd();
    return static_cast<unsigned>(_mm512_cmp_pd_mask((__m512d)low, zero, _CMP_LT_OQ)) |
           static_cast<unsigned>(_mm512_cmp_pd_mask((__m512d)high, zero, _CMP_LT_OQ)) << 8;
}

// A quad's 128 bits put into their place among the four quads'; the first one's begin a new register.
template <int quad>
inline IntVector insertQuad(IntVector quads, QuadVector bits)
{
    if constexpr (quad == 0) {
        return (IntVector)_mm512_castsi128_si512((__m128i)bits);
    } else {
        return (IntVector)_mm512_inserti32x4((__m512i)quads, (__m128i)bits, quad);
    }
}
// Quad q to address(4 * q).
template <class Address>
inline void storeQuads(IntVector quads, const Address& address)
{
    const __m512i q = (__m512i)quads;
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address(0)), _mm512_castsi512_si128(q));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address(4)), _mm512_extracti32x4_epi32(q, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address(8)), _mm512_extracti32x4_epi32(q, 2));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address(12)), _mm512_extracti32x4_epi32(q, 3));
}
// 8 bytes from each.
inline QuadVector loadTwoHalves(const std::byte* low, const std::byte* high)
{
    const __m128i l = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(low));
    return (QuadVector)_mm_loadh_pi(_mm_castsi128_ps(l), reinterpret_cast<const __m64*>(high));
}

// In every lane the low halves' product plus the high halves', halves taken as signed 16-bit numbers.
inline IntVector multiplyAddHalves(IntVector a, IntVector b)
{
#if defined(__AVX512BW__)
    return (IntVector)_mm512_madd_epi16((__m512i)a, (__m512i)b);
#else
    return ((a << 16) >> 16) * ((b << 16) >> 16) + (a >> 16) * (b >> 16);
#endif
}

}  // namespace relief::inline RELIEF_WIDTH::native

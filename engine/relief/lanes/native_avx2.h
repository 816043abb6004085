// 8 lanes on AVX2: what native.h does not have.
#pragma once

#include <immintrin.h>

#include "relief/lanes/native.h"

namespace relief::inline RELIEF_WIDTH::native {

inline FloatVector select(MaskVector m, FloatVector a, FloatVector b)
{
    return (FloatVector)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)m);
}
inline IntVector select(MaskVector m, IntVector a, IntVector b)
{
    return (IntVector)_mm256_blendv_epi8((__m256i)b, (__m256i)a, (__m256i)m);
}
inline unsigned signBits(IntVector a)
{
    return static_cast<unsigned>(_mm256_movemask_ps((__m256)a));
}
inline unsigned maskBits(MaskVector a)
{
    return signBits(a);
}

// The second operand where one of the two is NaN.
inline FloatVector min(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm256_min_ps((__m256)a, (__m256)b);
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm256_max_ps((__m256)a, (__m256)b);
}
// The larger of two numbers that are not negative, NaN where one of them is NaN: in the order of their bits NaN is the
// largest.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm256_max_epu32((__m256i)a, (__m256i)b);
}
inline IntVector min(IntVector a, IntVector b)
{
    return (IntVector)_mm256_min_epi32((__m256i)a, (__m256i)b);
}
inline IntVector max(IntVector a, IntVector b)
{
    return (IntVector)_mm256_max_epi32((__m256i)a, (__m256i)b);
}
inline FloatVector sqrt(FloatVector a)
{
    return (FloatVector)_mm256_sqrt_ps((__m256)a);
}
inline FloatVector floor(FloatVector a)
{
    return (FloatVector)_mm256_floor_ps((__m256)a);
}
inline IntVector roundToInt(FloatVector a)
{
    return (IntVector)_mm256_cvtps_epi32((__m256)a);
}

// Lane i of the result is lane from[i] of a, in 0..kLanes - 1.
inline FloatVector permute(FloatVector a, IntVector from)
{
    return (FloatVector)_mm256_permutevar8x32_ps((__m256)a, (__m256i)from);
}
inline IntVector permute(IntVector a, IntVector from)
{
    return (IntVector)_mm256_permutevar8x32_epi32((__m256i)a, (__m256i)from);
}

inline DoubleVector lowToDouble(IntVector a)
{
    return (DoubleVector)_mm256_cvtepi32_pd(_mm256_castsi256_si128((__m256i)a));
}
inline DoubleVector highToDouble(IntVector a)
{
    return (DoubleVector)_mm256_cvtepi32_pd(_mm256_extracti128_si256((__m256i)a, 1));
}
inline FloatVector toFloat(DoubleVector low, DoubleVector high)
{
    return (FloatVector)_mm256_set_m128(_mm256_cvtpd_ps((__m256d)high), _mm256_cvtpd_ps((__m256d)low));
}
inline unsigned negativeBits(DoubleVector low, DoubleVector high)
{
    return static_cast<unsigned>(_mm256_movemask_pd((__m256d)(low < 0.0)) | _mm256_movemask_pd((__m256d)(high < 0.0))
                                                                                << 4);
}

// A quad's 128 bits put into their place of the two; the first one's begin a new register.
template <int quad>
inline IntVector insertQuad(IntVector quads, QuadVector bits)
{
    if constexpr (quad == 0) {
        return (IntVector)_mm256_castsi128_si256((__m128i)bits);
    } else {
        return (IntVector)_mm256_inserti128_si256((__m256i)quads, (__m128i)bits, quad);
    }
}
// Quad q to address(4 * q).
template <class Address>
inline void storeQuads(IntVector quads, const Address& address)
{
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address(0)), _mm256_castsi256_si128((__m256i)quads));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address(4)), _mm256_extracti128_si256((__m256i)quads, 1));
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
    return (IntVector)_mm256_madd_epi16((__m256i)a, (__m256i)b);
}

}  // namespace relief::inline RELIEF_WIDTH::native

// 4 lanes on plain x86-64 (SSE2): what native.h does not have.
#pragma once

#include <emmintrin.h>

#include <limits>

#include "relief/lanes/native.h"

namespace relief::inline RELIEF_WIDTH::native {

inline IntVector select(MaskVector m, IntVector a, IntVector b)
{
    return (a & m) | (b & ~m);
}
inline FloatVector select(MaskVector m, FloatVector a, FloatVector b)
{
    return (FloatVector)select(m, (IntVector)a, (IntVector)b);
}
inline unsigned signBits(IntVector a)
{
    return static_cast<unsigned>(_mm_movemask_ps((__m128)a));
}
inline unsigned maskBits(MaskVector a)
{
    return signBits(a);
}

// The second operand where one of the two is NaN.
inline FloatVector min(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm_min_ps((__m128)a, (__m128)b);
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm_max_ps((__m128)a, (__m128)b);
}
// The larger of two numbers that are not negative, NaN where one of them is NaN.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm_or_ps((__m128)max(a, b), _mm_cmpunord_ps((__m128)a, (__m128)b));
}
inline IntVector min(IntVector a, IntVector b)
{
    return select(less(a, b), a, b);
}
inline IntVector max(IntVector a, IntVector b)
{
    return select(less(b, a), a, b);
}
inline FloatVector sqrt(FloatVector a)
{
    return (FloatVector)_mm_sqrt_ps((__m128)a);
}
inline IntVector roundToInt(FloatVector a)
{
    return (IntVector)_mm_cvtps_epi32((__m128)a);
}
// SSE2 has no rounding instruction. What no integer holds (the conversion gives -2^31) is whole already, or NaN, and
// stays; the sign of zero is kept, as the instruction of the wider sets keeps it.
inline FloatVector floor(FloatVector a)
{
    constexpr std::int32_t lowest = std::numeric_limits<std::int32_t>::min();
    const IntVector whole = (IntVector)_mm_cvttps_epi32((__m128)a);
    const FloatVector truncated = toFloat(whole), one = FloatVector{} + 1.0f;
    const FloatVector floored = truncated - (FloatVector)((IntVector)one & less(a, truncated));
    const IntVector sign = (IntVector)a & lowest;  // of zero
    return select(equal(whole, IntVector{} + lowest), a, (FloatVector)((IntVector)floored | sign));
}

inline DoubleVector lowToDouble(IntVector a)
{
    return (DoubleVector)_mm_cvtepi32_pd((__m128i)a);
}
inline DoubleVector highToDouble(IntVector a)
{
    return (DoubleVector)_mm_cvtepi32_pd(_mm_shuffle_epi32((__m128i)a, 0x4e));
}
inline FloatVector toFloat(DoubleVector low, DoubleVector high)
{
    return (FloatVector)_mm_movelh_ps(_mm_cvtpd_ps((__m128d)low), _mm_cvtpd_ps((__m128d)high));
}
inline unsigned negativeBits(DoubleVector low, DoubleVector high)
{
    return static_cast<unsigned>(_mm_movemask_pd((__m128d)(low < 0.0)) | _mm_movemask_pd((__m128d)(high < 0.0)) << 2);
}

// There is one quad, and it is the whole vector.
template <int quad>
inline IntVector insertQuad(IntVector, QuadVector bits)
{
    return bits;
}
template <class Address>
inline void storeQuads(IntVector quads, const Address& address)
{
    std::memcpy(address(0), &quads, sizeof quads);
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
    return (IntVector)_mm_madd_epi16((__m128i)a, (__m128i)b);
}

}  // namespace relief::inline RELIEF_WIDTH::native

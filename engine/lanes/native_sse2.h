// 4 lanes on plain x86-64 (SSE2). A mask is a vector of 0 and -1.
#pragma once

#include <emmintrin.h>

#include <limits>

#include "lanes/native.h"

namespace relief::native {

typedef IntVector MaskVector;

inline __m128 wrap(FloatVector a)
{
    return (__m128)a;
}
inline __m128i wrap(IntVector a)
{
    return (__m128i)a;
}

inline MaskVector less(FloatVector a, FloatVector b)
{
    return (MaskVector)_mm_cmplt_ps(wrap(a), wrap(b));
}
inline MaskVector lessEqual(FloatVector a, FloatVector b)
{
    return (MaskVector)_mm_cmple_ps(wrap(a), wrap(b));
}
inline MaskVector equal(FloatVector a, FloatVector b)
{
    return (MaskVector)_mm_cmpeq_ps(wrap(a), wrap(b));
}
inline MaskVector less(IntVector a, IntVector b)
{
    return (MaskVector)_mm_cmplt_epi32(wrap(a), wrap(b));
}
inline MaskVector equal(IntVector a, IntVector b)
{
    return (MaskVector)_mm_cmpeq_epi32(wrap(a), wrap(b));
}

inline MaskVector maskAnd(MaskVector a, MaskVector b)
{
    return a & b;
}
inline MaskVector maskOr(MaskVector a, MaskVector b)
{
    return a | b;
}
inline MaskVector maskNot(MaskVector a)
{
    return ~a;
}
inline unsigned signBits(IntVector a)
{
    return static_cast<unsigned>(_mm_movemask_ps((__m128)a));
}
inline unsigned maskBits(MaskVector a)
{
    return signBits(a);
}
inline MaskVector maskFromBits(unsigned bits)
{
    const IntVector lane = {1, 2, 4, 8};
    return equal(lane & static_cast<std::int32_t>(bits), lane);
}

inline IntVector select(MaskVector m, IntVector a, IntVector b)
{
    return (a & m) | (b & ~m);
}
inline FloatVector select(MaskVector m, FloatVector a, FloatVector b)
{
    return (FloatVector)select(m, (IntVector)a, (IntVector)b);
}

inline FloatVector min(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm_min_ps(wrap(a), wrap(b));
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm_max_ps(wrap(a), wrap(b));
}
// The larger of two numbers that are not negative, NaN where one of them is NaN.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm_or_ps(_mm_max_ps(wrap(a), wrap(b)), _mm_cmpunord_ps(wrap(a), wrap(b)));
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
    return (FloatVector)_mm_sqrt_ps(wrap(a));
}
inline IntVector roundToInt(FloatVector a)
{
    return (IntVector)_mm_cvtps_epi32(wrap(a));
}
inline IntVector truncateToInt(FloatVector a)
{
    return (IntVector)_mm_cvttps_epi32(wrap(a));
}
inline FloatVector toFloat(IntVector a)
{
    return (FloatVector)_mm_cvtepi32_ps(wrap(a));
}

// SSE2 has no rounding instruction. What no integer holds (the conversion gives -2^31) is whole already, or NaN, and
// stays; the sign of zero is kept, as the instruction of the wider sets keeps it.
inline FloatVector floor(FloatVector a)
{
    constexpr std::int32_t lowest = std::numeric_limits<std::int32_t>::min();
    const IntVector whole = truncateToInt(a);
    const FloatVector truncated = toFloat(whole), one = FloatVector{} + 1.0f;
    const FloatVector floored = truncated - (FloatVector)((IntVector)one & less(a, truncated));
    const IntVector sign = (IntVector)a & lowest;  // of zero
    return select(equal(whole, IntVector{} + lowest), a, (FloatVector)((IntVector)floored | sign));
}

inline DoubleVector lowToDouble(IntVector a)
{
    return (DoubleVector)_mm_cvtepi32_pd(wrap(a));
}
inline DoubleVector highToDouble(IntVector a)
{
    return (DoubleVector)_mm_cvtepi32_pd(_mm_shuffle_epi32(wrap(a), 0x4e));
}
inline FloatVector toFloat(DoubleVector low, DoubleVector high)
{
    return (FloatVector)_mm_movelh_ps(_mm_cvtpd_ps((__m128d)low), _mm_cvtpd_ps((__m128d)high));
}
inline unsigned negativeBits(DoubleVector low, DoubleVector high)
{
    const __m128d zero = _mm_setzero_pd();
    return static_cast<unsigned>(_mm_movemask_pd(_mm_cmplt_pd((__m128d)low, zero)) |
                                 _mm_movemask_pd(_mm_cmplt_pd((__m128d)high, zero)) << 2);
}

// Rearranges every quad: lane k of the quad becomes its lane a<k>.
template <int a0, int a1, int a2, int a3>
inline FloatVector permuteQuad(FloatVector a)
{
    return (FloatVector)_mm_shuffle_ps(wrap(a), wrap(a), a0 | a1 << 2 | a2 << 4 | a3 << 6);
}

inline __m128i loadTwoHalves(const std::byte* low, const std::byte* high)
{
    const __m128i l = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(low));
    return _mm_castps_si128(_mm_loadh_pi(_mm_castsi128_ps(l), reinterpret_cast<const __m64*>(high)));
}

// Gathers 16 bytes per lane, quad after quad (here there is one), and gives word k of every lane.
class FourWords
{
public:
    template <int quad>
    void add(const std::byte* a, const std::byte* b, const std::byte* c, const std::byte* d)
    {
        r0 = _mm_loadu_si128(reinterpret_cast<const __m128i*>(a));
        r1 = _mm_loadu_si128(reinterpret_cast<const __m128i*>(b));
        r2 = _mm_loadu_si128(reinterpret_cast<const __m128i*>(c));
        r3 = _mm_loadu_si128(reinterpret_cast<const __m128i*>(d));
    }

    void transposed(IntVector out[4]) const
    {
        const __m128i t0 = _mm_unpacklo_epi32(r0, r1), t1 = _mm_unpacklo_epi32(r2, r3);
        const __m128i t2 = _mm_unpackhi_epi32(r0, r1), t3 = _mm_unpackhi_epi32(r2, r3);
        out[0] = (IntVector)_mm_unpacklo_epi64(t0, t1);
        out[1] = (IntVector)_mm_unpackhi_epi64(t0, t1);
        out[2] = (IntVector)_mm_unpacklo_epi64(t2, t3);
        out[3] = (IntVector)_mm_unpackhi_epi64(t2, t3);
    }

private:
    __m128i r0 = {}, r1 = {}, r2 = {}, r3 = {};
};

// The same for 8 bytes per lane.
class TwoWords
{
public:
    template <int quad>
    void add(const std::byte* a, const std::byte* b, const std::byte* c, const std::byte* d)
    {
        r0 = loadTwoHalves(a, b);
        r1 = loadTwoHalves(c, d);
    }

    void transposed(IntVector out[2]) const
    {
        out[0] = (IntVector)_mm_shuffle_ps(_mm_castsi128_ps(r0), _mm_castsi128_ps(r1), 0x88);
        out[1] = (IntVector)_mm_shuffle_ps(_mm_castsi128_ps(r0), _mm_castsi128_ps(r1), 0xdd);
    }

private:
    __m128i r0 = {}, r1 = {};
};

// The inverse of loadTransposed: the k-th 32-bit word at address[i] = in[k] lane i; 16 bytes are written per lane.
inline void storeTransposed(const IntVector in[4], std::byte* const address[4])
{
    const __m128i t0 = _mm_unpacklo_epi32(wrap(in[0]), wrap(in[1]));
    const __m128i t1 = _mm_unpacklo_epi32(wrap(in[2]), wrap(in[3]));
    const __m128i t2 = _mm_unpackhi_epi32(wrap(in[0]), wrap(in[1]));
    const __m128i t3 = _mm_unpackhi_epi32(wrap(in[2]), wrap(in[3]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address[0]), _mm_unpacklo_epi64(t0, t1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address[1]), _mm_unpackhi_epi64(t0, t1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address[2]), _mm_unpacklo_epi64(t2, t3));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(address[3]), _mm_unpackhi_epi64(t2, t3));
}

// In every lane the low halves' product plus the high halves', halves taken as signed 16-bit numbers.
inline IntVector multiplyAddHalves(IntVector a, IntVector b)
{
    return (IntVector)_mm_madd_epi16(wrap(a), wrap(b));
}

}  // namespace relief::native

// 8 lanes on AVX2. A mask is a vector of 0 and -1.
#pragma once

#include <immintrin.h>

#include "lanes/native.h"

namespace relief::native {

typedef IntVector MaskVector;

inline __m256 wrap(FloatVector a)
{
    return (__m256)a;
}
inline __m256i wrap(IntVector a)
{
    return (__m256i)a;
}

inline MaskVector less(FloatVector a, FloatVector b)
{
    return (MaskVector)_mm256_cmp_ps(wrap(a), wrap(b), _CMP_LT_OQ);
}
inline MaskVector lessEqual(FloatVector a, FloatVector b)
{
    return (MaskVector)_mm256_cmp_ps(wrap(a), wrap(b), _CMP_LE_OQ);
}
inline MaskVector equal(FloatVector a, FloatVector b)
{
    return (MaskVector)_mm256_cmp_ps(wrap(a), wrap(b), _CMP_EQ_OQ);
}
inline MaskVector less(IntVector a, IntVector b)
{
    return (MaskVector)_mm256_cmpgt_epi32(wrap(b), wrap(a));
}
inline MaskVector equal(IntVector a, IntVector b)
{
    return (MaskVector)_mm256_cmpeq_epi32(wrap(a), wrap(b));
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
    return static_cast<unsigned>(_mm256_movemask_ps((__m256)a));
}
inline unsigned maskBits(MaskVector a)
{
    return signBits(a);
}
inline MaskVector maskFromBits(unsigned bits)
{
    const IntVector lane = {1, 2, 4, 8, 16, 32, 64, 128};
    return equal(lane & static_cast<std::int32_t>(bits), lane);
}

inline FloatVector select(MaskVector m, FloatVector a, FloatVector b)
{
    return (FloatVector)_mm256_blendv_ps(wrap(b), wrap(a), (__m256)m);
}
inline IntVector select(MaskVector m, IntVector a, IntVector b)
{
    return (IntVector)_mm256_blendv_epi8(wrap(b), wrap(a), wrap(m));
}

inline FloatVector min(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm256_min_ps(wrap(a), wrap(b));
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm256_max_ps(wrap(a), wrap(b));
}
// The larger of two numbers that are not negative, NaN where one of them is NaN: in the order of their bits NaN is the
// largest.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm256_max_epu32((__m256i)a, (__m256i)b);
}
inline IntVector min(IntVector a, IntVector b)
{
    return (IntVector)_mm256_min_epi32(wrap(a), wrap(b));
}
inline IntVector max(IntVector a, IntVector b)
{
    return (IntVector)_mm256_max_epi32(wrap(a), wrap(b));
}
inline FloatVector sqrt(FloatVector a)
{
    return (FloatVector)_mm256_sqrt_ps(wrap(a));
}
inline FloatVector floor(FloatVector a)
{
    return (FloatVector)_mm256_floor_ps(wrap(a));
}
inline IntVector roundToInt(FloatVector a)
{
    return (IntVector)_mm256_cvtps_epi32(wrap(a));
}
inline IntVector truncateToInt(FloatVector a)
{
    return (IntVector)_mm256_cvttps_epi32(wrap(a));
}
inline FloatVector toFloat(IntVector a)
{
    return (FloatVector)_mm256_cvtepi32_ps(wrap(a));
}

inline DoubleVector lowToDouble(IntVector a)
{
    return (DoubleVector)_mm256_cvtepi32_pd(_mm256_castsi256_si128(wrap(a)));
}
inline DoubleVector highToDouble(IntVector a)
{
    return (DoubleVector)_mm256_cvtepi32_pd(_mm256_extracti128_si256(wrap(a), 1));
}
inline FloatVector toFloat(DoubleVector low, DoubleVector high)
{
    return (FloatVector)_mm256_set_m128(_mm256_cvtpd_ps((__m256d)high), _mm256_cvtpd_ps((__m256d)low));
}
inline unsigned negativeBits(DoubleVector low, DoubleVector high)
{
    const __m256d zero = _mm256_setzero_pd();
    return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd((__m256d)low, zero, _CMP_LT_OQ)) |
                                 _mm256_movemask_pd(_mm256_cmp_pd((__m256d)high, zero, _CMP_LT_OQ)) << 4);
}

// Rearranges every quad: lane k of the quad becomes its lane a<k>.
template <int a0, int a1, int a2, int a3>
inline FloatVector permuteQuad(FloatVector a)
{
    return (FloatVector)_mm256_permute_ps(wrap(a), a0 | a1 << 2 | a2 << 4 | a3 << 6);
}

inline __m128i loadSixteen(const std::byte* address)
{
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(address));
}

inline void storeTwo(__m256i r, std::byte* low, std::byte* high)
{
    _mm_storeu_si128(reinterpret_cast<__m128i*>(low), _mm256_castsi256_si128(r));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(high), _mm256_extracti128_si256(r, 1));
}

// The inverse of loadTransposed: the k-th 32-bit word at address[i] = in[k] lane i; 16 bytes are written per lane.
inline void storeTransposed(const IntVector in[4], std::byte* const address[8])
{
    const __m256i t0 = _mm256_unpacklo_epi32(wrap(in[0]), wrap(in[1]));
    const __m256i t1 = _mm256_unpacklo_epi32(wrap(in[2]), wrap(in[3]));
    const __m256i t2 = _mm256_unpackhi_epi32(wrap(in[0]), wrap(in[1]));
    const __m256i t3 = _mm256_unpackhi_epi32(wrap(in[2]), wrap(in[3]));
    storeTwo(_mm256_unpacklo_epi64(t0, t1), address[0], address[4]);
    storeTwo(_mm256_unpackhi_epi64(t0, t1), address[1], address[5]);
    storeTwo(_mm256_unpacklo_epi64(t2, t3), address[2], address[6]);
    storeTwo(_mm256_unpackhi_epi64(t2, t3), address[3], address[7]);
}

inline __m128i loadTwoHalves(const std::byte* low, const std::byte* high)
{
    const __m128i l = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(low));
    return _mm_castps_si128(_mm_loadh_pi(_mm_castsi128_ps(l), reinterpret_cast<const __m64*>(high)));
}

// A quad's 128 bits put into their place of the two; the first one's begin a new register.
template <int quad>
inline __m256i insertQuad(__m256i quads, __m128i bits)
{
    if constexpr (quad == 0) {
        return _mm256_castsi128_si256(bits);
    } else {
        return _mm256_inserti128_si256(quads, bits, quad);
    }
}

// Gathers 16 bytes per lane, quad after quad, and gives word k of every lane.
class FourWords
{
public:
    template <int quad>
    void add(const std::byte* a, const std::byte* b, const std::byte* c, const std::byte* d)
    {
        r0 = insertQuad<quad>(r0, loadSixteen(a));
        r1 = insertQuad<quad>(r1, loadSixteen(b));
        r2 = insertQuad<quad>(r2, loadSixteen(c));
        r3 = insertQuad<quad>(r3, loadSixteen(d));
    }

    void transposed(IntVector out[4]) const
    {
        const __m256i t0 = _mm256_unpacklo_epi32(r0, r1), t1 = _mm256_unpacklo_epi32(r2, r3);
        const __m256i t2 = _mm256_unpackhi_epi32(r0, r1), t3 = _mm256_unpackhi_epi32(r2, r3);
        out[0] = (IntVector)_mm256_unpacklo_epi64(t0, t1);
        out[1] = (IntVector)_mm256_unpackhi_epi64(t0, t1);
        out[2] = (IntVector)_mm256_unpacklo_epi64(t2, t3);
        out[3] = (IntVector)_mm256_unpackhi_epi64(t2, t3);
    }

private:
    __m256i r0 = {}, r1 = {}, r2 = {}, r3 = {};
};

// The same for 8 bytes per lane.
class TwoWords
{
public:
    template <int quad>
    void add(const std::byte* a, const std::byte* b, const std::byte* c, const std::byte* d)
    {
        r0 = insertQuad<quad>(r0, loadTwoHalves(a, b));
        r1 = insertQuad<quad>(r1, loadTwoHalves(c, d));
    }

    void transposed(IntVector out[2]) const
    {
        out[0] = (IntVector)_mm256_shuffle_ps(_mm256_castsi256_ps(r0), _mm256_castsi256_ps(r1), 0x88);
        out[1] = (IntVector)_mm256_shuffle_ps(_mm256_castsi256_ps(r0), _mm256_castsi256_ps(r1), 0xdd);
    }

private:
    __m256i r0 = {}, r1 = {};
};

// In every lane the low halves' product plus the high halves', halves taken as signed 16-bit numbers.
inline IntVector multiplyAddHalves(IntVector a, IntVector b)
{
    return (IntVector)_mm256_madd_epi16(wrap(a), wrap(b));
}

}  // namespace relief::native

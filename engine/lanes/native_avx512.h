// 16 lanes on AVX-512. A mask is a 16-bit mask register.
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

#include "lanes/native.h"

namespace relief::native {

typedef __mmask16 MaskVector;

inline __m512 wrap(FloatVector a)
{
    return (__m512)a;
}
inline __m512i wrap(IntVector a)
{
    return (__m512i)a;
}

inline MaskVector less(FloatVector a, FloatVector b)
{
    return _mm512_cmp_ps_mask(wrap(a), wrap(b), _CMP_LT_OQ);
}
inline MaskVector lessEqual(FloatVector a, FloatVector b)
{
    return _mm512_cmp_ps_mask(wrap(a), wrap(b), _CMP_LE_OQ);
}
inline MaskVector equal(FloatVector a, FloatVector b)
{
    return _mm512_cmp_ps_mask(wrap(a), wrap(b), _CMP_EQ_OQ);
}
inline MaskVector less(IntVector a, IntVector b)
{
    return _mm512_cmplt_epi32_mask(wrap(a), wrap(b));
}
inline MaskVector equal(IntVector a, IntVector b)
{
    return _mm512_cmpeq_epi32_mask(wrap(a), wrap(b));
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
    return (FloatVector)_mm512_mask_blend_ps(m, wrap(b), wrap(a));
}
inline IntVector select(MaskVector m, IntVector a, IntVector b)
{
    return (IntVector)_mm512_mask_blend_epi32(m, wrap(b), wrap(a));
}

inline unsigned signBits(IntVector a)
{
    return _mm512_movepi32_mask(wrap(a));
}
inline FloatVector min(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm512_min_ps(wrap(a), wrap(b));
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm512_max_ps(wrap(a), wrap(b));
}
// The larger of two numbers that are not negative, NaN where one of them is NaN: in the order of their bits NaN is the
// largest.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return (FloatVector)_mm512_max_epu32((__m512i)a, (__m512i)b);
}
inline IntVector min(IntVector a, IntVector b)
{
    return (IntVector)_mm512_min_epi32(wrap(a), wrap(b));
}
inline IntVector max(IntVector a, IntVector b)
{
    return (IntVector)_mm512_max_epi32(wrap(a), wrap(b));
}
inline FloatVector sqrt(FloatVector a)
{
    return (FloatVector)_mm512_sqrt_ps(wrap(a));
}
inline FloatVector floor(FloatVector a)
{
    return (FloatVector)_mm512_roundscale_ps(wrap(a), _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
inline IntVector roundToInt(FloatVector a)
{
    return (IntVector)_mm512_cvtps_epi32(wrap(a));
}
inline IntVector truncateToInt(FloatVector a)
{
    return (IntVector)_mm512_cvttps_epi32(wrap(a));
}
inline FloatVector toFloat(IntVector a)
{
    return (FloatVector)_mm512_cvtepi32_ps(wrap(a));
}

inline DoubleVector lowToDouble(IntVector a)
{
    return (DoubleVector)_mm512_cvtepi32_pd(_mm512_castsi512_si256(wrap(a)));
}
inline DoubleVector highToDouble(IntVector a)
{
    return (DoubleVector)_mm512_cvtepi32_pd(_mm512_extracti64x4_epi64(wrap(a), 1));
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

// Rearranges every quad: lane k of the quad becomes its lane a<k>.
template <int a0, int a1, int a2, int a3>
inline FloatVector permuteQuad(FloatVector a)
{
    return (FloatVector)_mm512_permute_ps(wrap(a), a0 | a1 << 2 | a2 << 4 | a3 << 6);
}

inline __m128i loadSixteen(const std::byte* address)
{
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(address));
}

inline void storeFour(__m512i r, std::byte* a, std::byte* b, std::byte* c, std::byte* d)
{
    _mm_storeu_si128(reinterpret_cast<__m128i*>(a), _mm512_castsi512_si128(r));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(b), _mm512_extracti32x4_epi32(r, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(c), _mm512_extracti32x4_epi32(r, 2));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(d), _mm512_extracti32x4_epi32(r, 3));
}

// The inverse of loadTransposed: the k-th 32-bit word at address[i] = in[k] lane i; 16 bytes are written per lane.
inline void storeTransposed(const IntVector in[4], std::byte* const address[16])
{
    const __m512i t0 = _mm512_unpacklo_epi32(wrap(in[0]), wrap(in[1]));
    const __m512i t1 = _mm512_unpacklo_epi32(wrap(in[2]), wrap(in[3]));
    const __m512i t2 = _mm512_unpackhi_epi32(wrap(in[0]), wrap(in[1]));
    const __m512i t3 = _mm512_unpackhi_epi32(wrap(in[2]), wrap(in[3]));
    storeFour(_mm512_unpacklo_epi64(t0, t1), address[0], address[4], address[8], address[12]);
    storeFour(_mm512_unpackhi_epi64(t0, t1), address[1], address[5], address[9], address[13]);
    storeFour(_mm512_unpacklo_epi64(t2, t3), address[2], address[6], address[10], address[14]);
    storeFour(_mm512_unpackhi_epi64(t2, t3), address[3], address[7], address[11], address[15]);
}

inline __m128i loadTwoHalves(const std::byte* low, const std::byte* high)
{
    const __m128i l = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(low));
    return _mm_castps_si128(_mm_loadh_pi(_mm_castsi128_ps(l), reinterpret_cast<const __m64*>(high)));
}

// A quad's 128 bits put into their place among the four quads'; the first one's begin a new register.
template <int quad>
inline __m512i insertQuad(__m512i quads, __m128i bits)
{
    if constexpr (quad == 0) {
        return _mm512_castsi128_si512(bits);
    } else {
        return _mm512_inserti32x4(quads, bits, quad);
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
        const __m512i t0 = _mm512_unpacklo_epi32(r0, r1), t1 = _mm512_unpacklo_epi32(r2, r3);
        const __m512i t2 = _mm512_unpackhi_epi32(r0, r1), t3 = _mm512_unpackhi_epi32(r2, r3);
        out[0] = (IntVector)_mm512_unpacklo_epi64(t0, t1);
        out[1] = (IntVector)_mm512_unpackhi_epi64(t0, t1);
        out[2] = (IntVector)_mm512_unpacklo_epi64(t2, t3);
        out[3] = (IntVector)_mm512_unpackhi_epi64(t2, t3);
    }

private:
    __m512i r0 = {}, r1 = {}, r2 = {}, r3 = {};
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
        out[0] = (IntVector)_mm512_shuffle_ps(_mm512_castsi512_ps(r0), _mm512_castsi512_ps(r1), 0x88);
        out[1] = (IntVector)_mm512_shuffle_ps(_mm512_castsi512_ps(r0), _mm512_castsi512_ps(r1), 0xdd);
    }

private:
    __m512i r0 = {}, r1 = {};
};

// In every lane the low halves' product plus the high halves', halves taken as signed 16-bit numbers.
inline IntVector multiplyAddHalves(IntVector a, IntVector b)
{
#if defined(__AVX512BW__)
    return (IntVector)_mm512_madd_epi16(wrap(a), wrap(b));
#else
    return ((a << 16) >> 16) * ((b << 16) >> 16) + (a >> 16) * (b >> 16);
#endif
}

}  // namespace relief::native

// 4 lanes for every other target (aarch64, wasm32, ...): plain loops, which compilers turn into vector code, and the
// reference to read. A mask is a vector of 0 and -1.
#pragma once

#include <cmath>

#include "lanes/native.h"

namespace relief::native {

typedef IntVector MaskVector;

inline MaskVector less(FloatVector a, FloatVector b)
{
    return (MaskVector)(a < b);
}
inline MaskVector lessEqual(FloatVector a, FloatVector b)
{
    return (MaskVector)(a <= b);
}
inline MaskVector equal(FloatVector a, FloatVector b)
{
    return (MaskVector)(a == b);
}
inline MaskVector less(IntVector a, IntVector b)
{
    return (MaskVector)(a < b);
}
inline MaskVector equal(IntVector a, IntVector b)
{
    return (MaskVector)(a == b);
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
    unsigned bits = 0;
    for (int i = 0; i < kLanes; ++i) bits |= (a[i] < 0 ? 1u : 0u) << i;
    return bits;
}
inline unsigned maskBits(MaskVector a)
{
    return signBits(a);
}
inline MaskVector maskFromBits(unsigned bits)
{
    MaskVector m;
    for (int i = 0; i < kLanes; ++i) m[i] = (bits >> i & 1u) != 0 ? -1 : 0;
    return m;
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
    return select(less(a, b), a, b);
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return select(less(b, a), a, b);
}
// The larger of two numbers that are not negative, NaN where one of them is NaN.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return select(equal(a, a), max(a, b), a);
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
    for (int i = 0; i < kLanes; ++i) a[i] = std::sqrt(a[i]);
    return a;
}
inline FloatVector floor(FloatVector a)
{
    for (int i = 0; i < kLanes; ++i) a[i] = std::floor(a[i]);
    return a;
}
inline IntVector roundToInt(FloatVector a)
{
    IntVector r;
    for (int i = 0; i < kLanes; ++i) r[i] = static_cast<std::int32_t>(std::nearbyint(a[i]));
    return r;
}
inline IntVector truncateToInt(FloatVector a)
{
    IntVector r;
    for (int i = 0; i < kLanes; ++i) r[i] = static_cast<std::int32_t>(a[i]);
    return r;
}
inline FloatVector toFloat(IntVector a)
{
    return __builtin_convertvector(a, FloatVector);
}

inline DoubleVector lowToDouble(IntVector a)
{
    return DoubleVector{double(a[0]), double(a[1])};
}
inline DoubleVector highToDouble(IntVector a)
{
    return DoubleVector{double(a[2]), double(a[3])};
}
inline FloatVector toFloat(DoubleVector low, DoubleVector high)
{
    return FloatVector{float(low[0]), float(low[1]), float(high[0]), float(high[1])};
}
inline unsigned negativeBits(DoubleVector low, DoubleVector high)
{
    return (low[0] < 0 ? 1u : 0u) | (low[1] < 0 ? 2u : 0u) | (high[0] < 0 ? 4u : 0u) | (high[1] < 0 ? 8u : 0u);
}

// Rearranges every quad: lane k of the quad becomes its lane a<k>.
template <int a0, int a1, int a2, int a3>
inline FloatVector permuteQuad(FloatVector a)
{
    return FloatVector{a[a0], a[a1], a[a2], a[a3]};
}

// Gathers 16 bytes per lane, quad after quad (here there is one), and gives word k of every lane.
class FourWords
{
public:
    template <int quad>
    void add(const std::byte* a, const std::byte* b, const std::byte* c, const std::byte* d)
    {
        const std::byte* const address[4] = {a, b, c, d};
        for (int i = 0; i < 4; ++i) std::memcpy(word[i], address[i], sizeof word[i]);
    }

    void transposed(IntVector out[4]) const
    {
        for (int k = 0; k < 4; ++k) out[k] = IntVector{word[0][k], word[1][k], word[2][k], word[3][k]};
    }

private:
    std::int32_t word[4][4];
};

// The same for 8 bytes per lane.
class TwoWords
{
public:
    template <int quad>
    void add(const std::byte* a, const std::byte* b, const std::byte* c, const std::byte* d)
    {
        const std::byte* const address[4] = {a, b, c, d};
        for (int i = 0; i < 4; ++i) std::memcpy(word[i], address[i], sizeof word[i]);
    }

    void transposed(IntVector out[2]) const
    {
        for (int k = 0; k < 2; ++k) out[k] = IntVector{word[0][k], word[1][k], word[2][k], word[3][k]};
    }

private:
    std::int32_t word[4][2];
};

// The inverse of loadTransposed: the k-th 32-bit word at address[i] = in[k] lane i; 16 bytes are written per lane.
inline void storeTransposed(const IntVector in[4], std::byte* const address[4])
{
    for (int i = 0; i < 4; ++i) {
        const std::int32_t word[4] = {in[0][i], in[1][i], in[2][i], in[3][i]};
        std::memcpy(address[i], word, 16);
    }
}

// In every lane the low halves' product plus the high halves', halves taken as signed 16-bit numbers.
inline IntVector multiplyAddHalves(IntVector a, IntVector b)
{
    return ((a << 16) >> 16) * ((b << 16) >> 16) + (a >> 16) * (b >> 16);
}

}  // namespace relief::native

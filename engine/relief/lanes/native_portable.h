// 4 lanes for every other target (riscv64, s390x, ...): what native.h does not have, as plain loops, which compilers
// turn into vector code, and the reference to read.
#pragma once

#include <cmath>

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
    unsigned bits = 0;
    for (int i = 0; i < kLanes; ++i) bits |= (a[i] < 0 ? 1u : 0u) << i;
    return bits;
}
inline unsigned maskBits(MaskVector a)
{
    return signBits(a);
}

// The second operand where one of the two is NaN.
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
    std::int32_t word[4];
    std::memcpy(word, low, 8);
    std::memcpy(word + 2, high, 8);
    return QuadVector{word[0], word[1], word[2], word[3]};
}

// In every lane the low halves' product plus the high halves', halves taken as signed 16-bit numbers.
inline IntVector multiplyAddHalves(IntVector a, IntVector b)
{
    return ((a << 16) >> 16) * ((b << 16) >> 16) + (a >> 16) * (b >> 16);
}

}  // namespace relief::inline RELIEF_WIDTH::native

// 4 lanes on WebAssembly's 128-bit vectors (-msimd128): what native.h does not have.
#pragma once

#include <wasm_simd128.h>

#include "relief/lanes/native.h"

namespace relief::inline RELIEF_WIDTH::native {

// The plain conversion is four scalar ones with clang 14.
inline IntVector truncateToInt(FloatVector a)
{
    return (IntVector)wasm_i32x4_trunc_sat_f32x4((v128_t)a);
}

inline IntVector select(MaskVector m, IntVector a, IntVector b)
{
    return (IntVector)wasm_v128_bitselect((v128_t)a, (v128_t)b, (v128_t)m);
}
inline FloatVector select(MaskVector m, FloatVector a, FloatVector b)
{
    return (FloatVector)select(m, (IntVector)a, (IntVector)b);
}
inline unsigned signBits(IntVector a)
{
    return static_cast<unsigned>(wasm_i32x4_bitmask((v128_t)a));
}
inline unsigned maskBits(MaskVector a)
{
    return signBits(a);
}

// The second operand where one of the two is NaN: pmin(x, y) is y < x ? y : x.
inline FloatVector min(FloatVector a, FloatVector b)
{
    return (FloatVector)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return (FloatVector)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}
// The larger of two numbers that are not negative (nor -0), NaN where one of them is NaN: in the order of their bits
// NaN is the largest.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return (FloatVector)wasm_u32x4_max((v128_t)a, (v128_t)b);
}
inline IntVector min(IntVector a, IntVector b)
{
    return (IntVector)wasm_i32x4_min((v128_t)a, (v128_t)b);
}
inline IntVector max(IntVector a, IntVector b)
{
    return (IntVector)wasm_i32x4_max((v128_t)a, (v128_t)b);
}
inline FloatVector sqrt(FloatVector a)
{
    return (FloatVector)wasm_f32x4_sqrt((v128_t)a);
}
inline FloatVector floor(FloatVector a)
{
    return (FloatVector)wasm_f32x4_floor((v128_t)a);
}
inline IntVector roundToInt(FloatVector a)
{
    return (IntVector)wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_nearest((v128_t)a));
}

inline DoubleVector lowToDouble(IntVector a)
{
    return (DoubleVector)wasm_f64x2_convert_low_i32x4((v128_t)a);
}
inline DoubleVector highToDouble(IntVector a)
{
    return (DoubleVector)wasm_f64x2_convert_low_i32x4((v128_t)shuffle<2, 3, 2, 3>(a, a));
}
inline FloatVector toFloat(DoubleVector low, DoubleVector high)
{
    return shuffle<0, 1, 4, 5>((FloatVector)wasm_f32x4_demote_f64x2_zero((v128_t)low),
                               (FloatVector)wasm_f32x4_demote_f64x2_zero((v128_t)high));
}
inline unsigned negativeBits(DoubleVector low, DoubleVector high)
{
    const IntVector l = (IntVector)(low < 0.0), h = (IntVector)(high < 0.0);
    return signBits(shuffle<0, 2, 4, 6>(l, h));
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
    return (QuadVector)wasm_v128_load64_lane(high, wasm_v128_load64_zero(low), 1);
}

// In every lane the low halves' product plus the high halves', halves taken as signed 16-bit numbers.
inline IntVector multiplyAddHalves(IntVector a, IntVector b)
{
    return (IntVector)wasm_i32x4_dot_i16x8((v128_t)a, (v128_t)b);
}

}  // namespace relief::inline RELIEF_WIDTH::native

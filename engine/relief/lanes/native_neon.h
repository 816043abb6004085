// 4 lanes on aarch64 (NEON): what native.h does not have.
#pragma once

#include <arm_neon.h>

#include "relief/lanes/native.h"

namespace relief::inline RELIEF_WIDTH::native {

inline IntVector select(MaskVector m, IntVector a, IntVector b)
{
    return (IntVector)vbslq_s32((uint32x4_t)m, (int32x4_t)a, (int32x4_t)b);
}
inline FloatVector select(MaskVector m, FloatVector a, FloatVector b)
{
    return (FloatVector)select(m, (IntVector)a, (IntVector)b);
}
// NEON has no instruction that gathers signs: a sum of the lanes' places does.
inline unsigned maskBits(MaskVector a)
{
    return vaddvq_u32((uint32x4_t)(a & IntVector{1, 2, 4, 8}));
}
inline unsigned signBits(IntVector a)
{
    return maskBits(a >> 31);
}

// The second operand where one of the two is NaN. (NEON's own minimum gives NaN.)
inline FloatVector min(FloatVector a, FloatVector b)
{
    return select(less(a, b), a, b);
}
inline FloatVector max(FloatVector a, FloatVector b)
{
    return select(less(b, a), a, b);
}
// The larger of two numbers that are not negative (nor -0), NaN where one of them is NaN: in the order of their bits
// NaN is the largest.
inline FloatVector maxOrNaN(FloatVector a, FloatVector b)
{
    return (FloatVector)vmaxq_u32((uint32x4_t)a, (uint32x4_t)b);
}
inline IntVector min(IntVector a, IntVector b)
{
    return (IntVector)vminq_s32((int32x4_t)a, (int32x4_t)b);
}
inline IntVector max(IntVector a, IntVector b)
{
    return (IntVector)vmaxq_s32((int32x4_t)a, (int32x4_t)b);
}
inline FloatVector sqrt(FloatVector a)
{
    return (FloatVector)vsqrtq_f32((float32x4_t)a);
}
inline FloatVector floor(FloatVector a)
{
    return (FloatVector)vrndmq_f32((float32x4_t)a);
}
inline IntVector roundToInt(FloatVector a)
{
    return (IntVector)vcvtnq_s32_f32((float32x4_t)a);
}

inline DoubleVector lowToDouble(IntVector a)
{
    return (DoubleVector)vcvtq_f64_s64(vmovl_s32(vget_low_s32((int32x4_t)a)));
}
inline DoubleVector highToDouble(IntVector a)
{
    return (DoubleVector)vcvtq_f64_s64(vmovl_high_s32((int32x4_t)a));
}
inline FloatVector toFloat(DoubleVector low, DoubleVector high)
{
    return (FloatVector)vcvt_high_f32_f64(vcvt_f32_f64((float64x2_t)low), (float64x2_t)high);
}
inline unsigned negativeBits(DoubleVector low, DoubleVector high)
{
    return maskBits((MaskVector)vuzp1q_s32((int32x4_t)(low < 0.0), (int32x4_t)(high < 0.0)));
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
    return (QuadVector)vcombine_u8(vld1_u8(reinterpret_cast<const std::uint8_t*>(low)),
                                   vld1_u8(reinterpret_cast<const std::uint8_t*>(high)));
}

// In every lane the low halves' product plus the high halves', halves taken as signed 16-bit numbers.
inline IntVector multiplyAddHalves(IntVector a, IntVector b)
{
    const int16x8_t x = (int16x8_t)a, y = (int16x8_t)b;
    return (IntVector)vpaddq_s32(vmull_s16(vget_low_s16(x), vget_low_s16(y)), vmull_high_s16(x, y));
}

}  // namespace relief::inline RELIEF_WIDTH::native

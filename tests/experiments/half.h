// Half-precision numbers (IEEE 754 binary16) in the low 16 bits of an Int: a sign, 5 bits of exponent, 10 of mantissa.
// In integers, because not every instruction set that the lanes know converts halves.
#pragma once

#include "relief/lanes/float.h"

namespace relief::experiments {

// Rounded to nearest, ties to even; from 65520 on infinite. Not for NaN.
inline Int toHalf(Float number)
{
    const Float size = abs(number);
    const Int bits = asInt(size), sign = shiftRightLogical(asInt(number), 16) & 0x8000;
    const Int normal = ((bits + 0xfff + ((bits >> 13) & 1)) >> 13) - (112 << 10);
    const Int subnormal = asInt(size + 0.5f) - 0x3f000000;  // beside 0.5, a float's last bit is the smallest half
    const Int finite = select(size < 0x1p-14f, subnormal, normal);
    return select(size < 65520.0f, finite, Int(0x7c00)) | sign;
}

// Of a finite half.
inline Float fromHalf(Int half)
{
    const Int sign = (half & 0x8000) << 16;
    return asFloat(asInt(asFloat((half & 0x7fff) << 13) * 0x1p112f) | sign);
}

}  // namespace relief::experiments

// HLSL's intrinsic functions of one value of lanes, as far as lanes/ does not have them under HLSL's names: what
// vector_intrinsics.h applies to each component.
#pragma once

#include <initializer_list>

#include "relief/lanes/math.h"

namespace relief::inline RELIEF_WIDTH {

inline Float lerp(Float a, Float b, Float t)
{
    return a + (b - a) * t;
}
inline Float step(Float edge, Float x)
{
    return select(x >= edge, Float(1.0f), Float(0.0f));
}
inline Float sign(Float x)
{
    return select(x > 0.0f, Float(1.0f), select(x < 0.0f, Float(-1.0f), Float(0.0f)));
}
// -1 or 1: 1 for both zeros, where sign() gives 0, and for NaN.
inline Float signNotZero(Float x)
{
    return select(x < 0.0f, Float(-1.0f), Float(1.0f));
}
inline Float rcp(Float x)
{
    return 1.0f / x;
}
inline Float rsqrt(Float x)
{
    return 1.0f / sqrt(x);
}
inline Float smoothstep(Float low, Float high, Float x)
{
    const Float t = saturate((x - low) / (high - low));
    return t * t * (3.0f - 2.0f * t);
}

inline Float degrees(Float x)
{
    return x * 57.2957795f;
}
inline Float radians(Float x)
{
    return x * 0.0174532925f;
}
// Two roundings, on every machine: never a fused multiply-add.
inline Float mad(Float a, Float b, Float c)
{
    return a * b + c;
}
inline Int mad(Int a, Int b, Int c)
{
    return a * b + c;
}
inline Float mul(Float a, Float b)
{
    return a * b;
}
inline Float dot(Float a, Float b)
{
    return a * b;
}
inline Int mul(Int a, Int b)
{
    return a * b;
}
inline Int dot(Int a, Int b)
{
    return a * b;
}
// What remains of x, of x's sign: x - y * trunc(x / y). Exact where the quotient is small, else within 2^-24 of |x|,
// and always less than |y|. NaN for y = 0 and for an infinite x.
inline Float fmod(Float x, Float y)
{
    const Float a = abs(x), b = abs(y);
    Float rest = a - b * floor(a / b);
    rest = select(rest < 0.0f, rest + b, rest);  // the quotient was rounded up
    rest = select((rest >= b) | (rest < 0.0f), Float(0.0f), rest);
    rest = select(isinf(y) & isfinite(x), a, rest);
    return select(isnan(rest), quietNan(), copySign(rest, x));
}
inline Float operator%(Float x, Float y)
{
    return fmod(x, y);
}
inline Float& operator%=(Float& x, Float y)
{
    return x = x % y;
}
inline Float modf(Float x, Float& whole)
{
    whole = trunc(x);
    return x - whole;
}
inline Float ldexp(Float x, Float exponent)
{
    return x * exp2(exponent);
}
// x = result * 2^exponent with the result in [0.5, 1); zeros, infinities and NaN come back with the exponent 0.
inline Float frexp(Float x, Float& exponent)
{
    const Mask tiny = abs(x) < 1.17549435e-38f, ordinary = (x != 0.0f) & isfinite(x);
    const Int bits = asInt(select(tiny, x * 16777216.0f, x));
    const Int biased = (bits >> 23) & 255;
    exponent = select(ordinary, Float(biased - 126) - select(tiny, Float(24.0f), Float(0.0f)), Float(0.0f));
    return select(ordinary, asFloat((bits & Int(-0x7f800001)) | 0x3f000000), x);
}

// Per pixel, as of vectors. any(Mask) asks all pixels of the block.
inline Mask any(Float x)
{
    return x != 0.0f;
}
inline Mask all(Float x)
{
    return x != 0.0f;
}
inline Mask any(Int x)
{
    return x != 0;
}
inline Mask all(Int x)
{
    return x != 0;
}

// --- bits of integers ---

// How many are set.
inline Int countbits(Int x)
{
    x = x - (shiftRightLogical(x, 1) & 0x55555555);
    x = (x & 0x33333333) + (shiftRightLogical(x, 2) & 0x33333333);
    x = (x + shiftRightLogical(x, 4)) & 0x0f0f0f0f;
    return shiftRightLogical(x * 0x01010101, 24);
}
inline Int reversebits(Int x)
{
    x = ((x & 0x55555555) << 1) | (shiftRightLogical(x, 1) & 0x55555555);
    x = ((x & 0x33333333) << 2) | (shiftRightLogical(x, 2) & 0x33333333);
    x = ((x & 0x0f0f0f0f) << 4) | (shiftRightLogical(x, 4) & 0x0f0f0f0f);
    x = ((x & 0x00ff00ff) << 8) | (shiftRightLogical(x, 8) & 0x00ff00ff);
    return (x << 16) | shiftRightLogical(x, 16);
}
// The lowest set bit; the highest that differs from the sign. -1 where there is none.
inline Int firstbitlow(Int x)
{
    return select(x == 0, Int(-1), countbits((x & -x) - 1));
}
inline Int firstbithigh(Int x)
{
    x = x ^ (x >> 31);
    for (const int bits : {1, 2, 4, 8, 16}) x = x | shiftRightLogical(x, bits);
    return countbits(x) - 1;
}

inline Int abs(Int x)
{
    return max(x, -x);
}
inline Int sign(Int x)
{
    return select(x > 0, Int(1), select(x < 0, Int(-1), Int(0)));
}

// Between two plain numbers: a Float, or an Int where both are integers.
template <Number A, Number B>
auto select(Mask m, A a, B b)
{
    using Lanes = std::conditional_t<WholeNumber<A> && WholeNumber<B>, Int, Float>;
    return select(m, Lanes(a), Lanes(b));
}

}  // namespace relief::inline RELIEF_WIDTH

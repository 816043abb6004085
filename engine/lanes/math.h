// exp2, log2, pow, sin, cos and atan2 from exact operations alone, so that they give the same bits everywhere (a C
// library does not promise that). The errors are the largest over all mantissas as tests/lanes_math.cpp measures them;
// D3D 11.3 (22.10) asks for a relative 2^-21 = 4.8e-7 of exp2 and log2 and an absolute 8e-4 of sin and cos.
#pragma once

#include <limits>

#include "lanes/float.h"

namespace relief {

// 2^x. Relative error below 1.1e-7 where the result is a normal number, absolute error below 2^-149 (the smallest
// subnormal) where it is not. Integers give exact powers. exp2(-inf) = 0, overflow is +inf.
inline Float exp2(Float x)
{
    // Split into an integer, which becomes exponent bits, and a rest in [-0.5, 0.5] for a polynomial with p(0) = 1.
    // From -254 down both factors below are 0, exactly: a product that has to be rounded to 0 takes the processor
    // longer than all of the rest, and pow(0, y), where nothing shines, is common.
    const Float limited = clamp(x, -254.0f, 129.0f);
    const Int integer = roundToInt(limited);
    const Float f = limited - Float(integer);
    Float p = 0.0001546973198f;
    p = p * f + 0.001341000097f;
    p = p * f + 0.009618030783f;
    p = p * f + 0.05550297314f;
    p = p * f + 0.2402265108f;
    p = p * f + 0.6931472254f;
    p = p * f + 1.0f;

    // In two factors, because 2^integer alone can leave the range of normal numbers.
    const Int half = integer >> 1;
    const Float scaleA = asFloat((half + 127) << 23);
    const Float scaleB = asFloat((integer - half + 127) << 23);
    return select(isnan(x), x, p * scaleA * scaleB);
}

namespace detail {

// log2() of positive normal numbers only, less a whole number; others give something.
inline Float log2OfNormal(Float x, Float exponentOffset = 0.0f)
{
    // x = 2^exponent * m with m in [sqrt(1/2), sqrt(2)); log2(m) = 2/ln2 * artanh(s) with s = (m-1) / (m+1).
    const Int bits = asInt(x);
    const Int exponent = (bits - 0x3f3504f3) >> 23;
    const Float m = asFloat(bits - (exponent << 23));
    const Float s = (m - 1.0f) / (m + 1.0f);
    const Float t = s * s;
    Float p = 0.4317432555f;
    p = p * t + 0.5767140958f;
    p = p * t + 0.9617988499f;
    p = p * t + 2.88539008f;
    return Float(exponent) - exponentOffset + s * p;
}

}  // namespace detail

// The binary logarithm. On [0.5, 2]: absolute error below 1.2e-7, relative error below 2.3e-7. Outside: relative error
// below 1e-7. Powers of two give exact integers.
// log2(0) = -inf, log2(+inf) = +inf, NaN below zero.
inline Float log2(Float x)
{
    // Subnormal numbers are scaled into the normal range first.
    const Mask tiny = x < 1.17549435e-38f;
    const Float scaled = select(tiny, x * 8388608.0f, x);
    const Float result = detail::log2OfNormal(scaled, select(tiny, Float(23.0f), Float(0.0f)));

    const float infinity = std::numeric_limits<float>::infinity();
    const Float special = select(x == 0.0f, Float(-infinity), select(x < 0.0f, Float(0.0f) / Float(0.0f), x));
    return select((x > 0.0f) & (x < infinity), result, special);
}

// x^y = exp2(y log2 x), HLSL's definition: NaN for x < 0. x^0 = 1 for every x, 0 included.
// Relative error below 2e-7 * (1 + |y log2 x|); rounding the exponent alone makes 0.4e-7 * |y log2 x| of it.
inline Float pow(Float x, Float y)
{
    return select(y == 0.0f, Float(1.0f), exp2(y * log2(x)));
}

namespace detail {

// sin where phase is 0, cos where it is 1.
inline Float sine(Float x, int phase)
{
    // x = quadrant * pi/2 + r. pi/2 in three parts, the first two so short that quadrant * part is exact.
    const Float limited = clamp(x, -1e6f, 1e6f);
    const Int quadrant = roundToInt(limited * 0.636619772f);
    const Float q = Float(quadrant);
    const Float r = limited - q * 1.5703125f - q * 4.837512969970703e-4f - q * 7.549789948768648e-8f;

    const Float t = r * r;
    Float sin = -0.0001950402201f;
    sin = sin * t + 0.008332036875f;
    sin = sin * t - 0.166666507f;
    sin = sin * t * r + r;
    Float cos = 2.437992935e-05f;
    cos = cos * t - 0.001388661921f;
    cos = cos * t + 0.04166661674f;
    cos = cos * t - 0.4999999962f;
    cos = cos * t + 1.0f;

    const Int turn = quadrant + phase;
    const Float result = select((turn & 1) == 1, cos, sin);
    const Float flipped = asFloat(asInt(result) ^ ((turn & 2) << 30));
    return select(abs(x) <= 1e6f, flipped, Float(0.0f) / Float(0.0f));
}

}  // namespace detail

// Sine and cosine of radians: absolute error below 1e-7 for |x| <= 8192, below 1e-6 up to 1e5. Beyond 1e6, where a
// float is too coarse for an angle to mean anything, and for NaN and infinities: NaN.
inline Float sin(Float x)
{
    return detail::sine(x, 0);
}
inline Float cos(Float x)
{
    return detail::sine(x, 1);
}

// The angle of the point (x, y) in radians, from +x towards +y, -pi to pi; the sign is y's, that of a zero included.
// Relative error below 1.2e-7 where the result is a normal number; absolute error below 2.1e-7 all around the circle.
// atan2(+-0, x) = +-0 for x >= +0, +-pi for x <= -0; infinities are directions too: atan2(+inf, -inf) = 3/4 pi. NaN
// where x or y is NaN. Axes and diagonals give the floats nearest to the multiples of pi/4.
inline Float atan2(Float y, Float x)
{
    // The angle to the nearest axis, from the ratio of the smaller to the larger length: 0 to 1, for equal lengths too.
    const Float absX = abs(x);
    const Float absY = abs(y);
    const Mask steep = absY > absX;
    const Float shorter = select(steep, absX, absY);
    const Float longer = select(steep, absY, absX);
    const Float ifEqual = select(longer == 0.0f, Float(0.0f), Float(1.0f));
    const Float r = select(shorter == longer, ifEqual, shorter / longer);
    const Float t = r * r;
    Float p = 0.0029206865f;
    p = p * t - 0.01636790484f;
    p = p * t + 0.04321182147f;
    p = p * t - 0.07552210987f;
    p = p * t + 0.1066600308f;
    p = p * t - 0.1421105564f;
    p = p * t + 0.199937731f;
    p = p * t - 0.3333315253f;
    const Float toAxis = r + r * (t * p);

    // Added to the axis or taken from it. pi is the sum of two floats, so that it is as if it were exact.
    const Mask left = asInt(x) < 0;
    const Float axis = select(steep, Float(1.57079637f), select(left, Float(3.14159274f), Float(0.0f)));
    const Float rest = select(steep, Float(-4.37113883e-8f), select(left, Float(-8.74227766e-8f), Float(0.0f)));
    const Mask before = (steep & !left) | (left & !steep);
    const Float angle = axis + (rest + select(before, -toAxis, toAxis));
    return asFloat(asInt(angle) | (asInt(y) & Int(std::numeric_limits<std::int32_t>::min())));
}

// The same for one number, with the same bits.
inline float exp2(float x)
{
    return exp2(Float(x))[0];
}
inline float log2(float x)
{
    return log2(Float(x))[0];
}
inline float pow(float x, float y)
{
    return pow(Float(x), Float(y))[0];
}
inline float sin(float x)
{
    return sin(Float(x))[0];
}
inline float cos(float x)
{
    return cos(Float(x))[0];
}
inline float atan2(float y, float x)
{
    return atan2(Float(y), Float(x))[0];
}

}  // namespace relief

// sin, cos, tan and their inverses from exact operations alone; see math.h, which includes this.
#pragma once

#include "relief/lanes/float.h"

namespace relief::inline RELIEF_WIDTH {

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
    return select(abs(x) <= 1e6f, flipped, quietNan());
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
inline void sincos(Float x, Float& sine, Float& cosine)
{
    sine = sin(x);
    cosine = cos(x);
}

// sin / cos, as HLSL has it. Error below 2e-7 (1 + tan^2 x) for |x| <= 8192.
inline Float tan(Float x)
{
    return sin(x) / cos(x);
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
    return select(isnan(x) | isnan(y), quietNan(), copySign(angle, y));
}

// Of a ratio, -pi/2 to pi/2. Relative error below 1.3e-7.
inline Float atan(Float x)
{
    return atan2(x, 1.0f);
}

// The angle whose sine or cosine is x; NaN beyond -1 to 1. (1 - x)(1 + x) keeps the digits that 1 - x^2 loses at the
// ends. Relative error of asin below 1.9e-7, of acos below 2.2e-7.
inline Float asin(Float x)
{
    return atan2(x, sqrt((1.0f - x) * (1.0f + x)));
}
inline Float acos(Float x)
{
    return atan2(sqrt((1.0f - x) * (1.0f + x)), x);
}

// The same for one number, with the same bits.
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

}  // namespace relief::inline RELIEF_WIDTH

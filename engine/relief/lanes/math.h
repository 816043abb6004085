// exp, log, pow, sin, cos and their like from exact operations alone, so that they give the same bits everywhere (a C
// library does not promise that); a NaN that they give is always quietNan(). The errors are the largest over all
// mantissas as tests/lanes_math.cpp measures them; D3D 11.3 (22.10) asks for a relative 2^-21 = 4.8e-7 of exp2 and log2
// and an absolute 8e-4 of sin and cos.
#pragma once

#include <limits>

#include "relief/lanes/float.h"
#include "relief/lanes/trigonometry.h"

namespace relief::inline RELIEF_WIDTH {

namespace detail {

// 2^(integer + f), f in [-0.5, 0.5].
inline Float exp2OfParts(Int integer, Float f)
{
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
    return p * scaleA * scaleB;
}

}  // namespace detail

// 2^x. Relative error below 1.1e-7 where the result is a normal number, absolute error below 2^-149 (the smallest
// subnormal) where it is not. Integers give exact powers. exp2(-inf) = 0, overflow is +inf.
inline Float exp2(Float x)
{
    // Split into an integer, which becomes exponent bits, and a rest in [-0.5, 0.5] for a polynomial with p(0) = 1.
    // From -254 down both factors are 0, exactly: a product that has to be rounded to 0 takes the processor longer than
    // all of the rest, and pow(0, y), where nothing shines, is common.
    const Float limited = clamp(x, -254.0f, 129.0f);
    const Int integer = roundToInt(limited);
    return select(isnan(x), quietNan(), detail::exp2OfParts(integer, limited - Float(integer)));
}

// e^x, by 2^n e^r with x = n ln 2 + r: ln 2 in two parts, so that r is good to the last bit. Relative error below
// 1.2e-7 where the result is a normal number; the rest as exp2.
inline Float exp(Float x)
{
    const Float limited = clamp(x, -176.0f, 89.0f);
    const Int n = roundToInt(limited * 1.44269504f);
    const Float r = limited - Float(n) * 0.693359375f + Float(n) * 2.12194440e-4f;
    return select(isnan(x), quietNan(), detail::exp2OfParts(n, r * 1.44269504f));
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
    const Float special = select(x == 0.0f, Float(-infinity), select(x > 0.0f, x, quietNan()));
    return select((x > 0.0f) & (x < infinity), result, special);
}

// The natural and the decimal logarithm: relative errors below 2.7e-7 and 3.1e-7.
inline Float log(Float x)
{
    return log2(x) * 0.693147181f;
}
inline Float log10(Float x)
{
    return log2(x) * 0.301029996f;
}

// x^y = exp2(y log2 x), HLSL's definition: NaN for x < 0. x^0 = 1 for every x, 0 included.
// Relative error below 2e-7 * (1 + |y log2 x|); rounding the exponent alone makes 0.4e-7 * |y log2 x| of it.
inline Float pow(Float x, Float y)
{
    return select(y == 0.0f, Float(1.0f), exp2(y * log2(x)));
}

// The hyperbolic functions: relative errors of sinh, cosh and tanh below 2e-7, 1.6e-7 and 2e-7. From |x| = 88.73 on,
// where exp is infinite, sinh and cosh are too, though floats could hold them up to 89.41. Near 0, where the difference
// of two exponentials has no digits left, sinh is its series.
inline Float cosh(Float x)
{
    const Float e = exp(abs(x));
    return 0.5f * e + 0.5f / e;
}
inline Float sinh(Float x)
{
    const Float t = x * x;
    const Float series =
        x + x * t * ((((2.75573192e-6f * t + 1.98412698e-4f) * t + 8.33333333e-3f) * t) + 0.166666667f);
    const Float e = exp(abs(x));
    const Float far = copySign(0.5f * e - 0.5f / e, x);
    return select(isnan(x), quietNan(), select(t < 1.0f, series, far));
}
inline Float tanh(Float x)
{
    const Float a = min(abs(x), Float(10.0f));  // from there on it is 1
    const Float far = copySign(1.0f - 2.0f / (exp(2.0f * a) + 1.0f), x);
    return select(isnan(x), quietNan(), select(a < 0.55f, sinh(x) / cosh(x), far));
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

}  // namespace relief::inline RELIEF_WIDTH

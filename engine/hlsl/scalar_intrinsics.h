// HLSL's intrinsic functions of one value of lanes, as far as lanes/ does not have them under HLSL's names: what
// vector_intrinsics.h applies to each component.
#pragma once

#include "lanes/math.h"

namespace relief {

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

// Between two plain numbers: a Float, or an Int where both are integers.
template <class A, class B>
requires std::is_arithmetic_v<A> && std::is_arithmetic_v<B>
auto select(Mask m, A a, B b)
{
    using Lanes = std::conditional_t<std::is_integral_v<A> && std::is_integral_v<B>, Int, Float>;
    return select(m, Lanes(a), Lanes(b));
}

}  // namespace relief

// HLSL's intrinsic functions of vectors of any size. Those of each component stand here once, for 2, 3 and 4 of them:
//
//     max(v, 0)   lerp(a, b, t)   lerp(a, b, float3(0, 0.5f, 1))   clamp(v, 0, limits)
//
// A number, a single value, a plain vector of GLM or a field may stand for any vector, as with operators (vector.h);
// only one of the arguments must be of lanes already. Sums are taken from left to right: the order is part of the
// result.
#pragma once

#include <limits>

#include "relief/hlsl/scalar_intrinsics.h"
#include "relief/hlsl/swizzles.h"

namespace relief::inline RELIEF_WIDTH::detail {

// The plain numbers that become a T by themselves.
template <class N, class T>
concept NumberFor = Number<N> &&
    (std::is_same_v<T, Float> || (std::is_same_v<T, Int> && WholeNumber<N>) || std::is_same_v<N, bool>);

// A vector of function(x), function(y) ... of the components of one or more vectors.
template <class Result, class Function, class T, int n, class... Others>
Result each(Function function, const LaneVector<T, n>& v, const Others&... others)
{
    if constexpr (n == 2) return Result(function(v.x, others.x...), function(v.y, others.y...));
    if constexpr (n == 3)
        return Result(function(v.x, others.x...), function(v.y, others.y...), function(v.z, others.z...));
    if constexpr (n == 4)
        return Result(function(v.x, others.x...), function(v.y, others.y...), function(v.z, others.z...),
                      function(v.w, others.w...));
}

// Direct3D's ftoi: toward zero, to the nearest integer that there is, and 0 of NaN.
inline Int saturatingToInt(Float v)
{
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    const Int inRange = select(isnan(v), Int(0), truncateToInt(v));
    return select(v >= 0x1p31f, Int(~least), select(v <= -0x1p31f, Int(least), inRange));
}

// HLSL's cast of one value: toward zero, and 1 or 0 of a mask.
template <class To, class From>
To castTo(From v)
{
    if constexpr (std::is_same_v<To, Mask>)
        return v != From(0);
    else if constexpr (std::is_same_v<From, Mask>)
        return select(v, To(1), To(0));
    else if constexpr (std::is_same_v<To, Int>)
        return saturatingToInt(v);
    else
        return To(v);
}

template <class T, int n>
struct VectorIntrinsics;

// A function of one, two or three values, applied to each component.
#define RELIEF_OF_EACH(R, name)                            \
    friend R name(const V& v)                              \
    {                                                      \
        return each<R>([](auto x) { return name(x); }, v); \
    }
#define RELIEF_OF_EACH_TWO(name)                                         \
    friend V name(const V& a, const V& b)                                \
    {                                                                    \
        return each<V>([](auto x, auto y) { return name(x, y); }, a, b); \
    }
#define RELIEF_OF_EACH_THREE(name)                                                     \
    friend V name(const V& a, const V& b, const V& c)                                  \
    {                                                                                  \
        return each<V>([](auto x, auto y, auto z) { return name(x, y, z); }, a, b, c); \
    }

// Those of numbers of both kinds.
template <class T, int n>
struct NumberIntrinsics
{
    using V = LaneVector<T, n>;
    using B = LaneVector<Mask, n>;

    RELIEF_OF_EACH(V, abs)
    RELIEF_OF_EACH(V, sign)
    RELIEF_OF_EACH_TWO(min)
    RELIEF_OF_EACH_TWO(max)
    RELIEF_OF_EACH_THREE(clamp)
    friend V mad(const V& a, const V& b, const V& c) { return a * b + c; }

    friend V select(Mask m, const V& a, const V& b)
    {
        return each<V>([m](T x, T y) { return select(m, x, y); }, a, b);
    }
    friend V select(const B& m, const V& a, const V& b)
    {
        return each<V>([](Mask k, T x, T y) { return select(k, x, y); }, m, a, b);
    }

    // Per pixel: whether any component is not 0, or none is.
    friend Mask any(const V& v) { return any(v != V(0)); }
    friend Mask all(const V& v) { return all(v != V(0)); }

    friend T dot(const V& a, const V& b)
    {
        if constexpr (n == 2) return a.x * b.x + a.y * b.y;
        if constexpr (n == 3) return a.x * b.x + a.y * b.y + a.z * b.z;
        if constexpr (n == 4) return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
    }

    // HLSL's mul of vectors: two make their dot product, a number scales.
    friend T mul(const V& a, const V& b) { return dot(a, b); }
    friend V mul(const V& v, T s) { return v * s; }
    friend V mul(T s, const V& v) { return s * v; }
    template <NumberFor<T> N>
    friend V mul(const V& v, N s)
    {
        return v * s;
    }
    template <NumberFor<T> N>
    friend V mul(N s, const V& v)
    {
        return s * v;
    }
};

template <int n>
struct VectorIntrinsics<Float, n> : NumberIntrinsics<Float, n>
{
    using V = LaneVector<Float, n>;
    using I = LaneVector<Int, n>;
    using B = LaneVector<Mask, n>;

    RELIEF_OF_EACH(V, saturate)
    RELIEF_OF_EACH(V, floor)
    RELIEF_OF_EACH(V, ceil)
    RELIEF_OF_EACH(V, round)
    RELIEF_OF_EACH(V, trunc)
    RELIEF_OF_EACH(V, frac)
    RELIEF_OF_EACH(V, sqrt)
    RELIEF_OF_EACH(V, rsqrt)
    RELIEF_OF_EACH(V, rcp)
    RELIEF_OF_EACH(V, exp)
    RELIEF_OF_EACH(V, exp2)
    RELIEF_OF_EACH(V, log)
    RELIEF_OF_EACH(V, log2)
    RELIEF_OF_EACH(V, log10)
    RELIEF_OF_EACH(V, sin)
    RELIEF_OF_EACH(V, cos)
    RELIEF_OF_EACH(V, tan)
    RELIEF_OF_EACH(V, asin)
    RELIEF_OF_EACH(V, acos)
    RELIEF_OF_EACH(V, atan)
    RELIEF_OF_EACH(V, sinh)
    RELIEF_OF_EACH(V, cosh)
    RELIEF_OF_EACH(V, tanh)
    RELIEF_OF_EACH(V, degrees)
    RELIEF_OF_EACH(V, radians)
    RELIEF_OF_EACH(B, isnan)
    RELIEF_OF_EACH(B, isinf)
    RELIEF_OF_EACH(B, isfinite)
    RELIEF_OF_EACH(I, asint)

    RELIEF_OF_EACH_TWO(step)
    RELIEF_OF_EACH_TWO(pow)
    RELIEF_OF_EACH_TWO(fmod)
    RELIEF_OF_EACH_TWO(atan2)
    RELIEF_OF_EACH_TWO(ldexp)

    RELIEF_OF_EACH_THREE(smoothstep)
    friend V lerp(const V& a, const V& b, const V& t) { return a + (b - a) * t; }
    friend void sincos(V v, V& sine, V& cosine)
    {
        sine = sin(v);
        cosine = cos(v);
    }
    friend V modf(V v, V& whole)
    {
        whole = trunc(v);
        return v - whole;
    }
    friend V frexp(V v, V& exponent)
    {
        for (int i = 0; i < n; ++i) v[i] = frexp(v[i], exponent[i]);
        return v;
    }

    // --- of all components together ---

    friend Float length(const V& v) { return sqrt(dot(v, v)); }
    friend Float distance(const V& a, const V& b) { return length(a - b); }

    // The vector of length 1 in the same direction. The zero vector, and one with a NaN or an infinity in it, becomes
    // the zero vector: what HLSL leaves undefined must not become a NaN in a picture. Any other length works, down to
    // the smallest subnormal number: where the square would leave the range of floats, the vector is scaled first.
    friend V normalize(const V& v)
    {
        const Float square = dot(v, v);
        const Mask ordinary = (square > 1e-30f) & (square < 1e30f);
        if (all(ordinary)) [[likely]]
            return v * (1.0f / sqrt(square));
        return normalizeScaled(v, ordinary);
    }

    // The direction of light that comes from `incident` and is mirrored at a surface with the unit normal `normal`.
    friend V reflect(const V& incident, const V& normal) { return incident - normal * (2.0f * dot(incident, normal)); }

    // The same, bent where it enters: `eta` is the ratio of the indices of refraction, outside to inside. The zero
    // vector where all light is reflected.
    friend V refract(const V& incident, const V& normal, Float eta)
    {
        const Float cosine = dot(incident, normal);
        const Float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
        const V bent = incident * eta - normal * (eta * cosine + sqrt(max(k, Float(0.0f))));
        return select(k >= 0.0f, bent, V(0.0f));
    }

    // `normal`, turned to the side that `incident` comes from, as `geometric` tells it.
    friend V faceforward(const V& normal, const V& incident, const V& geometric)
    {
        return select(dot(incident, geometric) < 0.0f, normal, -normal);
    }
};

// normalize() where a square leaves the range of floats. A function of its own, because it hardly ever runs.
template <int n>
[[gnu::noinline, gnu::cold]] LaneVector<Float, n> normalizeScaled(LaneVector<Float, n> v, Mask ordinary)
{
    using V = LaneVector<Float, n>;
    Float largest = abs(v[0]);
    for (int i = 1; i < n; ++i) largest = max(largest, abs(v[i]));
    const Mask subnormal = largest < 1.17549435e-38f;
    const Float lift = select(subnormal, Float(16777216.0f), Float(1.0f));
    const V scaled = v * lift / select(ordinary, Float(1.0f), largest * lift);
    const Float scaledSquare = dot(scaled, scaled);
    const Mask finite = (scaledSquare > 0.0f) & (scaledSquare <= std::numeric_limits<float>::max());
    return select(finite, scaled * (1.0f / sqrt(scaledSquare)), V(0.0f));
}

template <int n>
struct VectorIntrinsics<Int, n> : NumberIntrinsics<Int, n>
{
    using V = LaneVector<Int, n>;

    RELIEF_OF_EACH(V, countbits)
    RELIEF_OF_EACH(V, reversebits)
    RELIEF_OF_EACH(V, firstbitlow)
    RELIEF_OF_EACH(V, firstbithigh)
    friend LaneVector<Float, n> asfloat(const V& v)
    {
        return each<LaneVector<Float, n>>([](Int x) { return asfloat(x); }, v);
    }
};

template <int n>
struct VectorIntrinsics<Mask, n>
{
    using V = LaneVector<Mask, n>;

    // Per pixel, of its components. any(Mask) asks all pixels of the block.
    friend Mask any(const V& v)
    {
        if constexpr (n == 2) return v.x | v.y;
        if constexpr (n == 3) return v.x | v.y | v.z;
        if constexpr (n == 4) return v.x | v.y | v.z | v.w;
    }
    friend Mask all(const V& v)
    {
        if constexpr (n == 2) return v.x & v.y;
        if constexpr (n == 3) return v.x & v.y & v.z;
        if constexpr (n == 4) return v.x & v.y & v.z & v.w;
    }

    friend V select(Mask m, const V& a, const V& b)
    {
        return each<V>([m](Mask x, Mask y) { return select(m, x, y); }, a, b);
    }
    friend V select(const V& m, const V& a, const V& b)
    {
        return each<V>([](Mask k, Mask x, Mask y) { return select(k, x, y); }, m, a, b);
    }

    // Between two values that are no vectors.
    template <Number A, Number B>
    friend auto select(const V& m, A a, B b)
    {
        using Lanes = decltype(select(Mask(), a, b));
        return each<LaneVector<Lanes, n>>([a, b](Mask k) { return select(k, Lanes(a), Lanes(b)); }, m);
    }
    friend LaneVector<Float, n> select(const V& m, Float a, Float b)
    {
        return each<LaneVector<Float, n>>([a, b](Mask k) { return select(k, a, b); }, m);
    }
};

#undef RELIEF_OF_EACH
#undef RELIEF_OF_EACH_TWO
#undef RELIEF_OF_EACH_THREE

}  // namespace relief::inline RELIEF_WIDTH::detail

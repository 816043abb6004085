// HLSL's intrinsic functions of vectors of any size. Those of each component stand here once, for 2, 3 and 4 of them:
//
//     max(v, 0)   lerp(a, b, t)   lerp(a, b, float3(0, 0.5f, 1))   clamp(v, 0, limits)
//
// A number, a single value, a plain vector of GLM or a field may stand for any vector, as with operators (vector.h);
// only one of the arguments must be a vector of lanes already. Sums are taken from left to right: the order is part of
// the result.
#pragma once

#include <limits>

#include "hlsl/scalar_intrinsics.h"
#include "hlsl/swizzles.h"

namespace relief::detail {

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

// HLSL's cast of one value: toward zero, and 1 or 0 of a mask.
template <class To, class From>
To castTo(From v)
{
    if constexpr (std::is_same_v<To, Mask>)
        return v != From(0);
    else if constexpr (std::is_same_v<From, Mask>)
        return select(v, To(1), To(0));
    else if constexpr (std::is_same_v<To, Int>)
        return truncateToInt(v);
    else
        return To(v);
}

template <class T, int n>
struct VectorIntrinsics;

template <int n>
struct VectorIntrinsics<Float, n>
{
    using V = LaneVector<Float, n>;

    friend V saturate(const V& v)
    {
        return each<V>([](Float x) { return saturate(x); }, v);
    }
    friend V abs(const V& v)
    {
        return each<V>([](Float x) { return abs(x); }, v);
    }
    friend V floor(const V& v)
    {
        return each<V>([](Float x) { return floor(x); }, v);
    }
    friend V frac(const V& v)
    {
        return each<V>([](Float x) { return frac(x); }, v);
    }
    friend V sqrt(const V& v)
    {
        return each<V>([](Float x) { return sqrt(x); }, v);
    }
    friend V sign(const V& v)
    {
        return each<V>([](Float x) { return sign(x); }, v);
    }
    friend V pow(const V& a, const V& b)
    {
        return each<V>([](Float x, Float y) { return pow(x, y); }, a, b);
    }
    friend V min(const V& a, const V& b)
    {
        return each<V>([](Float x, Float y) { return min(x, y); }, a, b);
    }
    friend V max(const V& a, const V& b)
    {
        return each<V>([](Float x, Float y) { return max(x, y); }, a, b);
    }
    friend V clamp(const V& v, const V& low, const V& high)
    {
        return each<V>([](Float x, Float l, Float h) { return clamp(x, l, h); }, v, low, high);
    }
    friend V lerp(const V& a, const V& b, const V& t) { return a + (b - a) * t; }
    friend V select(Mask m, const V& a, const V& b)
    {
        return each<V>([m](Float x, Float y) { return select(m, x, y); }, a, b);
    }

    // --- of all components together ---

    friend Float dot(const V& a, const V& b)
    {
        if constexpr (n == 2) return a.x * b.x + a.y * b.y;
        if constexpr (n == 3) return a.x * b.x + a.y * b.y + a.z * b.z;
        if constexpr (n == 4) return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
    }
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
struct VectorIntrinsics<Int, n>
{
};

template <int n>
struct VectorIntrinsics<Mask, n>
{
};

}  // namespace relief::detail

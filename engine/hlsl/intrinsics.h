// HLSL's intrinsic functions on lanes, under their HLSL names. min, max, clamp, saturate, abs, sqrt, floor, exp2, log2,
// pow, sin and cos of a single Float are in lanes/. Sums are taken from left to right: the order is part of the result.
#pragma once

#include "hlsl/semantics.h"
#include "hlsl/types.h"
#include "lanes/math.h"

namespace relief {

namespace detail {

template <int size, class Function>
FloatN<size> map(const FloatN<size>& v, Function function)
{
    FloatN<size> r;
    for (int i = 0; i < size; ++i) r[i] = function(v[i]);
    return r;
}

template <int size, class Function>
FloatN<size> map(const FloatN<size>& a, const FloatN<size>& b, Function function)
{
    FloatN<size> r;
    for (int i = 0; i < size; ++i) r[i] = function(a[i], b[i]);
    return r;
}

}  // namespace detail

// --- of one value, and of each component ---

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

template <int size>
FloatN<size> saturate(const FloatN<size>& v)
{
    return detail::map(v, [](Float x) { return saturate(x); });
}
template <int size>
FloatN<size> abs(const FloatN<size>& v)
{
    return detail::map(v, [](Float x) { return abs(x); });
}
template <int size>
FloatN<size> floor(const FloatN<size>& v)
{
    return detail::map(v, [](Float x) { return floor(x); });
}
template <int size>
FloatN<size> frac(const FloatN<size>& v)
{
    return detail::map(v, [](Float x) { return frac(x); });
}
template <int size>
FloatN<size> sqrt(const FloatN<size>& v)
{
    return detail::map(v, [](Float x) { return sqrt(x); });
}
template <int size>
FloatN<size> sign(const FloatN<size>& v)
{
    return detail::map(v, [](Float x) { return sign(x); });
}
template <int size>
FloatN<size> pow(const FloatN<size>& v, Float y)
{
    return detail::map(v, [y](Float x) { return pow(x, y); });
}
template <int size>
FloatN<size> min(const FloatN<size>& a, const FloatN<size>& b)
{
    return detail::map(a, b, [](Float x, Float y) { return min(x, y); });
}
template <int size>
FloatN<size> max(const FloatN<size>& a, const FloatN<size>& b)
{
    return detail::map(a, b, [](Float x, Float y) { return max(x, y); });
}
template <int size>
FloatN<size> clamp(const FloatN<size>& v, Float low, Float high)
{
    return detail::map(v, [low, high](Float x) { return clamp(x, low, high); });
}
template <int size>
FloatN<size> lerp(const FloatN<size>& a, const FloatN<size>& b, Float t)
{
    return a + (b - a) * t;
}
template <int size>
FloatN<size> select(Mask m, const FloatN<size>& a, const FloatN<size>& b)
{
    return detail::map(a, b, [m](Float x, Float y) { return select(m, x, y); });
}

// --- of vectors ---

inline Float dot(const float2& a, const float2& b)
{
    return a.x * b.x + a.y * b.y;
}
inline Float dot(const float3& a, const float3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float dot(const float4& a, const float4& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

inline float3 cross(const float3& a, const float3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <int size>
Float length(const FloatN<size>& v)
{
    return sqrt(dot(v, v));
}
template <int size>
Float distance(const FloatN<size>& a, const FloatN<size>& b)
{
    return length(FloatN<size>(a - b));
}

namespace detail {

// normalize() where a square leaves the range of floats. A function of its own, because it hardly ever runs.
template <int size>
[[gnu::noinline, gnu::cold]] FloatN<size> normalizeScaled(FloatN<size> v, Mask ordinary)
{
    Float largest = abs(v[0]);
    for (int i = 1; i < size; ++i) largest = max(largest, abs(v[i]));
    const Mask subnormal = largest < 1.17549435e-38f;
    const Float lift = select(subnormal, Float(16777216.0f), Float(1.0f));
    const FloatN<size> scaled = v * lift / select(ordinary, Float(1.0f), largest * lift);
    const Float scaledSquare = dot(scaled, scaled);
    const Mask finite = (scaledSquare > 0.0f) & (scaledSquare <= std::numeric_limits<float>::max());
    return select(finite, scaled * (1.0f / sqrt(scaledSquare)), FloatN<size>(Float(0.0f)));
}

}  // namespace detail

// The vector of length 1 in the same direction. The zero vector, and one with a NaN or an infinity in it, becomes the
// zero vector: what HLSL leaves undefined must not become a NaN in a picture. Any other length works, down to the
// smallest subnormal number: where the square would leave the range of floats, the vector is scaled first.
template <int size>
FloatN<size> normalize(const FloatN<size>& v)
{
    const Float square = dot(v, v);
    const Mask ordinary = (square > 1e-30f) & (square < 1e30f);
    if (all(ordinary)) [[likely]]
        return v * (1.0f / sqrt(square));
    return detail::normalizeScaled(v, ordinary);
}

// The direction of light that comes from `incident` and is mirrored at a surface with the unit normal `normal`.
inline float3 reflect(const float3& incident, const float3& normal)
{
    return incident - normal * (2.0f * dot(incident, normal));
}

// --- of matrices; vectors are columns on the right, rows on the left ---

inline float3 mul(const float3x3& m, const float3& v)
{
    return m[0] * v.x + m[1] * v.y + m[2] * v.z;
}
inline float4 mul(const float4x4& m, const float4& v)
{
    return m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3] * v.w;
}
inline float3 mul(const float3& v, const float3x3& m)
{
    return {dot(v, m[0]), dot(v, m[1]), dot(v, m[2])};
}
inline float4 mul(const float4& v, const float4x4& m)
{
    return {dot(v, m[0]), dot(v, m[1]), dot(v, m[2]), dot(v, m[3])};
}
// The rows of m as columns.
inline float3x3 transpose(const float3x3& m)
{
    return {float3(m[0].x, m[1].x, m[2].x), float3(m[0].y, m[1].y, m[2].y), float3(m[0].z, m[1].z, m[2].z)};
}
inline float3x3 upper3x3(const float4x4& m)
{
    return {m[0].xyz(), m[1].xyz(), m[2].xyz()};
}  // HLSL: (float3x3)m

// --- of the fields of a struct ---

// A field in an intrinsic function stands for its value. For these GLM has templates that would take the field's type.
template <class Meaning, class T>
auto abs(const Semantic<Meaning, T>& v)
{
    return abs(static_cast<const T&>(v));
}
template <class Meaning, class T>
auto sign(const Semantic<Meaning, T>& v)
{
    return sign(static_cast<const T&>(v));
}
template <class Meaning, class T>
auto length(const Semantic<Meaning, T>& v)
{
    return length(static_cast<const T&>(v));
}
template <class Meaning, class T>
auto dot(const Semantic<Meaning, T>& a, const Semantic<Meaning, T>& b)
{
    return dot(static_cast<const T&>(a), static_cast<const T&>(b));
}
template <class Meaning, class T>
auto min(const Semantic<Meaning, T>& a, const Semantic<Meaning, T>& b)
{
    return min(static_cast<const T&>(a), static_cast<const T&>(b));
}
template <class Meaning, class T>
auto max(const Semantic<Meaning, T>& a, const Semantic<Meaning, T>& b)
{
    return max(static_cast<const T&>(a), static_cast<const T&>(b));
}

}  // namespace relief

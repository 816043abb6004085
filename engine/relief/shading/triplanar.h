// Triplanar mapping: a texture is laid over a surface from three sides, along the axes of the world, and the three
// colours or normals are mixed by where the surface's normal points. It takes a position and a normal, and neither uv
// nor tangents (Ben Golus, "Normal Mapping for a Triplanar Shader").
//
// Each of the three planes has coordinates of its own, in which its projection axis is the third: (z, y, x), (x, z, y)
// and (x, y, z) of the world. The first two are u and v. The same swizzle leads there and back. Nothing here depends on
// whether the world is left- or right-handed; only which sides show a picture mirrored does (docs/triplanar_signs.md).
#pragma once

#include <cmath>

#include "relief/hlsl/intrinsics.h"
#include "relief/texture/sampler.h"

namespace relief::inline RELIEF_WIDTH {

// One value for each plane, named by its projection axis.
template <class T>
struct Triplanar
{
    T x, y, z;
};

inline Triplanar<float2> TriplanarUV(const float3& position)
{
    return {position.zy(), position.xz(), position.xy()};
}

// An object's matrix with its place reduced by whole repetitions of a texture that repeats `tiling` times per unit: for
// positions to take uv from. The texture stays where it is; but far from the origin floats are too coarse for it, a
// sixteenth of a unit at a million. NaN and infinite places are left alone.
inline glm::mat4 withoutWholeTiles(glm::mat4 worldFromObject, float tiling)
{
    for (int i = 0; i < 3; ++i) {
        const double tiles = static_cast<double>(worldFromObject[3][i]) * static_cast<double>(tiling);
        if (!std::isfinite(tiles) || tiling == 0.0f) continue;
        worldFromObject[3][i] = static_cast<float>((tiles - std::floor(tiles)) / static_cast<double>(tiling));
    }
    return worldFromObject;
}

// -1 or 1 for each component: on which side of a plane the surface lies. Never 0, as sign() is at 0: that would take a
// plane's z away.
inline float3 axisSign(const float3& normal)
{
    return {signNotZero(normal.x), signNotZero(normal.y), signNotZero(normal.z)};
}

// The texture from three sides. A plane is fetched only where it has weight; elsewhere it is 0.
inline Triplanar<float4> tex2DTriplanar(const sampler2D& s, const Triplanar<float2>& uv, const float3& weights)
{
    return {tex2DWhere(weights.x > 0.0f, s, uv.x), tex2DWhere(weights.y > 0.0f, s, uv.y),
            tex2DWhere(weights.z > 0.0f, s, uv.z)};
}

// --- the weights of the three planes: each in 0..1, their sum 1 within 3 * 2^-24, for any normal. Where it gives none,
// as the zero vector and one of NaN do, the ground plane has all: (0, 1, 0).

namespace detail {

inline float3 sumToOne(const float3& weights)
{
    const Float sum = weights.x + weights.y + weights.z;
    return select((sum > 0.0f) & (sum < 3.4e38f), weights / sum, float3(0, 1, 0));
}

}  // namespace detail

// In proportion to the normal's components. Soft.
inline float3 TriplanarBlendLinear(const float3& normal)
{
    return detail::sumToOne(abs(normal));
}

// `offset` is taken from each component first (0.2 in GPU Gems 3, chapter 1), so that planes that face away by more
// are left out. Limited to 0..0.55: from 1 / sqrt(3) = 0.577 on nothing is left in the corners, and just below it the
// weights are noise. Where nothing is left for another reason, a normal much shorter than 1, linear.
inline float3 TriplanarBlendOffset(const float3& normal, Float offset)
{
    const float3 rest = max(abs(normal) - clamp(offset, 0.0f, 0.55f), float3(0.0f));
    return detail::sumToOne(select(rest.x + rest.y + rest.z > 0.0f, rest, abs(normal)));
}

// In proportion to the fourth power: two multiplications, for negative components too.
inline float3 TriplanarBlendPower4(const float3& normal)
{
    const float3 square = normal * normal;
    return detail::sumToOne(square * square);
}

// To any power in 0..128, the larger the sharper. The largest component is made 1 first, so that no power underflows.
inline float3 TriplanarBlendPower(const float3& normal, Float exponent)
{
    const float3 a = abs(normal);
    const Float largest = max(max(a.x, a.y), a.z);
    const Float e = clamp(exponent, 0.0f, 128.0f);
    const auto power = [&](Float x) { return select(largest > 0.0f, pow(x / largest, e), Float(0.0f)); };
    return detail::sumToOne(float3(power(a.x), power(a.y), power(a.z)));
}

// The top reaches far down and ends sharply, at a slope of 47 degrees; the sides meet each other softly.
inline float3 TriplanarBlendAsymmetric(const float3& normal)
{
    const Float onTop = saturate((abs(normal.y) - 0.675f) * 80.0f);
    const float2 sides = max(abs(normalize(float2(normal.x, normal.z))) - 0.67f, float2(0.0f));
    const Float onSides = (1.0f - onTop) / max(sides.x + sides.y, Float(1e-5f));
    return detail::sumToOne(float3(sides.x * onSides, onTop, sides.y * onSides));
}

// The highest texel shows. `heights`, limited to 0..1, are those of the three planes; `range`, at least 0.01, is by how
// much a lower one may be lower and still be mixed in.
inline float3 TriplanarBlendHeight(const float3& normal, const float3& heights, Float range)
{
    const float3 raised = saturate(heights) + TriplanarBlendLinear(normal) * 3.0f;
    const Float start = max(max(raised.x, raised.y), raised.z) - max(range, Float(0.01f));
    return detail::sumToOne(max(raised - start, float3(0.0f)));
}

// --- the normals of the three planes into one ---

// Three normals in their planes' coordinates, turned to the world and mixed; of unit length.
inline float3 Triblend(const Triplanar<float3>& normals, const float3& weights)
{
    return normalize(normals.x.zyx() * weights.x + normals.y.xzy() * weights.y + normals.z.xyz() * weights.z);
}

// Every method that takes a plane by itself: blend(surface, bump) is to put a bump of the normal map onto the surface's
// normal, both in the plane's coordinates, seen from the side that the surface faces (surface.z >= 0).
template <class Blend>
float3 TriplanarNormal(const Triplanar<float3>& bumps, const float3& normal, const float3& weights, Blend blend)
{
    const float3 side = axisSign(normal);
    const auto onPlane = [&](const float3& surface, const float3& bump, Float sign) {
        const float3 seen = blend(float3(surface.x, surface.y, abs(surface.z)), bump);
        return float3(seen.x, seen.y, seen.z * sign);
    };
    return Triblend({onPlane(normal.zyx(), bumps.x, side.x), onPlane(normal.xzy(), bumps.y, side.y),
                     onPlane(normal.xyz(), bumps.z, side.z)},
                    weights);
}

}  // namespace relief::inline RELIEF_WIDTH

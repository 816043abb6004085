// Tangent-space normals: from a texel of a normal map to a vector, and two maps into one. In tangent space x points
// along +u, y along +v and z out of the surface; (0, 0, 1) is the surface's own normal. Names and formulae of Unity's
// UnityStandardUtils.cginc (MIT) where Unity has the function; what has no Unity name says where it comes from.
#pragma once

#include "relief/hlsl/intrinsics.h"

namespace relief::inline RELIEF_WIDTH {

namespace detail {

// A scale that nothing overflows with: NaN becomes 0, and beyond +-1e15 nothing changes, because z is 0 long before.
inline Float usableScale(Float scale)
{
    return clamp(select(isnan(scale), Float(0.0f), scale), -1e15f, 1e15f);
}

}  // namespace detail

// Decodes a DXT5nm texel: x in alpha, y in green, both as code * 2 - 1, scaled by bumpScale; z from x^2 + y^2 + z^2
// = 1. Where x and y alone are longer than 1, from filtering, rounding or the scale, z is 0: the result is then not of
// unit length, and whoever uses it normalises. bumpScale 0 gives exactly (0, 0, 1).
inline float3 UnpackScaleNormal(const float4& packednormal, Float bumpScale)
{
    const Float scale = detail::usableScale(bumpScale);
    const Float x = (packednormal.w * 2.0f - 1.0f) * scale;
    const Float y = (packednormal.y * 2.0f - 1.0f) * scale;
    return {x, y, sqrt(1.0f - saturate(x * x + y * y))};
}

// The same for maps that are stored as RGB. Scaled as above and of unit length; z below 0, which no bump has, is 0.
inline float3 UnpackScaleNormalRGB(const float4& packednormal, Float bumpScale)
{
    const Float scale = detail::usableScale(bumpScale);
    const float3 n = {(packednormal.x * 2.0f - 1.0f) * scale, (packednormal.y * 2.0f - 1.0f) * scale,
                      max(packednormal.z * 2.0f - 1.0f, Float(0.0f))};
    const float3 unit = normalize(n);
    return select(dot(unit, unit) > 0.0f, unit, float3(0, 0, 1));
}

// --- two normals into one; all results have unit length ---

// Whiteout blending (Christopher Oat, SIGGRAPH 2007): x and y added, z multiplied. Where one map is flat, the other one
// is kept as it is; on slopes it exaggerates.
inline float3 BlendNormals(const float3& n1, const float3& n2)
{
    return normalize(float3(n1.x + n2.x, n1.y + n2.y, n1.z * n2.z));
}

// The mean, which flattens both. Opposite normals have none: n1 stays.
inline float3 BlendNormalsAverage(const float3& n1, const float3& n2)
{
    const float3 sum = n1 + n2;
    const float3 mean = normalize(sum);
    return select(dot(mean, mean) > 0.0f, mean, n1);
}

// Partial derivatives added: the normal of the two height fields' sum, n1.xy / n1.z + n2.xy / n2.z, multiplied by
// n1.z * n2.z so that nothing is divided. The limit where one z is 0; the sum of both slopes where both are.
inline float3 BlendNormalsDerivative(const float3& n1, const float3& n2)
{
    const Mask bothUpright = (n1.z == 0.0f) & (n2.z == 0.0f);
    const Float w1 = select(bothUpright, Float(1.0f), n2.z), w2 = select(bothUpright, Float(1.0f), n1.z);
    return normalize(float3(n1.x * w1 + n2.x * w2, n1.y * w1 + n2.y * w2, n1.z * n2.z));
}

// UDN (Unreal Developer Network): the detail's slope added to the base n1. A flat detail keeps the base; a flat base
// does not quite keep the detail.
inline float3 BlendNormalsUDN(const float3& n1, const float3& n2)
{
    return normalize(float3(n1.x + n2.x, n1.y + n2.y, n1.z));
}

// Reoriented normal mapping (Barre-Brisebois and Hill, "Blending in Detail", 2012): turns n2 by the rotation that takes
// (0, 0, 1) to n1. Both are to be of unit length. That rotation is not defined at n1 = (0, 0, -1); from 2^-12 of it on
// the one about the x axis is taken.
inline float3 BlendNormalsRNM(const float3& n1, const float3& n2)
{
    const float3 t = n1 + float3(0, 0, 1);
    const float3 u = n2 * float3(-1, -1, 1);
    const Mask below = t.z < 0.000244140625f;
    const Float scale = dot(t, u) / select(below, Float(1.0f), t.z);
    return normalize(select(below, float3(n2.x, -n2.y, -n2.z), t * scale - u));
}

}  // namespace relief::inline RELIEF_WIDTH

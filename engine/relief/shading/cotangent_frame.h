// Tangent space without tangents: which way u and v grow along the surface, from how position and uv change from pixel
// to pixel (Christian Schueler, "Followup: Normal Mapping Without Precomputed Tangents", 2013). To be called for all
// pixels of a quad. The frame is that of the triangle, so flat triangles may show.
#pragma once

#include "relief/hlsl/derivatives.h"
#include "relief/hlsl/intrinsics.h"

namespace relief::inline RELIEF_WIDTH {

// The gradients of u and v along the surface, per unit of position, and the normal: the columns of the matrix that
// takes a normal of the map to the space of `position` and `normal`. They are longer the more often the texture
// repeats, and need not be perpendicular: a stretched texture has flatter bumps. `normal` is to be of unit length.
//
// Flipping the picture upside down changes nothing, because the derivatives are divided by the area that they span,
// which changes its sign with them. (0, 0, normal) where there is no frame: position or uv constant, or u and v in
// step.
inline float3x3 cotangent_gradients(const float3& normal, const float3& position, const float2& uv)
{
    const float3 dp1 = ddx(position), dp2 = ddy(position);
    const float2 duv1 = ddx(uv), duv2 = ddy(uv);

    // T is perpendicular to the normal, with dot(T, dp1) = duv1.x and dot(T, dp2) = duv2.x; B the same for v.
    const float3 dp2perp = cross(dp2, normal);
    const float3 dp1perp = cross(normal, dp1);
    const Float area = dot(dp1, dp2perp);
    const float3 T = dp2perp * duv1.x + dp1perp * duv2.x;
    const float3 B = dp2perp * duv1.y + dp1perp * duv2.y;

    // Relative to what they are differences of, so that rounding alone makes no frame.
    const auto differs = [](Float difference, Float a, Float b) { return difference * difference > 1e-10f * (a * b); };
    const Mask exists = differs(duv1.x * duv2.y - duv1.y * duv2.x, dot(duv1, duv1), dot(duv2, duv2)) &
                        differs(area, dot(dp1, dp1), dot(dp2, dp2));
    const Float scale = 1.0f / area;
    return {select(exists, T * scale, float3(0.0f)), select(exists, B * scale, float3(0.0f)), normal};
}

// The same with the longer of the two of length 1: bumps as steep as in the map, however often it repeats.
inline float3x3 cotangent_frame(const float3& normal, const float3& position, const float2& uv)
{
    const float3x3 g = cotangent_gradients(normal, position, uv);
    const Float square = max(dot(g[0], g[0]), dot(g[1], g[1]));
    const Float invmax = select(square > 0.0f, rsqrt(square), Float(0.0f));
    return {g[0] * invmax, g[1] * invmax, normal};
}

// `bump`, of the normal map, on the surface; of unit length. Exactly `normal` where there is no frame.
inline float3 perturb_normal(const float3& bump, const float3& normal, const float3& position, const float2& uv)
{
    const float3x3 frame = cotangent_frame(normal, position, uv);
    const float3 perturbed = normalize(mul(frame, bump));
    const Mask exists = dot(frame[0], frame[0]) > 0.0f;
    return select(exists & (dot(perturbed, perturbed) > 0.0f), perturbed, normal);
}

}  // namespace relief::inline RELIEF_WIDTH

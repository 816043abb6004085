// Tangent space: the three directions that a normal map's x, y and z stand for at a point of a surface. The normal and
// the tangent come from the mesh; the binormal is computed, per vertex or per fragment (Rendering 6, 4.4).
//
// As MikkTSpace asks: unit vectors at the vertices, interpolated, and not made unit again before they are summed up.
#pragma once

#include "relief/hlsl/intrinsics.h"

namespace relief::inline RELIEF_WIDTH {

// cross(normal, tangent), turned to point along +v. binormalSign is tangent.w, worldTransformSign is
// unity_WorldTransformParams.w: -1 for an object that is mirrored. Both are -1 or +1; of anything else only the sign
// counts, and 0 counts as +1: a binormal must not shrink where a sign was interpolated across a mirrored seam.
inline float3 CreateBinormal(const float3& normal, const float3& tangent, Float binormalSign, Float worldTransformSign)
{
    return cross(normal, tangent) * (signNotZero(binormalSign) * signNotZero(worldTransformSign));
}

// From tangent space to the space that the three directions are in; of unit length, or the zero vector where the sum is
// zero. For a mesh without tangents, whose tangents are zero, it is the normal.
inline float3 TangentSpaceToWorld(const float3& tangentSpaceNormal, const float3& tangent, const float3& binormal,
                                  const float3& normal)
{
    return normalize(tangent * tangentSpaceNormal.x + binormal * tangentSpaceNormal.y + normal * tangentSpaceNormal.z);
}

// What a shader does that cleans its frame up in every fragment (Unity's UNITY_TANGENT_ORTHONORMALIZE): both of unit
// length, and at a right angle. A normal map that was baked for MikkTSpace is then decoded in another frame than its
// own.
inline void Orthonormalise(float3& normal, float3& tangent)
{
    normal = normalize(normal);
    tangent = normalize(tangent - normal * dot(normal, tangent));
}

// A unit tangent that is perpendicular to a unit normal where the given one is of no use: zero, not a number, or within
// 1e-3 rad of the normal. The substitute is Duff et al.'s branch-free basis (JCGT 2017). Elsewhere `tangent`,
// orthonormalised. For meshes of unknown origin; the tutorials' stages do not need it.
inline float3 SafeTangent(const float3& normal, const float3& tangent)
{
    const float3 direction = normalize(tangent);
    const float3 flat = direction - normal * dot(normal, direction);
    const Float s = signNotZero(normal.z);
    const Float a = -1.0f / (s + normal.z);
    const float3 basis = {1.0f + s * normal.x * normal.x * a, s * normal.x * normal.y * a, -s * normal.x};
    return normalize(select(dot(flat, flat) > 1e-6f, flat, basis));
}

}  // namespace relief::inline RELIEF_WIDTH

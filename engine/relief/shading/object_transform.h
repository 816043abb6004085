// From object space: the matrices of one object, under the names that products cancel by, and Unity's helper functions
// on them. Positions and directions use the matrix itself; normals use its cofactor matrix, which keeps them
// perpendicular under any scale, needs no division, and is right for singular and mirrored matrices too.
#pragma once

#include <glm/mat4x4.hpp>

#include "relief/hlsl/intrinsics.h"

namespace relief::inline RELIEF_WIDTH {

struct ObjectTransform
{
    float4x4 clipFromObject;
    float4x4 worldFromObject;
    float3x3 normalFromObject;  // sign(det M) * cofactor(M) of the upper 3x3 of worldFromObject

    // Unity's: w is -1 for a mirrored object (an odd number of negative scales), and 1 otherwise. Nothing else is used.
    float4 unity_WorldTransformParams;

    ObjectTransform() = default;
    ObjectTransform(const glm::mat4& clipFromWorld, const glm::mat4& worldFromObject);
};

// -1 for a matrix that mirrors (a negative determinant), 1 for any other: unity_WorldTransformParams.w.
float mirrorSign(const glm::mat4& m);

// The cofactor matrix of m times the sign of its determinant (+1 where that is 0). Its columns are cross products of
// m's columns: it equals |det m| * transpose(inverse(m)) wherever the inverse exists. Where a product of four of m's
// numbers, as a normal's square is, might leave the range of floats, it is that times a power of two.
glm::mat3 normalMatrix(const glm::mat3& m);

inline float4 UnityObjectToClipPos(const ObjectTransform& object, const float4& position)
{
    return mul(object.clipFromObject, position);
}

// A unit vector.
inline float3 UnityObjectToWorldNormal(const ObjectTransform& object, const float3& normal)
{
    return normalize(mul(object.normalFromObject, normal));
}

// A unit vector.
inline float3 UnityObjectToWorldDir(const ObjectTransform& object, const float3& direction)
{
    return normalize(mul(upper3x3(object.worldFromObject), direction));
}

}  // namespace relief::inline RELIEF_WIDTH

// From object space: the matrices of one object, under the names that products cancel by, and Unity's helper functions
// on them. Positions and directions use the matrix itself; normals use its cofactor matrix, which keeps them
// perpendicular under any scale, needs no division, and is right for singular and mirrored matrices too.
#pragma once

#include "hlsl/intrinsics.h"

namespace relief {

struct ObjectTransform
{
    float4x4 clipFromObject;
    float4x4 worldFromObject;
    float3x3 normalFromObject;  // sign(det M) * cofactor(M) of the upper 3x3 of worldFromObject

    ObjectTransform() = default;
    ObjectTransform(const glm::mat4& clipFromWorld, const glm::mat4& worldFromObject);
};

// The cofactor matrix of m times the sign of its determinant (+1 where that is 0). Its columns are cross products of
// m's columns: it equals |det m| * transpose(inverse(m)) wherever the inverse exists.
inline glm::mat3 normalMatrix(const glm::mat3& m)
{
    const auto crossed = [](const glm::vec3& a, const glm::vec3& b) {
        return glm::vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    };
    const glm::vec3 c0 = crossed(m[1], m[2]);
    const float determinant = m[0].x * c0.x + m[0].y * c0.y + m[0].z * c0.z;
    const float sign = determinant < 0.0f ? -1.0f : 1.0f;
    return {c0 * sign, crossed(m[2], m[0]) * sign, crossed(m[0], m[1]) * sign};
}

inline ObjectTransform::ObjectTransform(const glm::mat4& clipFromWorld, const glm::mat4& world)
    : clipFromObject(broadcast(clipFromWorld * world)),
      worldFromObject(broadcast(world)),
      normalFromObject(broadcast(normalMatrix(glm::mat3(world))))
{
}

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

}  // namespace relief

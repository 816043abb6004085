// HLSL's types on lanes: float2 ... float4, int2 ... int4, bool2 ... bool4, float3x3 and float4x4; and the way between
// them and GLM's plain vectors and matrices, which the side of the CPU computes with.
#pragma once

#include "relief/hlsl/matrix.h"
#include "relief/hlsl/vector.h"

#if defined(GLM_FORCE_INTRINSICS) || defined(GLM_FORCE_DEFAULT_ALIGNED_GENTYPES)
#error "GLM's intrinsics bring an approximate rsqrt, whose bits differ between processors: do not define them"
#endif

namespace relief::inline RELIEF_WIDTH {

template <int size>
using FloatN = LaneVector<Float, size>;

using float2 = LaneVector<Float, 2>;
using float3 = LaneVector<Float, 3>;
using float4 = LaneVector<Float, 4>;
using int2 = LaneVector<Int, 2>;
using int3 = LaneVector<Int, 3>;
using int4 = LaneVector<Int, 4>;
using bool2 = LaneVector<Mask, 2>;
using bool3 = LaneVector<Mask, 3>;
using bool4 = LaneVector<Mask, 4>;
using float3x3 = LaneMatrix<3>;
using float4x4 = LaneMatrix<4>;

// A uniform: the same plain value in every lane.
inline float2 broadcast(const glm::vec2& v)
{
    return v;
}
inline float3 broadcast(const glm::vec3& v)
{
    return v;
}
inline float4 broadcast(const glm::vec4& v)
{
    return v;
}
inline float3x3 broadcast(const glm::mat3& m)
{
    return m;
}
inline float4x4 broadcast(const glm::mat4& m)
{
    return m;
}

// Back again: of a uniform, in which all lanes are the same.
inline glm::vec2 firstLane(const float2& v)
{
    return {v.x[0], v.y[0]};
}
inline glm::vec3 firstLane(const float3& v)
{
    return {v.x[0], v.y[0], v.z[0]};
}
inline glm::vec4 firstLane(const float4& v)
{
    return {v.x[0], v.y[0], v.z[0], v.w[0]};
}
inline glm::mat3 firstLane(const float3x3& m)
{
    return {firstLane(m[0]), firstLane(m[1]), firstLane(m[2])};
}
inline glm::mat4 firstLane(const float4x4& m)
{
    return {firstLane(m[0]), firstLane(m[1]), firstLane(m[2]), firstLane(m[3])};
}

}  // namespace relief::inline RELIEF_WIDTH

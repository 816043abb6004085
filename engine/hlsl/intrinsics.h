// HLSL's intrinsic functions on lanes, under their HLSL names: all of them. docs/porting.md lists which there are.
//
//     lanes/float.h, lanes/math.h       of one value: min, abs, floor, sqrt; exp2, log2, pow, sin
//     hlsl/scalar_intrinsics.h          of one value: lerp, step, smoothstep
//     hlsl/vector_intrinsics.h          the same of each component; dot, length, normalize, reflect
//     hlsl/matrix.h                     mul, transpose
//     hlsl/derivatives.h                ddx, ddy
#pragma once

#include "hlsl/scalar_intrinsics.h"
#include "hlsl/types.h"
#include "hlsl/vector_intrinsics.h"

namespace relief {

inline float3 cross(const float3& a, const float3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// HLSL: (float3x3)m
inline float3x3 upper3x3(const float4x4& m)
{
    return float3x3(m);
}

}  // namespace relief

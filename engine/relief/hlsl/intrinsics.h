// HLSL's intrinsic functions on lanes, under their HLSL names: all of them. docs/porting.md lists which there are.
//
//     lanes/float.h, lanes/math.h       of one value: min, abs, floor, sqrt; exp2, log2, pow, sin
//     hlsl/scalar_intrinsics.h          of one value: lerp, step, smoothstep, fmod
//     hlsl/vector_intrinsics.h          the same of each component; dot, length, normalize, reflect
//     hlsl/matrix.h                     mul, transpose, determinant
//     hlsl/derivatives.h                ddx, ddy, fwidth
#pragma once

#include "relief/hlsl/derivatives.h"
#include "relief/hlsl/scalar_intrinsics.h"
#include "relief/hlsl/types.h"
#include "relief/hlsl/vector_intrinsics.h"

namespace relief::inline RELIEF_WIDTH {

inline float3 cross(const float3& a, const float3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The light of a surface, as Direct3D 9's hardware had it: (ambient, diffuse, specular, 1).
inline float4 lit(Float NdotL, Float NdotH, Float shininess)
{
    const Mask dark = (NdotL < 0.0f) | (NdotH < 0.0f);
    return {1.0f, max(NdotL, Float(0.0f)), select(dark, Float(0.0f), pow(NdotH, shininess)), 1.0f};
}

// Attenuation's distances of the same age: a = (?, d^2, d^2, ?) and b = (?, 1/d, ?, 1/d) make (1, d, d^2, 1/d).
inline float4 dst(const float4& a, const float4& b)
{
    return {1.0f, a.y * b.y, a.z, b.w};
}

// HLSL: (float3x3)m
inline float3x3 upper3x3(const float4x4& m)
{
    return float3x3(m);
}

}  // namespace relief::inline RELIEF_WIDTH

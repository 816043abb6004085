// Normals of any direction as few numbers: what a deferred renderer writes into a target of bytes. In tangent space,
// where z is known to be positive, normals.h has the usual forms.
//
// How far off a whole picture is with each of them, and what they cost: docs/report/error/E-37.md.
#pragma once

#include "relief/hlsl/intrinsics.h"

namespace relief::inline RELIEF_WIDTH {

// The sphere of directions as a square: an octahedron, its lower half folded outwards (Cigolle et al., "A Survey of
// Efficient Representations for Independent Unit Vectors", 2014). In goes a vector of any length, out come two numbers
// of 0..1; of no direction at all they are those of +z.
inline float2 octahedralOf(const float3& n)
{
    const Float sum = abs(n.x) + abs(n.y) + abs(n.z);
    const float3 p = n / select(sum > 0.0f, sum, Float(1.0f));
    const float2 folded = {(1.0f - abs(p.y)) * signNotZero(p.x), (1.0f - abs(p.x)) * signNotZero(p.y)};
    return select(p.z < 0.0f, folded, p.xy()) * 0.5f + 0.5f;
}

// And back: of unit length, for any two numbers.
inline float3 fromOctahedral(const float2& square)
{
    const float2 p = square * 2.0f - 1.0f;
    const Float z = 1.0f - abs(p.x) - abs(p.y);
    const float2 folded = {(1.0f - abs(p.y)) * signNotZero(p.x), (1.0f - abs(p.x)) * signNotZero(p.y)};
    return normalize(float3(select(z < 0.0f, folded, p), z));
}

// Two numbers of 0..1, each to the nearest of 4096, in three channels of 8 bits; and back.
inline float3 packedTwelve(const float2& v)
{
    const float2 code = floor(saturate(v) * 4095.0f + 0.5f);
    const Float high = floor(code.x / 16.0f), low = floor(code.y / 256.0f);
    return float3(high, (code.x - high * 16.0f) * 16.0f + low, code.y - low * 256.0f) / 255.0f;
}
inline float2 unpackedTwelve(const float3& bytes)
{
    const float3 code = floor(bytes * 255.0f + 0.5f);
    const Float low = floor(code.y / 16.0f);
    return float2(code.x * 16.0f + low, (code.y - low * 16.0f) * 256.0f + code.z) / 4095.0f;
}

// The same with 65536 each, in four channels.
inline float4 packedSixteen(const float2& v)
{
    const float2 code = floor(saturate(v) * 65535.0f + 0.5f), high = floor(code / 256.0f), low = code - high * 256.0f;
    return float4(high.x, low.x, high.y, low.y) / 255.0f;
}
inline float2 unpackedSixteen(const float4& bytes)
{
    const float4 code = floor(bytes * 255.0f + 0.5f);
    return float2(code.x * 256.0f + code.y, code.z * 256.0f + code.w) / 65535.0f;
}

}  // namespace relief::inline RELIEF_WIDTH

// Samplers of cube maps, under HLSL's names: one direction per lane in, one linear colour per lane out.
//
// A direction has any length and is in the space that the cube map is in, the world's mostly: left-handed, y up. A NaN
// component counts as 0, an infinite one as the largest number of its sign, and no direction at all, (0, 0, 0), is +z.
// Of edges between faces nothing is seen (cube_map.h): the filters go on around them. Without `seamless` they end where
// a face ends, as hardware's did before Direct3D 10.
#pragma once

#include "relief/texture/cube_map.h"
#include "relief/texture/sampler.h"

namespace relief::inline RELIEF_WIDTH {

struct samplerCUBE
{
    const CubeMap* texture = nullptr;  // not owned; a null cube map is white
    Filter filter = Filter::trilinear;
    bool mipmaps = true;     // false: level 0 alone, and no derivatives are taken
    float lodBias = 0.0f;    // with the bias of texCUBEbias limited to -16..15.99
    float minLod = 0.0f;     // wins where it is above maxLod
    float maxLod = 1000.0f;  // beyond every level
    bool seamless = true;    // false: each face is a picture of its own, clamped at its edges
};

namespace detail {

// Single lanes as parameters travel in registers. See sampler.cpp for the reference.
void sampleCube(float4& result, const samplerCUBE& s, Float x, Float y, Float z, Float bias);

}  // namespace detail

// The colour in a direction. The level of detail comes from the differences to the neighbouring pixels' directions,
// projected onto the face that the lane's own direction passes through: it is right across edges, too. All lanes of a
// quad must get here together, as in tex2D.
inline float4 texCUBE(const samplerCUBE& s, const float3& direction)
{
    float4 color;
    detail::sampleCube(color, s, direction.x, direction.y, direction.z, 0.0f);
    return color;
}

// With the direction's change per pixel given, to the right and down.
float4 texCUBEgrad(const samplerCUBE& s, const float3& direction, const float3& dx, const float3& dy);

// In the direction directionLod.xyz on level directionLod.w (the sampler's limits and bias apply).
float4 texCUBElod(const samplerCUBE& s, const float4& directionLod);

// texCUBE in the direction directionBias.xyz with directionBias.w added to the level of detail.
inline float4 texCUBEbias(const samplerCUBE& s, const float4& directionBias)
{
    float4 color;
    detail::sampleCube(color, s, directionBias.x, directionBias.y, directionBias.z, directionBias.w);
    return color;
}

}  // namespace relief::inline RELIEF_WIDTH

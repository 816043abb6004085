// The steps of a cube map's sample: the face, the place on it, the level of detail, and the filters that textures have,
// too (filter.h). All lanes fetch at once, whatever face each is on: the faces of a level are one block of memory.
#include "relief/texture/cube_sampler.h"

#include "relief/hlsl/derivatives.h"
#include "relief/texture/cube_place.h"

namespace relief::inline RELIEF_WIDTH {
namespace {

template <class Fetch>
[[gnu::noinline]] float4 sampleIn(const CubePlace& place, Int lod)
{
    return Fetch::toUnit(sampleMipLevels<Fetch>(place, lod, lod[0] >> kLodBits));
}

[[gnu::always_inline]] inline float4 sampleAtLevel(const samplerCUBE& s, const Meeting& at, Float lod)
{
    const CubeMap& texture = textureOf(s);
    const Int fixed = usesMipLevels(s) ? fixedLevel(s, texture.levelCount(), lod) : Int(0);
    countSample(s);
    countOneLevel(s, (fixed == 0).bits(), lanesOnOneLevel(fixed) & kAllLanes);
    if ((shading.activeLanes & kWatched) != 0) noteLevels(s, fixed);

    const CubePlace place = placeOn(s, at);
    return withFetch(texture.format(), [&]<class Fetch>() { return sampleIn<Fetch>(place, fixed); });
}

[[gnu::always_inline]] inline float4 sampleByChange(const samplerCUBE& s, const float3& direction, const float3& dx,
                                                    const float3& dy, Float bias)
{
    const Meeting at(direction);
    return sampleAtLevel(s, at, levelByChange(s, at, dx, dy, bias));
}

[[gnu::always_inline]] inline float4 sampleByDifferences(const samplerCUBE& s, const float3& direction, Float bias)
{
    const float3 d = finiteDirection(direction);
    if (usesMipLevels(s)) return sampleByChange(s, d, ddx(d), ddy(d), bias);
    countNoDerivatives();
    return sampleAtLevel(s, Meeting(d), Float(0.0f));
}

}  // namespace

float4 texCUBE(const samplerCUBE& s, const float3& direction)
{
    return sampleByDifferences(s, direction, 0.0f);
}

float4 texCUBEbias(const samplerCUBE& s, const float4& directionBias)
{
    return sampleByDifferences(s, directionBias.xyz(), directionBias.w);
}

float4 texCUBEgrad(const samplerCUBE& s, const float3& direction, const float3& dx, const float3& dy)
{
    countNoDerivatives();
    return sampleByChange(s, finiteDirection(direction), dx, dy, 0.0f);
}

float4 texCUBElod(const samplerCUBE& s, const float4& directionLod)
{
    countNoDerivatives();
    return sampleAtLevel(s, Meeting(finiteDirection(directionLod.xyz())), directionLod.w + limitBias(s, 0.0f));
}

}  // namespace relief::inline RELIEF_WIDTH

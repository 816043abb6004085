// The steps of a cube map's sample: the face, the place on it, the level of detail, and the filters that textures have,
// too (filter.h). All lanes fetch at once, whatever face each is on: the faces of a level are one block of memory.
#include "relief/texture/cube_sampler.h"

#include "relief/hlsl/derivatives.h"
#include "relief/texture/cube_place.h"

namespace relief::inline RELIEF_WIDTH {
namespace {

template <class Fetch>
[[gnu::noinline]] void sampleIn(float4& result, const samplerCUBE& s, const CubeMap& texture, Float u, Float v,
                                Int face, Int lod, int guess)
{
    result = Fetch::toUnit(sampleMipLevels<Fetch>(CubePlace{s, texture, u, v, face}, lod, guess));
}

[[gnu::always_inline]] inline void sampleAtLevel(float4& result, const samplerCUBE& s, const CubeMap& texture,
                                                 const Meeting& at, Int fixed, int guess)
{
    countSample(s);
    countOneLevel(s, (fixed == 0).bits(), lanesOnOneLevel(fixed) & kAllLanes);
    if ((shading.activeLanes & kWatched) != 0) noteLevels(s, fixed);

    const CubePlace place = placeOn(s, texture, at);
    withFetch(texture.format(),
              [&]<class Fetch>() { sampleIn<Fetch>(result, s, texture, place.u, place.v, place.face, fixed, guess); });
}

inline void sampleFinest(float4& result, const samplerCUBE& s, const CubeMap& texture, const Meeting& at)
{
    sampleAtLevel(result, s, texture, at, 0, 0);
}

[[gnu::always_inline]] inline void sampleByChange(float4& result, const samplerCUBE& s, const CubeMap& texture,
                                                  const Meeting& at, const float3& dx, const float3& dy, Float bias)
{
    const Float square = squareOfChange(texture, at, dx, dy);
    const Float lod = limitedIsotropicLevel(square) + limitBias(s, bias);
    sampleAtLevel(result, s, texture, at, fixedLevel(s, texture.levelCount(), lod),
                  likelyLevel(s, texture.levelCount(), square));
}

}  // namespace

void detail::sampleCube(float4& result, const samplerCUBE& s, Float x, Float y, Float z, Float bias)
{
    const CubeMap& texture = textureOf(s);
    const float3 direction = finiteDirection({x, y, z});
    const Meeting at(direction);
    if (usesMipLevels(s, texture)) return sampleByChange(result, s, texture, at, ddx(direction), ddy(direction), bias);
    countNoDerivatives();
    sampleFinest(result, s, texture, at);
}

float4 texCUBEgrad(const samplerCUBE& s, const float3& direction, const float3& dx, const float3& dy)
{
    const CubeMap& texture = textureOf(s);
    const Meeting at(finiteDirection(direction));
    countNoDerivatives();
    float4 color;
    if (usesMipLevels(s, texture)) {
        sampleByChange(color, s, texture, at, dx, dy, 0.0f);
    } else {
        sampleFinest(color, s, texture, at);
    }
    return color;
}

float4 texCUBElod(const samplerCUBE& s, const float4& directionLod)
{
    const CubeMap& texture = textureOf(s);
    const Meeting at(finiteDirection(directionLod.xyz()));
    const Float lod = directionLod.w + limitBias(s, 0.0f);
    const bool choosesLevel = usesMipLevels(s, texture);
    countNoDerivatives();
    float4 color;
    sampleAtLevel(color, s, texture, at, choosesLevel ? fixedLevel(s, texture.levelCount(), lod) : Int(0), 0);
    return color;
}

}  // namespace relief::inline RELIEF_WIDTH

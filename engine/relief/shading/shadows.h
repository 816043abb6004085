// The share of light that arrives at a point, from a shadow map: depths as the light sees them
// (pipeline/target_texture.h). uv is where the point is on the map, and depth how far it is from the light there, in
// the map's own units: with p the point in the light's clip space, p.xy * 0.5 + 0.5 and p.z. What the map does not hold
// is lit where its sampler has a border of 1, and so it is by default.
//
// How far off each filter is with which bias, and what it costs: docs/report/error/E-36.md.
#pragma once

#include "relief/texture/comparison_sampler.h"
#include "relief/texture/sampler.h"

namespace relief::inline RELIEF_WIDTH {

// Yes or no, by the one texel that `nearest` gives (Williams 1978). The sampler is to have no mipmaps: the mean of two
// depths is the depth of nothing.
inline Float shadowOfOneTexel(const sampler2D& nearest, const float2& uv, Float depth)
{
    return select(depth <= tex2D(nearest, uv).x, Float(1.0f), Float(0.0f));
}

// The mean of taps * taps comparisons of 2x2 texels each, a texel from one to the next (Reeves et al. 1987). One tap is
// SampleCmp itself.
template <int taps>
Float filteredShadow(const SamplerComparisonState& map, const float2& uv, Float depth)
{
    static_assert(taps >= 1);
    const glm::vec4 size = map.texture != nullptr ? map.texture->texelSize() : glm::vec4(1.0f);
    const float2 texel = {Float(size.x), Float(size.y)};
    Float sum = 0.0f;
    for (int y = 0; y < taps; ++y) {
        for (int x = 0; x < taps; ++x) {
            const float2 aside = {Float(static_cast<float>(x)), Float(static_cast<float>(y))};
            sum += SampleCmp(map, uv + (aside - static_cast<float>(taps - 1) * 0.5f) * texel, depth);
        }
    }
    return sum / static_cast<float>(taps * taps);
}

}  // namespace relief::inline RELIEF_WIDTH

#include "relief/texture/comparison_sampler.h"

#include "relief/texture/sampler_steps.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

using Square = FetchR32Float::Square;

template <class Fetch>
Square squareAt(const Place<AnyModes>& place, const MipLevel& level, const Pairs& at)
{
    if (hasBorder(place.modes)) {
        const Mask inside = (at.x >= 1) & (at.x < level.width()) & (at.y >= 1) & (at.y < level.height());
        if ((inside.bits() & shading.activeLanes) != shading.activeLanes) {
            const auto red = [&](Int x, Int y) {
                return Fetch::toUnit(texelOrBorder<Fetch>(place.sampler, level, x, y)).x;
            };
            return {red(at.x, at.y), red(at.x + 1, at.y), red(at.x, at.y + 1), red(at.x + 1, at.y + 1)};
        }
    }
    // Lanes that nobody asks for may lie outside.
    const Int x = clamp(at.x, 0, level.width()), y = clamp(at.y, 0, level.height());
    const Int index = texelIndex(level, x, y);
    if constexpr (std::is_same_v<Fetch, FetchR32Float>) {
        return Fetch::square(level, index);
    } else {
        const auto red = [&](int offset) { return Fetch::toUnit(Fetch::nearest(level, index + offset)).x; };
        const int row = level.rowTexels();
        return {red(0), red(1), red(row), red(row + 1)};
    }
}

template <class Fetch>
Float compareIn(const SamplerComparisonState& s, const sampler2D& plain, const float2& uv, Float reference)
{
    const Place<AnyModes> place = placeOn<AnyModes>(plain, *plain.texture, uv.x, uv.y);
    const MipLevel& level = plain.texture->level(0);
    const Pairs at = pairsOn(place, level);
    const Square texels = squareAt<Fetch>(place, level, at);
    const auto passes = [&](Float texel) {
        return select(compareBy(s.comparison, reference, texel), Float(1.0f), Float(0.0f));
    };
    const Float tx = Float(at.fx) * (1.0f / kSubtexels), ty = Float(at.fy) * (1.0f / kSubtexels);
    const Float lower = detail::mix(passes(texels.lowerLeft), passes(texels.lowerRight), tx);
    const Float upper = detail::mix(passes(texels.upperLeft), passes(texels.upperRight), tx);
    return detail::mix(lower, upper, ty);
}

}  // namespace

Float SampleCmp(const SamplerComparisonState& s, const float2& uv, Float reference)
{
    const Texture& texture = s.texture != nullptr ? *s.texture : Texture::white();
    sampler2D plain = {&texture, Filter::bilinear, s.u, s.v};
    plain.borderColor = glm::vec4(s.border);
    countSample(plain);
    countOneLevel(plain, kAllLanes, kAllLanes);
    countNoDerivatives();
    return withFetch(texture.format(), [&]<class Fetch>() { return compareIn<Fetch>(s, plain, uv, reference); });
}

Float SampleCmp(const SamplerCubeComparisonState& s, const float3& direction, Float reference)
{
    const CubeFaceOf at(direction);
    const float3 place = at.components(direction);
    const float2 uv = float2(place.x / place.z, place.y / place.z) * 0.5f + 0.5f;
    const unsigned outside = shading.activeLanes;
    Float share = 0.0f;
    for (int face = 0; face < kCubeFaces; ++face) {
        const Mask here = at.face() == face;
        shading.activeLanes = outside & (here.bits() | kWatched);
        if ((shading.activeLanes & kAllLanes) == 0) continue;
        const SamplerComparisonState one = {s.faces[static_cast<std::size_t>(face)], s.comparison, AddressMode::clamp,
                                            AddressMode::clamp};
        share = select(here, SampleCmp(one, uv, reference), share);
    }
    shading.activeLanes = outside;
    return share;
}

}  // namespace relief::inline RELIEF_WIDTH

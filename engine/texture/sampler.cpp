// The steps of a texture sample: level of detail, distinct levels in the block, texels, filter. The common case, every
// lane on one level, goes straight through; a block that spans several levels runs once per level.
#include "texture/sampler.h"

#include <algorithm>
#include <bit>

#include "hlsl/derivatives.h"
#include "lanes/active.h"
#include "texture/fetch.h"
#include "texture/level_of_detail.h"

namespace relief {
namespace {

// Levels of detail are fixed point with 8 bits of fraction, D3D's least (7.18.10).
constexpr int kLodBits = 8;
constexpr int kLodOne = 1 << kLodBits;

// Where to sample, after range reduction: the same for every level.
struct Place
{
    const sampler2D& sampler;
    const Texture& texture;
    Float u, v;
};

Place placeOf(const sampler2D& s, const Texture& texture, const float2& uv)
{
    return {s, texture, reduceRange(s.u, uv.x), reduceRange(s.v, uv.y)};
}

const Texture& textureOf(const sampler2D& s)
{
    return s.texture ? *s.texture : Texture::white();
}

bool hasBorder(const sampler2D& s)
{
    return s.u == AddressMode::border || s.v == AddressMode::border;
}

// The lanes that results are wanted for. A block without any still gets some values.
unsigned wantedLanes()
{
    return activeLanes != 0 ? activeLanes : 1u;
}

// --- one level ---

// A texel by its position (see address.h), or the border's colour where an axis in border mode leaves the texture.
template <class Fetch>
float4 texelOrBorder(const Place& place, const MipLevel& level, Int x, Int y)
{
    const sampler2D& s = place.sampler;
    Mask outside = false;
    if (s.u == AddressMode::border) outside |= (x < 1) | (x > level.width());
    if (s.v == AddressMode::border) outside |= (y < 1) | (y > level.height());
    const Int column = clamp(x, 0, level.width() + 1), row = clamp(y, 0, level.height() + 1);
    const float4 texel = Fetch::nearest(level, row * level.rowTexels() + column);
    float4 result;
    for (int c = 0; c < 4; ++c) result[c] = select(outside, Float(s.borderColor[c] * Fetch::kOne[c]), texel[c]);
    return result;
}

template <class Fetch>
float4 sampleNearest(const Place& place, const MipLevel& level)
{
    const Int x = nearestPosition(place.sampler.u, place.u, level.width(), level.widthInFloat());
    const Int y = nearestPosition(place.sampler.v, place.v, level.height(), level.heightInFloat());
    if (hasBorder(place.sampler)) [[unlikely]]
        return texelOrBorder<Fetch>(place, level, x, y);
    return Fetch::nearest(level, y * level.rowTexels() + x);
}

template <class Fetch>
float4 mixEach(const float4& a, const float4& b, Float t)
{
    return {Fetch::mix(a.x, b.x, t), Fetch::mix(a.y, b.y, t), Fetch::mix(a.z, b.z, t), Fetch::mix(a.w, b.w, t)};
}

template <class Fetch>
float4 sampleBilinear(const Place& place, const MipLevel& level)
{
    const Int positionX = pairPosition(place.sampler.u, place.u, level.width(), level.widthInFloat());
    const Int positionY = pairPosition(place.sampler.v, place.v, level.height(), level.heightInFloat());
    const Int x = positionX >> kSubtexelBits, y = positionY >> kSubtexelBits;
    const Float fx = Float(positionX & kSubtexelMask) * (1.0f / kSubtexels);
    const Float fy = Float(positionY & kSubtexelMask) * (1.0f / kSubtexels);
    if (!hasBorder(place.sampler)) [[likely]]
        return Fetch::bilinear(level, y * level.rowTexels() + x, fx, fy);

    const float4 lower =
        mixEach<Fetch>(texelOrBorder<Fetch>(place, level, x, y), texelOrBorder<Fetch>(place, level, x + 1, y), fx);
    const float4 upper = mixEach<Fetch>(texelOrBorder<Fetch>(place, level, x, y + 1),
                                        texelOrBorder<Fetch>(place, level, x + 1, y + 1), fx);
    return mixEach<Fetch>(lower, upper, fy);
}

template <class Fetch>
float4 sampleLevel(const Place& place, const MipLevel& level)
{
    return place.sampler.filter == Filter::nearest ? sampleNearest<Fetch>(place, level)
                                                   : sampleBilinear<Fetch>(place, level);
}

// --- several levels ---

// Level k for all lanes, and with the trilinear filter the part of level k + 1 that `fraction` (0..255) says; `lanes`
// are those that the result is for.
template <class Fetch>
float4 sampleLevels(const Place& place, int k, Int fraction, unsigned lanes)
{
    const float4 finer = sampleLevel<Fetch>(place, place.texture.level(k));
    if (place.sampler.filter != Filter::trilinear || ((fraction != 0).bits() & lanes) == 0) return finer;
    const float4 coarser = sampleLevel<Fetch>(place, place.texture.level(k + 1));
    return mixEach<Fetch>(finer, coarser, Float(fraction) * (1.0f / kLodOne));
}

// Every lane on its own level, `lod` in 0..levels - 1 with kLodBits of fraction. One round per distinct level.
template <class Fetch>
float4 sampleMipChain(const Place& place, Int lod)
{
    const bool trilinear = place.sampler.filter == Filter::trilinear;
    const Int level = (trilinear ? lod : lod + kLodOne / 2) >> kLodBits;
    const Int fraction = lod & (kLodOne - 1);
    unsigned waiting = wantedLanes();
    const int firstLevel = level[std::countr_zero(waiting)];
    Mask here = level == firstLevel;
    const float4 first = sampleLevels<Fetch>(place, firstLevel, fraction, here.bits() & waiting);
    waiting &= ~here.bits();
    if (waiting == 0) [[likely]]
        return first;

    float4 result = first;
    while (waiting != 0) {
        const int nextLevel = level[std::countr_zero(waiting)];
        here = level == nextLevel;
        const float4 next = sampleLevels<Fetch>(place, nextLevel, fraction, here.bits() & waiting);
        for (int c = 0; c < 4; ++c) result[c] = select(here, next[c], result[c]);
        waiting &= ~here.bits();
    }
    return result;
}

// `lod` after bias, NaN included, to what sampleMipChain takes: limited to the levels that exist.
Int fixedLevel(const sampler2D& s, const Texture& texture, Float lod)
{
    const Float last = static_cast<float>(texture.levelCount() - 1);
    return roundToInt(clamp(limitLevel(lod, s.minLod, s.maxLod), 0.0f, last) * static_cast<float>(kLodOne));
}

// --- the format, chosen once per sample ---

template <class Function>
float4 withFormat(TexelFormat format, Function function)
{
    switch (format) {
        case TexelFormat::rgba8:
            return function(FetchRgba8{});
        case TexelFormat::rgba16:
            return function(FetchRgba16{});
        case TexelFormat::rgba32Float:
            return function(FetchRgba32Float{});
    }
    return float4(Float(0.0f));
}

float4 sampleFinest(const Place& place)
{
    return withFormat(place.texture.format(), [&](auto fetch) {
        using Fetch = decltype(fetch);
        return Fetch::toUnit(sampleLevel<Fetch>(place, place.texture.level(0)));
    });
}

float4 sampleAt(const Place& place, Int lod)
{
    return withFormat(place.texture.format(), [&](auto fetch) {
        using Fetch = decltype(fetch);
        return Fetch::toUnit(sampleMipChain<Fetch>(place, lod));
    });
}

// --- counting (see fetch_counters.h) ---

std::uint64_t countOf(unsigned lanes)
{
    return static_cast<std::uint64_t>(std::popcount(lanes));
}

bool isAnisotropic(const sampler2D& s)
{
    return s.maxAnisotropy > 1 && s.filter == Filter::trilinear;
}

void countSample(const sampler2D& s)
{
    const std::uint64_t n = countOf(activeLanes);
    if (isAnisotropic(s))
        fetchCounters.anisotropic += n;
    else if (s.filter == Filter::trilinear)
        fetchCounters.trilinear += n;
    else if (s.filter == Filter::bilinear)
        fetchCounters.bilinear += n;
    else
        fetchCounters.nearest += n;
}

void countLevels(const sampler2D& s, unsigned onFinest, unsigned onOneLevel)
{
    fetchCounters.magnified += countOf(onFinest & activeLanes);
    if (s.filter == Filter::trilinear) fetchCounters.secondLevelSkipped += countOf(onOneLevel & activeLanes);
}

// --- the kinds of sample ---

float4 sampleFinestCounted(const sampler2D& s, const Texture& texture, const float2& uv)
{
    countSample(s);
    countLevels(s, kAllLanes, kAllLanes);
    if (isAnisotropic(s)) fetchCounters.taps += countOf(activeLanes);
    return sampleFinest(placeOf(s, texture, uv));
}

float4 sampleIsotropic(const sampler2D& s, const Texture& texture, const float2& uv, Float lod)
{
    const Int fixed = fixedLevel(s, texture, lod);
    const unsigned onFinest = (fixed == 0).bits();
    countSample(s);
    countLevels(s, onFinest, ((fixed & (kLodOne - 1)) == 0).bits());
    if (isAnisotropic(s)) fetchCounters.taps += countOf(activeLanes);  // tex2Dlod
    const Place place = placeOf(s, texture, uv);
    return (wantedLanes() & ~onFinest) == 0 ? sampleFinest(place) : sampleAt(place, fixed);
}

// The average of the taps, which lie evenly on the footprint's axis: tap i of n at (2 i + 1 - n) / 2n of it. It is kept
// as a running mean, mean += (tap - mean) / (i + 1): equal taps give exactly themselves.
float4 sampleAnisotropic(const sampler2D& s, const Texture& texture, const float2& uv,
                         const AnisotropicFootprint& footprint, Float bias)
{
    const Int fixed = fixedLevel(s, texture, footprint.lod + bias);
    countSample(s);
    countLevels(s, (fixed == 0).bits(), ((fixed & (kLodOne - 1)) == 0).bits());
    const glm::vec4 size = texture.texelSize();
    const float2 axis = {footprint.axis.x * size.x, footprint.axis.y * size.y};
    const Float perTap = 0.5f / footprint.taps;

    float4 mean;
    for (int i = 0; i < 16; ++i) {
        const Mask hasTap = footprint.taps > static_cast<float>(i);
        const unsigned lanes = hasTap.bits() & wantedLanes();
        if (lanes == 0) break;
        fetchCounters.taps += countOf(lanes & activeLanes);
        const Float along = (static_cast<float>(2 * i + 1) - footprint.taps) * perTap;
        const float4 tap = sampleAt(placeOf(s, texture, uv + axis * along), fixed);
        if (i == 0) {
            mean = tap;
        } else {
            const float share = 1.0f / static_cast<float>(i + 1);
            for (int c = 0; c < 4; ++c) mean[c] = select(hasTap, mean[c] + (tap[c] - mean[c]) * share, mean[c]);
        }
    }
    return mean;
}

// The bias of the sampler and of a call, within D3D's limits (7.18.10).
Float limitBias(const sampler2D& s, Float bias)
{
    return clamp(bias + s.lodBias, -16.0f, 15.99f);
}

float2 toTexels(const Texture& texture, const float2& change)
{
    return {change.x * static_cast<float>(texture.width()), change.y * static_cast<float>(texture.height())};
}

// The result where the texture is the same everywhere.
float4 sampleConstant(const sampler2D& s, const Texture& texture)
{
    countSample(s);
    countLevels(s, kAllLanes, kAllLanes);
    fetchCounters.constant += countOf(activeLanes);
    return broadcast(texture.constant());
}

bool isConstant(const sampler2D& s, const Texture& texture)
{
    return texture.isConstant() && !hasBorder(s);
}

// `bias` without the sampler's own.
float4 sampleGradients(const sampler2D& s, const float2& uv, const float2& dx, const float2& dy, Float bias)
{
    const Texture& texture = textureOf(s);
    if (isConstant(s, texture)) return sampleConstant(s, texture);
    if (!s.mipmaps || texture.levelCount() == 1) return sampleFinestCounted(s, texture, uv);
    const float2 dX = toTexels(texture, dx), dY = toTexels(texture, dy);

    // Magnified as a whole: no logarithm is needed to know that level 0 is wanted, with one sample.
    const Float square = longestSquare(dX, dY);
    const Float wholeBias = limitBias(s, bias);
    const unsigned wanted = wantedLanes();
    const bool magnified = (((square <= 1.0f) & (wholeBias <= 0.0f)).bits() & wanted) == wanted;
    if (magnified && s.minLod <= 0.0f) return sampleFinestCounted(s, texture, uv);

    if (isAnisotropic(s)) {
        const auto limit = static_cast<float>(std::min(s.maxAnisotropy, 16));
        return sampleAnisotropic(s, texture, uv, anisotropicFootprint(dX, dY, limit), wholeBias);
    }
    return sampleIsotropic(s, texture, uv, 0.5f * log2(square) + wholeBias);
}

Float impliedLevel(const sampler2D& s, const Texture& texture, const float2& uv)
{
    const float2 dX = toTexels(texture, ddx(uv)), dY = toTexels(texture, ddy(uv));
    const auto limit = static_cast<float>(std::min(s.maxAnisotropy, 16));
    return (isAnisotropic(s) ? anisotropicFootprint(dX, dY, limit).lod : isotropicLevel(dX, dY)) + limitBias(s, 0.0f);
}

}  // namespace

float4 tex2D(const sampler2D& s, const float2& uv)
{
    return sampleGradients(s, uv, ddx(uv), ddy(uv), 0.0f);
}

float4 tex2Dgrad(const sampler2D& s, const float2& uv, const float2& dx, const float2& dy)
{
    return sampleGradients(s, uv, dx, dy, 0.0f);
}

float4 tex2Dbias(const sampler2D& s, const float4& uvBias)
{
    const float2 uv = {uvBias.x, uvBias.y};
    return sampleGradients(s, uv, ddx(uv), ddy(uv), uvBias.w);
}

float4 tex2Dlod(const sampler2D& s, const float4& uvLod)
{
    const Texture& texture = textureOf(s);
    if (isConstant(s, texture)) return sampleConstant(s, texture);
    const float2 uv = {uvLod.x, uvLod.y};
    if (!s.mipmaps || texture.levelCount() == 1) return sampleFinestCounted(s, texture, uv);
    return sampleIsotropic(s, texture, uv, uvLod.w + limitBias(s, 0.0f));
}

Float calculateLevelOfDetail(const sampler2D& s, const float2& uv)
{
    const Texture& texture = textureOf(s);
    const Float last = static_cast<float>(s.mipmaps ? texture.levelCount() - 1 : 0);
    return clamp(limitLevel(impliedLevel(s, texture, uv), s.minLod, s.maxLod), 0.0f, last);
}

Float calculateLevelOfDetailUnclamped(const sampler2D& s, const float2& uv)
{
    return impliedLevel(s, textureOf(s), uv);
}

float4 texelSize(const sampler2D& s)
{
    return broadcast(textureOf(s).texelSize());
}

}  // namespace relief

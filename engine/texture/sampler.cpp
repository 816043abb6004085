// The steps of a texture sample: level of detail, what it takes (one level, two, several samples), and the texel
// format, chosen once. The filters themselves are in filter.h.
#include "texture/sampler.h"

#include <algorithm>

#include "hlsl/derivatives.h"
#include "hlsl/intrinsics.h"
#include "lanes/active.h"
#include "leave_out.h"
#include "texture/filter.h"
#include "texture/level_of_detail.h"

namespace relief {
namespace {

inline const Texture& textureOf(const sampler2D& s)
{
    return s.texture ? *s.texture : Texture::white();
}

// `lod` after bias, NaN included, limited by the sampler (minLod wins where it is above maxLod) and to `levels`, those
// that exist. NaN becomes the upper limit.
inline Float limitedLevel(const sampler2D& s, int levels, Float lod)
{
    const auto last = static_cast<float>(levels - 1);
    const auto existing = [last](float level) { return level > 0.0f ? std::min(level, last) : 0.0f; };
    const float low = existing(s.minLod), high = std::max(low, s.maxLod < last ? existing(s.maxLod) : last);
    return Float(native::max(native::min(lod.value, Float(high).value), Float(low).value));
}

// What sampleMipLevels takes.
inline Int fixedLevel(const sampler2D& s, const Texture& texture, Float lod)
{
    const Float limited = limitedLevel(s, texture.levelCount(), lod);
    return Int(native::roundToInt((limited * static_cast<float>(kLodOne)).value));
}

// --- one function per texel format; lanes are handed on one by one, because single ones travel in registers ---

template <class Fetch>
[[gnu::noinline]] float4 finestIn(const sampler2D& s, const Texture& texture, Float u, Float v)
{
    return Fetch::toUnit(sampleLevel<Fetch>(placeOf(s, texture, u, v), texture.level(0)));
}

template <class Fetch>
[[gnu::noinline]] float4 mipChainIn(const sampler2D& s, const Texture& texture, Float u, Float v, Int lod, int guess)
{
    return Fetch::toUnit(sampleMipLevels<Fetch>(placeOf(s, texture, u, v), lod, guess));
}

inline float4 sampleFinest(const sampler2D& s, const Texture& texture, Float u, Float v)
{
    switch (texture.format()) {
        case TexelFormat::rgba8:
            return finestIn<FetchRgba8>(s, texture, u, v);
        case TexelFormat::rgba16:
            return finestIn<FetchRgba16>(s, texture, u, v);
        case TexelFormat::rgba32Float:
            break;
    }
    return finestIn<FetchRgba32Float>(s, texture, u, v);
}

inline float4 sampleMipChain(const sampler2D& s, const Texture& texture, Float u, Float v, Int lod, int guess)
{
    switch (texture.format()) {
        case TexelFormat::rgba8:
            return mipChainIn<FetchRgba8>(s, texture, u, v, lod, guess);
        case TexelFormat::rgba16:
            return mipChainIn<FetchRgba16>(s, texture, u, v, lod, guess);
        case TexelFormat::rgba32Float:
            break;
    }
    return mipChainIn<FetchRgba32Float>(s, texture, u, v, lod, guess);
}

// --- counting (see fetch_counters.h) ---

inline std::uint64_t countOf(unsigned lanes)
{
    return static_cast<std::uint64_t>(countBits(lanes));
}

inline bool isAnisotropic(const sampler2D& s)
{
    return s.maxAnisotropy > 1 && s.filter == Filter::trilinear;
}

inline void countSample(const sampler2D& s)
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

inline void countLevels(const sampler2D& s, unsigned onFinest, unsigned onOneLevel)
{
    fetchCounters.magnified += countOf(onFinest & activeLanes);
    if (s.filter == Filter::trilinear) fetchCounters.secondLevelSkipped += countOf(onOneLevel & activeLanes);
}

inline void countNoDerivatives()
{
    fetchCounters.noDerivatives += countOf(activeLanes);
}

// --- the kinds of sample ---

inline float4 sampleFinestCounted(const sampler2D& s, const Texture& texture, Float u, Float v)
{
    countSample(s);
    countLevels(s, kAllLanes, kAllLanes);
    if (isAnisotropic(s)) fetchCounters.taps += countOf(activeLanes);
    return sampleFinest(s, texture, u, v);
}

// Without mip levels there is no level of detail to choose.
inline float4 sampleOnlyLevel(const sampler2D& s, const Texture& texture, Float u, Float v)
{
    countNoDerivatives();
    return sampleFinestCounted(s, texture, u, v);
}

[[gnu::always_inline]] inline float4 sampleIsotropic(const sampler2D& s, const Texture& texture, Float u, Float v,
                                                     Float lod, int guess)
{
    const Int fixed = fixedLevel(s, texture, lod);
    const unsigned onFinest = (fixed == 0).bits();
    countSample(s);
    countLevels(s, onFinest, ((fixed & (kLodOne - 1)) == 0).bits());
    if (isAnisotropic(s)) fetchCounters.taps += countOf(activeLanes);  // tex2Dlod
    if (leavesOut::coarserLevel && (wantedLanes() & ~onFinest) == 0) return sampleFinest(s, texture, u, v);
    return sampleMipChain(s, texture, u, v, fixed, guess);
}

// The level that a block most likely wants, quickly: half the exponent of the first lane's `square` is the integer part
// of its level, before bias and limits.
inline int likelyLevel(const sampler2D& s, const Texture& texture, Float square)
{
    const int exponent = (asInt(square)[0] >> 23) - 127;
    const int level = (s.filter == Filter::trilinear ? exponent : exponent + 1) >> 1;
    return std::clamp(level, 0, texture.levelCount() - 1);
}

// The bias of the sampler and of a call, within D3D's limits (7.18.10).
inline Float limitBias(const sampler2D& s, Float bias)
{
    return clamp(bias + s.lodBias, -16.0f, 15.99f);
}
inline float limitBias(const sampler2D& s, float bias)
{
    const float sum = bias + s.lodBias;
    return sum > -16.0f ? std::min(sum, 15.99f) : -16.0f;
}

inline bool allAtMost(Float a, float limit, unsigned lanes)
{
    return ((a <= limit).bits() & lanes) == lanes;
}
inline bool allAtMost(float a, float limit, unsigned)
{
    return a <= limit;
}

inline float2 toTexels(const Texture& texture, const float2& change)
{
    const glm::vec4& size = texture.texelSize();
    return {change.x * size.z, change.y * size.w};
}

// The result where the texture is the same everywhere.
[[gnu::noinline]] float4 sampleConstant(const sampler2D& s, const Texture& texture)
{
    countSample(s);
    countLevels(s, kAllLanes, kAllLanes);
    countNoDerivatives();
    fetchCounters.constant += countOf(activeLanes);
    return broadcast(texture.constant());
}

inline bool isConstant(const sampler2D& s, const Texture& texture)
{
    return leavesOut::constants && texture.isConstant() && !hasBorder(s);
}

// The coordinate's change from one pixel to the next.
struct Gradients
{
    float2 dx, dy;
};

inline Gradients gradientsOf(Float u, Float v)
{
    return {{ddx(u), ddx(v)}, {ddy(u), ddy(v)}};
}

// Magnified as a whole: no logarithm is needed to know that level 0 is wanted, with one sample.
template <class Bias>
inline bool isMagnified(const sampler2D& s, Float square, Bias wholeBias)
{
    const unsigned wanted = wantedLanes();
    return leavesOut::logarithms && s.minLod <= 0.0f && allAtMost(square, 1.0f, wanted) &&
           allAtMost(wholeBias, 0.0f, wanted);
}

// `bias` is without the sampler's own, a float or one per lane.
template <class Bias>
[[gnu::always_inline]] inline float4 sampleIsotropicBy(const Gradients& change, Bias bias, const sampler2D& s,
                                                       const Texture& texture, Float u, Float v)
{
    const Float square = longestSquare(toTexels(texture, change.dx), toTexels(texture, change.dy));
    const Bias wholeBias = limitBias(s, bias);
    if (isMagnified(s, square, wholeBias)) return sampleFinestCounted(s, texture, u, v);
    return sampleIsotropic(s, texture, u, v, limitedIsotropicLevel(square) + wholeBias,
                           likelyLevel(s, texture, square));
}

// The average of the taps, which lie evenly on the footprint's axis: tap i of n at (2 i + 1 - n) / 2n of it. It is kept
// as a running mean, mean += (tap - mean) / (i + 1): equal taps give exactly themselves.
[[gnu::noinline]] float4 sampleAnisotropic(const sampler2D& s, const Texture& texture, Float u, Float v,
                                           const Gradients& change, Float bias)
{
    const float2 dX = toTexels(texture, change.dx), dY = toTexels(texture, change.dy);
    const Float wholeBias = limitBias(s, bias);
    if (isMagnified(s, longestSquare(dX, dY), wholeBias)) return sampleFinestCounted(s, texture, u, v);

    const auto limit = static_cast<float>(std::min(s.maxAnisotropy, 16));
    const AnisotropicFootprint footprint = anisotropicFootprint(dX, dY, limit);
    const Int fixed = fixedLevel(s, texture, footprint.lod + wholeBias);
    countSample(s);
    countLevels(s, (fixed == 0).bits(), ((fixed & (kLodOne - 1)) == 0).bits());
    const glm::vec4& size = texture.texelSize();
    const float2 axis = {footprint.axis.x * size.x, footprint.axis.y * size.y};
    const Float perTap = 0.5f / footprint.taps;
    const int guess = fixed[0] >> kLodBits;

    float4 mean;
    for (int i = 0; i < 16; ++i) {
        const Mask hasTap = footprint.taps > static_cast<float>(i);
        const unsigned lanes = hasTap.bits() & wantedLanes();
        if (lanes == 0) break;
        fetchCounters.taps += countOf(lanes & activeLanes);
        const Float along = (static_cast<float>(2 * i + 1) - footprint.taps) * perTap;
        const float4 tap = sampleMipChain(s, texture, u + axis.x * along, v + axis.y * along, fixed, guess);
        if (i == 0) {
            mean = tap;
        } else {
            const float share = 1.0f / static_cast<float>(i + 1);
            for (int c = 0; c < 4; ++c) mean[c] = select(hasTap, mean[c] + (tap[c] - mean[c]) * share, mean[c]);
        }
    }
    return mean;
}

[[gnu::noinline]] float4 sampleAnisotropicImplicit(const sampler2D& s, const Texture& texture, Float u, Float v)
{
    return sampleAnisotropic(s, texture, u, v, gradientsOf(u, v), 0.0f);
}

inline bool usesMipLevels(const sampler2D& s, const Texture& texture)
{
    return s.mipmaps && texture.levelCount() > 1;
}

// `gradients` gives the coordinate's changes; it is called only where a level of detail is chosen.
template <class TakeGradients, class Bias>
float4 sampleBy(TakeGradients gradients, Bias bias, const sampler2D& s, Float u, Float v)
{
    const Texture& texture = textureOf(s);
    if (isConstant(s, texture)) return sampleConstant(s, texture);
    if (!usesMipLevels(s, texture)) return sampleOnlyLevel(s, texture, u, v);
    const Gradients change = gradients();
    if (isAnisotropic(s)) return sampleAnisotropic(s, texture, u, v, change, bias);
    return sampleIsotropicBy(change, bias, s, texture, u, v);
}

// No texture is white.
[[gnu::noinline]] float4 sampleWhite(sampler2D s, Float u, Float v)
{
    s.texture = &Texture::white();
    return detail::sampleImplicit(s, u, v);
}

Float impliedLevel(const sampler2D& s, const Texture& texture, const float2& uv)
{
    const float2 dX = toTexels(texture, ddx(uv)), dY = toTexels(texture, ddy(uv));
    const auto limit = static_cast<float>(std::min(s.maxAnisotropy, 16));
    return (isAnisotropic(s) ? anisotropicFootprint(dX, dY, limit).lod : isotropicLevel(dX, dY)) + limitBias(s, 0.0f);
}

}  // namespace

namespace detail {

// tex2D itself. Every call is the last thing that it does, so that u and v stay in registers.
float4 sampleImplicit(const sampler2D& s, Float u, Float v)
{
    if (s.texture == nullptr) return sampleWhite(s, u, v);
    const Texture& texture = *s.texture;
    if (isConstant(s, texture)) return sampleConstant(s, texture);
    if (!usesMipLevels(s, texture)) return sampleOnlyLevel(s, texture, u, v);
    if (isAnisotropic(s)) return sampleAnisotropicImplicit(s, texture, u, v);
    return sampleIsotropicBy(gradientsOf(u, v), 0.0f, s, texture, u, v);
}

float4 sampleBias(const sampler2D& s, Float u, Float v, Float bias)
{
    return sampleBy([&] { return gradientsOf(u, v); }, bias, s, u, v);
}

float4 sampleGradients(const sampler2D& s, Float u, Float v, const float2& dx, const float2& dy)
{
    const auto given = [&] {
        countNoDerivatives();
        return Gradients{dx, dy};
    };
    return sampleBy(given, 0.0f, s, u, v);
}

float4 sampleLod(const sampler2D& s, Float u, Float v, Float lod)
{
    const Texture& texture = textureOf(s);
    if (isConstant(s, texture)) return sampleConstant(s, texture);
    if (!usesMipLevels(s, texture)) return sampleOnlyLevel(s, texture, u, v);
    countNoDerivatives();
    return sampleIsotropic(s, texture, u, v, lod + limitBias(s, 0.0f), 0);
}

}  // namespace detail

float4 tex2DWhere(Mask needed, const sampler2D& s, const float2& uv)
{
    const unsigned outside = activeLanes;
    if (leavesOut::planes) activeLanes = outside & needed.bits();
    float4 color(0.0f);
    if (activeLanes != 0) color = select(needed, tex2D(s, uv), color);
    activeLanes = outside;
    return color;
}

Float calculateLevelOfDetail(const sampler2D& s, const float2& uv)
{
    const Texture& texture = textureOf(s);
    return limitedLevel(s, s.mipmaps ? texture.levelCount() : 1, impliedLevel(s, texture, uv));
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

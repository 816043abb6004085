// The steps of a texture sample: level of detail, what it takes (one level, two, several samples), and the texel
// format, chosen once. The filters themselves are in filter.h.
#include "relief/texture/sampler.h"

#include <algorithm>

#include "relief/hlsl/derivatives.h"
#include "relief/hlsl/intrinsics.h"
#include "relief/leave_out.h"
#include "relief/texture/level_of_detail.h"
#include "relief/texture/sampler_steps.h"

namespace relief::inline RELIEF_WIDTH {
namespace {

inline const Texture& textureOf(const sampler2D& s)
{
    return s.texture ? *s.texture : Texture::white();
}

// --- one function per texel format and kind of address modes ---
//
// What is not inlined takes single lanes, because these travel in registers, and returns through a reference: the last
// call of a function that returns nothing is a jump.

template <class Fetch, class Modes>
[[gnu::noinline]] void finestIn(float4& result, const sampler2D& s, const Texture& texture, Float u, Float v)
{
    result = Fetch::toUnit(sampleLevel<Fetch>(placeOn<Modes>(s, texture, u, v), texture.level(0)));
}

template <class Fetch, class Modes>
[[gnu::noinline]] void mipChainIn(float4& result, const sampler2D& s, const Texture& texture, Float u, Float v, Int lod,
                                  int guess)
{
    result = Fetch::toUnit(sampleMipLevels<Fetch>(placeOn<Modes>(s, texture, u, v), lod, guess));
}

// Calls one of these: `function` names it for a texel format and address modes, as in finestIn<Fetch, Modes>.
template <class Function>
[[gnu::always_inline]] inline void forFormat(const sampler2D& s, const Texture& texture, const Function& function)
{
    const auto forModes = [&]<class Fetch>() __attribute__((always_inline))
    {
        if (isRepeated(s)) [[likely]]
            return function.template operator()<Fetch, Repeated>();
        return function.template operator()<Fetch, AnyModes>();
    };
    withFetch(texture.format(), forModes);
}

inline void sampleFinest(float4& result, const sampler2D& s, const Texture& texture, Float u, Float v)
{
    forFormat(
        s, texture, [&]<class Fetch, class Modes>() __attribute__((always_inline)) {
            finestIn<Fetch, Modes>(result, s, texture, u, v);
        });
}

inline void sampleMipChain(float4& result, const sampler2D& s, const Texture& texture, Float u, Float v, Int lod,
                           int guess)
{
    forFormat(
        s, texture, [&]<class Fetch, class Modes>() __attribute__((always_inline)) {
            mipChainIn<Fetch, Modes>(result, s, texture, u, v, lod, guess);
        });
}

// --- counting (see sampler_steps.h) ---

inline void countFinest(const sampler2D& s)
{
    countSample(s);
    countOneLevel(s, kAllLanes, kAllLanes);
    if (isAnisotropic(s)) shading.fetches.taps += countOf(shading.activeLanes);
}

// --- the level of detail ---

// Of a bias that is the same in all lanes.
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

// The coordinate's change from one pixel to the next.
struct Gradients
{
    float2 dx, dy;
};

inline Gradients gradientsOf(Float u, Float v)
{
    return {{ddx(u), ddx(v)}, {ddy(u), ddy(v)}};
}

inline float2 toTexels(const Texture& texture, const float2& change)
{
    const glm::vec4& size = texture.texelSize();
    return {change.x * size.z, change.y * size.w};
}

// Magnified as a whole: no logarithm is needed to know that level 0 is wanted, with one sample.
template <class Bias>
inline bool isMagnified(const sampler2D& s, Float square, Bias wholeBias)
{
    const unsigned wanted = wantedLanes();
    return leavesOut::logarithms && s.minLod <= 0.0f && allAtMost(square, 1.0f, wanted) &&
           allAtMost(wholeBias, 0.0f, wanted);
}

// Where the instrument listens, the rest of a sample is a call, so that it takes no registers of the others.
[[gnu::noinline, gnu::cold]] void sampleWatched(float4& result, const sampler2D& s, const Texture& texture, Float u,
                                                Float v, Int fixed)
{
    noteLevels(s, fixed);
    sampleMipChain(result, s, texture, u, v, fixed, 0);
}

// Ends in finest() where all lanes want level 0 alone, else in mipChain(lod, guess).
template <class Finest, class MipChain, class Watched>
[[gnu::always_inline]] inline void sampleAtLevel(const sampler2D& s, const Texture& texture, Float lod, int guess,
                                                 const Finest& finest, const MipChain& mipChain, const Watched& watched)
{
    const Int fixed = fixedLevel(s, texture.levelCount(), lod);
    const unsigned onFinest = (fixed == 0).bits();
    countSample(s);
    if (const unsigned onOneLevel = lanesOnOneLevel(fixed); onOneLevel != 0) {
        if ((onOneLevel & kWatched) != 0) [[unlikely]]
            return watched(fixed);
        countOneLevel(s, onFinest, onOneLevel);
    }
    if (isAnisotropic(s)) shading.fetches.taps += countOf(shading.activeLanes);  // tex2Dlod
    if (leavesOut::coarserLevel && (wantedLanes() & ~onFinest) == 0) return finest();
    return mipChain(fixed, guess);
}

// The same, with the level that the coordinate's change asks for. `bias` is without the sampler's own, a float or one
// per lane.
template <class Bias, class Finest, class MipChain, class Watched>
[[gnu::always_inline]] inline void sampleIsotropic(const sampler2D& s, const Texture& texture, const Gradients& change,
                                                   Bias bias, const Finest& finest, const MipChain& mipChain,
                                                   const Watched& watched)
{
    const Float square = longestSquare(toTexels(texture, change.dx), toTexels(texture, change.dy));
    const Bias wholeBias = limitBias(s, bias);
    if (isMagnified(s, square, wholeBias)) {
        countFinest(s);
        return finest();
    }
    return sampleAtLevel(s, texture, limitedIsotropicLevel(square) + wholeBias,
                         likelyLevel(s, texture.levelCount(), square), finest, mipChain, watched);
}

// --- the kinds of sample ---

// The result where the texture is the same everywhere.
[[gnu::noinline]] void sampleConstant(float4& result, const sampler2D& s, const Texture& texture)
{
    countSample(s);
    countOneLevel(s, kAllLanes, kAllLanes);
    countNoDerivatives();
    shading.fetches.constant += countOf(shading.activeLanes);
    result = broadcast(texture.constant());
}

inline bool isConstant(const sampler2D& s, const Texture& texture)
{
    return leavesOut::constants && texture.isConstant() && !hasBorder(s);
}

inline bool usesMipLevels(const sampler2D& s, const Texture& texture)
{
    return s.mipmaps && texture.levelCount() > 1;
}

// Without mip levels there is no level of detail to choose.
inline void sampleOnlyLevel(float4& result, const sampler2D& s, const Texture& texture, Float u, Float v)
{
    countNoDerivatives();
    countFinest(s);
    return sampleFinest(result, s, texture, u, v);
}

// tex2D as it mostly is, in one piece.
template <class Fetch, class Modes>
[[gnu::noinline]] void implicitIn(float4& result, const sampler2D& s, const Texture& texture, Float u, Float v)
{
    const auto finest = [&] { finestIn<Fetch, Modes>(result, s, texture, u, v); };
    const auto mipChain = [&](Int lod, int guess) __attribute__((always_inline))
    {
        result = Fetch::toUnit(sampleMipLevels<Fetch>(placeOn<Modes>(s, texture, u, v), lod, guess));
    };
    const auto watched = [&](Int fixed) { sampleWatched(result, s, texture, u, v, fixed); };
    sampleIsotropic(s, texture, gradientsOf(u, v), 0.0f, finest, mipChain, watched);
}

// The average of the taps, which lie evenly on the footprint's axis: tap i of n at (2 i + 1 - n) / 2n of it. It is kept
// as a running mean, mean += (tap - mean) / (i + 1): equal taps give exactly themselves.
[[gnu::noinline]] void sampleAnisotropic(float4& result, const sampler2D& s, const Texture& texture, Float u, Float v,
                                         const Gradients& change, Float bias)
{
    const float2 dX = toTexels(texture, change.dx), dY = toTexels(texture, change.dy);
    const Float wholeBias = limitBias(s, bias);
    if (isMagnified(s, longestSquare(dX, dY), wholeBias)) {
        countFinest(s);
        return sampleFinest(result, s, texture, u, v);
    }

    const auto limit = static_cast<float>(std::min(s.maxAnisotropy, 16));
    const AnisotropicFootprint footprint = anisotropicFootprint(dX, dY, limit);
    const Int fixed = fixedLevel(s, texture.levelCount(), footprint.lod + wholeBias);
    countSample(s);
    if ((shading.activeLanes & kWatched) != 0) noteLevels(s, fixed);
    if (const unsigned onOneLevel = lanesOnOneLevel(fixed); onOneLevel != 0)
        countOneLevel(s, (fixed == 0).bits(), onOneLevel);
    const glm::vec4& size = texture.texelSize();
    const float2 axis = {footprint.axis.x * size.x, footprint.axis.y * size.y};
    const Float perTap = 0.5f / footprint.taps;
    const int guess = fixed[0] >> kLodBits;

    float4 mean, tap;
    for (int i = 0; i < 16; ++i) {
        const Mask hasTap = footprint.taps > static_cast<float>(i);
        const unsigned lanes = hasTap.bits() & wantedLanes();
        if (lanes == 0) break;
        shading.fetches.taps += countOf(lanes & shading.activeLanes);
        const Float along = (static_cast<float>(2 * i + 1) - footprint.taps) * perTap;
        sampleMipChain(tap, s, texture, u + axis.x * along, v + axis.y * along, fixed, guess);
        if (i == 0) {
            mean = tap;
        } else {
            const float share = 1.0f / static_cast<float>(i + 1);
            for (int c = 0; c < 4; ++c) mean[c] = select(hasTap, mean[c] + (tap[c] - mean[c]) * share, mean[c]);
        }
    }
    result = mean;
}

[[gnu::noinline]] void sampleAnisotropicImplicit(float4& result, const sampler2D& s, const Texture& texture, Float u,
                                                 Float v)
{
    sampleAnisotropic(result, s, texture, u, v, gradientsOf(u, v), 0.0f);
}

// `gradients` gives the coordinate's changes; it is called only where a level of detail is chosen.
template <class TakeGradients, class Bias>
void sampleBy(TakeGradients gradients, Bias bias, float4& result, const sampler2D& s, Float u, Float v)
{
    const Texture& texture = textureOf(s);
    if (isConstant(s, texture)) return sampleConstant(result, s, texture);
    if (!usesMipLevels(s, texture)) return sampleOnlyLevel(result, s, texture, u, v);
    const Gradients change = gradients();
    if (isAnisotropic(s)) return sampleAnisotropic(result, s, texture, u, v, change, bias);
    const auto finest = [&] { sampleFinest(result, s, texture, u, v); };
    const auto mipChain = [&](Int lod, int guess) { sampleMipChain(result, s, texture, u, v, lod, guess); };
    const auto watched = [&](Int fixed) { sampleWatched(result, s, texture, u, v, fixed); };
    sampleIsotropic(s, texture, change, bias, finest, mipChain, watched);
}

// No texture is white.
[[gnu::noinline]] void sampleWhite(float4& result, const sampler2D& s, Float u, Float v)
{
    sampler2D white = s;
    white.texture = &Texture::white();
    detail::sampleImplicit(result, white, u, v);
}

Float impliedLevel(const sampler2D& s, const Texture& texture, const float2& uv)
{
    const float2 dX = toTexels(texture, ddx(uv)), dY = toTexels(texture, ddy(uv));
    const auto limit = static_cast<float>(std::min(s.maxAnisotropy, 16));
    return (isAnisotropic(s) ? anisotropicFootprint(dX, dY, limit).lod : isotropicLevel(dX, dY)) + limitBias(s, 0.0f);
}

}  // namespace

namespace detail {

// tex2D itself.
void sampleImplicit(float4& result, const sampler2D& s, Float u, Float v)
{
    if (s.texture == nullptr) return sampleWhite(result, s, u, v);
    const Texture& texture = *s.texture;
    if (isConstant(s, texture)) return sampleConstant(result, s, texture);
    if (!usesMipLevels(s, texture)) return sampleOnlyLevel(result, s, texture, u, v);
    if (isAnisotropic(s)) return sampleAnisotropicImplicit(result, s, texture, u, v);
    forFormat(
        s, texture, [&]<class Fetch, class Modes>() __attribute__((always_inline)) {
            implicitIn<Fetch, Modes>(result, s, texture, u, v);
        });
}

void sampleBias(float4& result, const sampler2D& s, Float u, Float v, Float bias)
{
    sampleBy([&] { return gradientsOf(u, v); }, bias, result, s, u, v);
}

void sampleGradients(float4& result, const sampler2D& s, Float u, Float v, const float2& dx, const float2& dy)
{
    const auto given = [&] {
        countNoDerivatives();
        return Gradients{dx, dy};
    };
    sampleBy(given, 0.0f, result, s, u, v);
}

void sampleLod(float4& result, const sampler2D& s, Float u, Float v, Float lod)
{
    const Texture& texture = textureOf(s);
    if (isConstant(s, texture)) return sampleConstant(result, s, texture);
    if (!usesMipLevels(s, texture)) return sampleOnlyLevel(result, s, texture, u, v);
    countNoDerivatives();
    const auto finest = [&] { sampleFinest(result, s, texture, u, v); };
    const auto mipChain = [&](Int fixed, int guess) { sampleMipChain(result, s, texture, u, v, fixed, guess); };
    const auto watched = [&](Int fixed) { sampleWatched(result, s, texture, u, v, fixed); };
    sampleAtLevel(s, texture, lod + limitBias(s, 0.0f), 0, finest, mipChain, watched);
}

}  // namespace detail

float4 tex2DWhere(Mask needed, const sampler2D& s, const float2& uv)
{
    const unsigned outside = shading.activeLanes;
    if (leavesOut::planes) shading.activeLanes = outside & (native::maskBits(needed.value) | kWatched);
    float4 color(0.0f);
    if (shading.activeLanes != 0) color = select(needed, tex2D(s, uv), color);
    shading.activeLanes = outside;
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

}  // namespace relief::inline RELIEF_WIDTH

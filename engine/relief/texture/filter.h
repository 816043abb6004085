// Filters: from a place on a texture and a level of detail to a colour, for one texel format. The common case, every
// lane on one mip level, goes straight through; a block that spans several levels runs once per level.
//
// All of this is inlined into three functions (finestIn, mipChainIn and implicitIn in sampler.cpp) for each texel
// format and kind of address modes: a call in between would move every register through memory. The rare cases that are
// called take their parameters by value, or these would be in memory for the others, too.
#pragma once

#include <bit>

#include "relief/leave_out.h"
#include "relief/texture/fetch.h"
#include "relief/texture/sampler.h"
#include "relief/texture/shading_scope.h"

namespace relief::inline RELIEF_WIDTH {

// Levels of detail are fixed point with 8 bits of fraction, D3D's least (7.18.10).
inline constexpr int kLodBits = 8;
inline constexpr int kLodOne = 1 << kLodBits;

// The address modes of both axes: any, as the sampler says, or the common ones, known while compiling. With these no
// function below asks for the mode of an axis and level again.
struct AnyModes
{
    explicit AnyModes(const sampler2D& s) : u(s.u), v(s.v) {}
    AddressMode u, v;
};
struct Repeated
{
    explicit Repeated(const sampler2D&) {}
    static constexpr AddressMode u = AddressMode::wrap, v = AddressMode::wrap;
};

inline bool isRepeated(const sampler2D& s)
{
    return s.u == Repeated::u && s.v == Repeated::v;
}

template <class Modes>
constexpr bool hasBorder(const Modes& modes)  // of a sampler, too
{
    return modes.u == AddressMode::border || modes.v == AddressMode::border;
}

// Where to sample, after range reduction: the same for every level.
template <class Modes>
struct Place
{
    Place(const sampler2D& s, const Texture& of, Float toU, Float toV)
        : modes(s), sampler(s), texture(of), u(reduceRange(modes.u, toU)), v(reduceRange(modes.v, toV))
    {
    }

    Modes modes;
    const sampler2D& sampler;
    const Texture& texture;
    Float u, v;
};

// The lanes that results are wanted for. A block without any still gets some values.
inline unsigned wantedLanes()
{
    return shading.activeLanes != 0 ? shading.activeLanes : 1u;
}

// The texels that a bilinear sample lies between, on one level: positions and weights along both axes.
struct Pairs
{
    Int x, y;
    Int fx, fy;  // 0..kSubtexels - 1
};

template <class Modes>
[[gnu::always_inline]] inline Pairs pairsOn(const Place<Modes>& place, const MipLevel& level)
{
    const Int x = pairPosition(place.modes.u, place.u, level.sideU());
    const Int y = pairPosition(place.modes.v, place.v, level.sideV());
    return {x >> kSubtexelBits, y >> kSubtexelBits, x & kSubtexelMask, y & kSubtexelMask};
}

template <class Fetch>
[[gnu::always_inline]] inline float4 mixEach(const float4& a, const float4& b, Float t)
{
    const Float alpha = kIsOpaque<Fetch> ? a.w : Fetch::mix(a.w, b.w, t);
    return {Fetch::mix(a.x, b.x, t), Fetch::mix(a.y, b.y, t), Fetch::mix(a.z, b.z, t), alpha};
}

// --- with a border: one texel at a time, rare and simple ---

// A texel by its position (see address.h), or the border's colour where an axis in border mode leaves the texture.
template <class Fetch>
float4 texelOrBorder(const sampler2D& s, const MipLevel& level, Int x, Int y)
{
    Mask outside = false;
    if (s.u == AddressMode::border) outside |= (x < 1) | (x > level.width());
    if (s.v == AddressMode::border) outside |= (y < 1) | (y > level.height());
    const Int column = clamp(x, 0, level.width() + 1), row = clamp(y, 0, level.height() + 1);
    const float4 texel = Fetch::nearest(level, row * level.rowTexels() + column);
    float4 result;
    for (int c = 0; c < 4; ++c) result[c] = select(outside, Float(s.borderColor[c] * Fetch::kOne), texel[c]);
    return result;
}

template <class Fetch>
[[gnu::noinline]] float4 bilinearWithBorder(const sampler2D& s, const MipLevel& level, Pairs at)
{
    const float4 lowerLeft = texelOrBorder<Fetch>(s, level, at.x, at.y);
    const float4 lowerRight = texelOrBorder<Fetch>(s, level, at.x + 1, at.y);
    const float4 upperLeft = texelOrBorder<Fetch>(s, level, at.x, at.y + 1);
    const float4 upperRight = texelOrBorder<Fetch>(s, level, at.x + 1, at.y + 1);
    const Float tx = Float(at.fx) * (1.0f / kSubtexels), ty = Float(at.fy) * (1.0f / kSubtexels);
    return mixEach<Fetch>(mixEach<Fetch>(lowerLeft, lowerRight, tx), mixEach<Fetch>(upperLeft, upperRight, tx), ty);
}

// --- on one level ---

// Of positions within the frame. Both factors are below 2^15: a product of halves is faster than one of whole words.
inline Int texelIndex(const MipLevel& level, Int x, Int y)
{
    static_assert(kMaxTextureSide + 64 < 1 << 15);  // frame and padding included
    return multiplyAddHalves(y, level.rowTexels()) + x;
}

// A border has an alpha of its own.
template <class Modes>
bool leavesOutAlpha(const Place<Modes>& place, const MipLevel& level)
{
    return leavesOut::alpha && level.isOpaque() && !hasBorder(place.modes);
}

template <class Fetch, class Modes>
[[gnu::always_inline]] inline float4 nearestOn(const Place<Modes>& place, const MipLevel& level)
{
    const Int x = nearestPosition(place.modes.u, place.u, level.sideU());
    const Int y = nearestPosition(place.modes.v, place.v, level.sideV());
    if (hasBorder(place.modes)) [[unlikely]]
        return texelOrBorder<Fetch>(place.sampler, level, x, y);
    return Fetch::nearest(level, texelIndex(level, x, y));
}

template <class Fetch, class Modes>
[[gnu::always_inline]] inline float4 bilinearOn(const Place<Modes>& place, const MipLevel& level, const Pairs& at)
{
    if (hasBorder(place.modes)) [[unlikely]]
        return bilinearWithBorder<Fetch>(place.sampler, level, at);
    return Fetch::bilinear(level, texelIndex(level, at.x, at.y), at.fx, at.fy);
}

// --- on one or several levels, of textures and of cube maps ---
//
// A place is one on a texture, a Place, or one on a cube map (cube_sampler.cpp): it has `sampler` and `texture`, and
// the functions of its own above, pairsOn, nearestOn, bilinearOn and leavesOutAlpha.

template <class Fetch, class SomePlace>
[[gnu::always_inline]] inline float4 sampleLevel(const SomePlace& place, const MipLevel& level)
{
    if (place.sampler.filter == Filter::nearest) return nearestOn<Fetch>(place, level);
    const Pairs at = pairsOn(place, level);
    return leavesOutAlpha(place, level) ? bilinearOn<Opaque<Fetch>>(place, level, at)
                                        : bilinearOn<Fetch>(place, level, at);
}

// Both levels' texels are located before the first is fetched: the processor has something to do while the first
// addresses are on their way through memory.
template <class Fetch, class SomePlace>
[[gnu::always_inline]] inline float4 sampleBetween(const SomePlace& place, const MipLevel& finer,
                                                   const MipLevel& coarser, Float t)
{
    const Pairs onFiner = pairsOn(place, finer), onCoarser = pairsOn(place, coarser);
    const float4 a = bilinearOn<Fetch>(place, finer, onFiner);
    const float4 b = bilinearOn<Fetch>(place, coarser, onCoarser);
    return mixEach<Fetch>(a, b, t);
}

// Level k for all lanes, and with the trilinear filter the part of level k + 1 that `fraction` (0..255) says; `lanes`
// are those that the result is for.
template <class Fetch, class SomePlace>
[[gnu::always_inline]] inline float4 sampleLevels(const SomePlace& place, int k, Int fraction, unsigned lanes)
{
    const MipLevel& finer = place.texture.level(k);
    const bool hasOneLevel =
        leavesOut::coarserLevel ? ((fraction != 0).bits() & lanes) == 0 : k + 1 == place.texture.levelCount();
    if (place.sampler.filter != Filter::trilinear || hasOneLevel) {
        return sampleLevel<Fetch>(place, finer);
    }
    const MipLevel& coarser = place.texture.level(k + 1);
    const Float t = Float(fraction) * (1.0f / kLodOne);
    return leavesOutAlpha(place, finer) && coarser.isOpaque() ? sampleBetween<Opaque<Fetch>>(place, finer, coarser, t)
                                                              : sampleBetween<Fetch>(place, finer, coarser, t);
}

// Every lane on its own level: one round per distinct level.
template <class Fetch, class SomePlace>
[[gnu::noinline]] float4 sampleSeveralLevels(SomePlace place, Int level, Int fraction)
{
    std::int32_t levels[kLanes];
    level.store(levels);
    float4 result(Float(0.0f));
    for (unsigned waiting = wantedLanes() & kAllLanes; waiting != 0;) {
        const int k = levels[std::countr_zero(waiting)];
        const Mask here = level == k;
        const float4 colour = sampleLevels<Fetch>(place, k, fraction, here.bits() & waiting);
        for (int c = 0; c < 4; ++c) result[c] = select(here, colour[c], result[c]);
        waiting &= ~here.bits();
    }
    return result;
}

// At `lod`, in 0..levels - 1 with kLodBits of fraction.
//
// `guess` is the level that a caller expects, 0..levels - 1. It changes no result: where all lanes are on it, as they
// mostly are, the processor predicts the branch and is at the texels before the logarithm in `lod` is done.
template <class Fetch, class SomePlace>
[[gnu::always_inline]] inline float4 sampleMipLevels(const SomePlace& place, Int lod, int guess)
{
    const bool trilinear = place.sampler.filter == Filter::trilinear;
    const Int level = (trilinear ? lod : lod + kLodOne / 2) >> kLodBits;
    const Int fraction = lod & (kLodOne - 1);
    if (((level != guess).bits() & wantedLanes()) == 0) [[likely]]
        return sampleLevels<Fetch>(place, guess, fraction, wantedLanes());
    return sampleSeveralLevels<Fetch>(place, level, fraction);
}

}  // namespace relief::inline RELIEF_WIDTH

// Filters: from a place on a texture and a level of detail to a colour, for one texel format. The common case, every
// lane on one mip level, goes straight through; where they are on several, a Level below is not a MipLevel, but
// LaneLevels.
//
// All of this is inlined into four functions (finestIn, mipChainIn and implicitIn in sampler.cpp, sampleIn in
// cube_sampler.cpp) for each texel
// format and kind of address modes: a call in between would move every register through memory. The rare cases that are
// called take their parameters by value, or these would be in memory for the others, too.
#pragma once

#include <algorithm>

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
    const sampler2D& sampler;
    const Texture& texture;
    Float u, v;
    Modes modes = Modes(sampler);

    // Calls function(u, v), all of it that is lanes.
    template <class Function>
    [[gnu::always_inline]] void withLanes(const Function& function) const
    {
        function(u, v);
    }
};

template <class Modes>
[[gnu::always_inline]] inline Place<Modes> placeOn(const sampler2D& s, const Texture& texture, Float u, Float v)
{
    const Modes modes(s);
    return {s, texture, reduceRange(modes.u, u), reduceRange(modes.v, v)};
}

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

template <class Modes, class Level>
[[gnu::always_inline]] inline Pairs pairsOn(const Place<Modes>& place, const Level& level)
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
template <class Fetch, class Level>
float4 texelOrBorder(const sampler2D& s, const Level& level, Int x, Int y)
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

template <class Fetch, class Level>
[[gnu::noinline]] float4 bilinearWithBorder(const sampler2D& s, const Level& level, Pairs at)
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
template <class Level>
inline Int texelIndex(const Level& level, Int x, Int y)
{
    static_assert(kMaxTextureSide + 64 < 1 << 15);  // frame and padding included
    return multiplyAddHalves(y, level.rowTexels()) + x;
}

// A border has an alpha of its own.
template <class Modes, class Level>
bool leavesOutAlpha(const Place<Modes>& place, const Level& level)
{
    return leavesOut::alpha && level.isOpaque() && !hasBorder(place.modes);
}

template <class Fetch, class Modes, class Level>
[[gnu::always_inline]] inline float4 nearestOn(const Place<Modes>& place, const Level& level)
{
    const Int x = nearestPosition(place.modes.u, place.u, level.sideU());
    const Int y = nearestPosition(place.modes.v, place.v, level.sideV());
    if (hasBorder(place.modes)) [[unlikely]]
        return texelOrBorder<Fetch>(place.sampler, level, x, y);
    return Fetch::nearest(level, texelIndex(level, x, y));
}

template <class Fetch, class Modes, class Level>
[[gnu::always_inline]] inline float4 bilinearOn(const Place<Modes>& place, const Level& level, const Pairs& at)
{
    if (hasBorder(place.modes)) [[unlikely]]
        return bilinearWithBorder<Fetch>(place.sampler, level, at);
    return Fetch::bilinear(level, texelIndex(level, at.x, at.y), at.fx, at.fy);
}

// --- on one or several levels, of textures and of cube maps ---
//
// A place is one on a texture, a Place, or one on a cube map (cube_place.h): it has `sampler`, `texture` and
// withLanes(), and the functions of its own above, pairsOn, nearestOn, bilinearOn and leavesOutAlpha.

template <class Fetch, class SomePlace, class Level>
[[gnu::always_inline]] inline float4 sampleLevel(const SomePlace& place, const Level& level)
{
    if (place.sampler.filter == Filter::nearest) return nearestOn<Fetch>(place, level);
    const Pairs at = pairsOn(place, level);
    return leavesOutAlpha(place, level) ? bilinearOn<Opaque<Fetch>>(place, level, at)
                                        : bilinearOn<Fetch>(place, level, at);
}

// Both levels' texels are located before the first is fetched: the processor has something to do while the first
// addresses are on their way through memory.
template <class Fetch, class SomePlace, class Level>
[[gnu::always_inline]] inline float4 sampleBetween(const SomePlace& place, const Level& finer, const Level& coarser,
                                                   Float t)
{
    const Pairs onFiner = pairsOn(place, finer), onCoarser = pairsOn(place, coarser);
    const float4 a = bilinearOn<Fetch>(place, finer, onFiner);
    const float4 b = bilinearOn<Fetch>(place, coarser, onCoarser);
    return mixEach<Fetch>(a, b, t);
}

// The levels of these numbers.
template <class Levels>
const MipLevel& levelOf(const Levels& levels, int number, unsigned)
{
    return levels.level(number);
}
template <class Levels>
LaneLevels levelOf(const Levels& levels, Int number, unsigned lanes)
{
    return LaneLevels(levels, number, lanes);
}

// The numbers of those that follow. A lane that takes no part of its next level need not have it built.
inline int coarserThan(int number, Int, int levelCount)
{
    return leavesOut::coarserLevel ? number + 1 : std::min(number + 1, levelCount - 1);
}
inline Int coarserThan(Int number, Int fraction, int levelCount)
{
    const Int next = min(number + 1, levelCount - 1);
    return leavesOut::coarserLevel ? select(fraction != 0, next, number) : next;
}

// Level `number`, of all lanes or of each, and with the trilinear filter the part of the next one that `fraction`
// (0..255) says; `lanes` are those that the result is for.
template <class Fetch, class SomePlace, class Number>  // int, Int
[[gnu::always_inline]] inline float4 sampleLevels(const SomePlace& place, Number number, Int fraction, unsigned lanes)
{
    const auto& levels = place.texture;
    const auto& finer = levelOf(levels, number, lanes);
    const bool hasOneLevel = leavesOut::coarserLevel && ((fraction != 0).bits() & lanes) == 0;
    if (place.sampler.filter != Filter::trilinear || hasOneLevel) return sampleLevel<Fetch>(place, finer);
    const auto& coarser = levelOf(levels, coarserThan(number, fraction, levels.levelCount()), lanes);
    const Float t = Float(fraction) * (1.0f / kLodOne);
    return leavesOutAlpha(place, finer) && coarser.isOpaque() ? sampleBetween<Opaque<Fetch>>(place, finer, coarser, t)
                                                              : sampleBetween<Fetch>(place, finer, coarser, t);
}

// Each lane on its own level. `place` is the place's lanes: they travel in registers, where a place would in memory.
template <class Fetch, class SomePlace, class Sampler, class Levels, class... Lanes>
[[gnu::noinline]] void sampleSeveralLevels(float4& result, const Sampler& sampler, const Levels& texture, Int level,
                                           Int fraction, Lanes... place)
{
    result = sampleLevels<Fetch>(SomePlace{sampler, texture, place...}, level, fraction, wantedLanes() & kAllLanes);
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
    float4 result;
    place.withLanes([&](auto... lanes) __attribute__((always_inline)) {
        sampleSeveralLevels<Fetch, SomePlace>(result, place.sampler, place.texture, level, fraction, lanes...);
    });
    return result;
}

}  // namespace relief::inline RELIEF_WIDTH

// Where a cube map's sample lies: the face that a direction meets, the place on it, the level of detail, and the texels
// of a level around it. For the sampler (cube_sampler.cpp), and for who tells of it (trace/sample_trace.cpp).
#pragma once

#include <limits>

#include "relief/texture/cube_sampler.h"
#include "relief/texture/level_of_detail.h"
#include "relief/texture/sampler_steps.h"

namespace relief::inline RELIEF_WIDTH {

inline const CubeMap& textureOf(const samplerCUBE& s)
{
    return s.texture != nullptr ? *s.texture : CubeMap::white();
}

// A direction with a face: finite, and not 0.
inline float3 finiteDirection(const float3& direction)
{
    constexpr float largest = std::numeric_limits<float>::max();
    const Float sum = abs(direction.x) + abs(direction.y) + abs(direction.z);
    if (all((sum > 0.0f) & (sum <= largest))) [[likely]]
        return direction;
    const auto number = [](Float x) { return clamp(select(isnan(x), Float(0.0f), x), -largest, largest); };
    const float3 d = {number(direction.x), number(direction.y), number(direction.z)};
    const Mask isZero = (d.x == 0.0f) & (d.y == 0.0f) & (d.z == 0.0f);
    return {d.x, d.y, select(isZero, Float(1.0f), d.z)};
}

// Where a direction meets a face. s and t are -1..1, the quotients of components.
struct Meeting
{
    explicit Meeting(const float3& direction) : face(direction)
    {
        const float3 along = face.components(direction);
        middle = along.z;
        s = along.x / middle;
        t = along.y / middle;
    }

    // How far s and t go where the direction changes by so much: (x / z)' = x' / z - (x / z) z' / z, which has no
    // squares that could overflow.
    float2 change(const float3& difference) const
    {
        const float3 along = face.components(difference);
        const Float z = along.z / middle;
        return {along.x / middle - s * z, along.y / middle - t * z};
    }

    CubeFaceOf face;
    Float middle, s, t;
};

inline bool usesMipLevels(const samplerCUBE& s, const CubeMap& texture)
{
    return s.mipmaps && texture.levelCount() > 1;
}

// The square of the longer of the direction's two changes, in texels of level 0.
[[gnu::always_inline]] inline Float squareOfChange(const CubeMap& texture, const Meeting& at, const float3& dx,
                                                   const float3& dy)
{
    const float perUnit = 0.5f * static_cast<float>(texture.side());
    return longestSquare(at.change(dx) * perUnit, at.change(dy) * perUnit);
}

// A place on a cube map, for filter.h.
struct CubePlace
{
    const samplerCUBE& sampler;
    const CubeMap& texture;
    Float u, v;  // 0..1 on its face, from the lower left corner
    Int face;

    // Calls function(u, v, face), all of it that is lanes.
    template <class Function>
    [[gnu::always_inline]] void withLanes(const Function& function) const
    {
        function(u, v, face);
    }
};

// The frame goes on where the face ends, as a repeated texture does.
template <class Level>
[[gnu::always_inline]] inline Pairs pairsOn(const CubePlace& place, const Level& level)
{
    const auto& side = level.sideU();
    const AddressMode mode = place.sampler.seamless ? AddressMode::wrap : AddressMode::clamp;
    const Int x = pairPosition(mode, place.u, side), y = pairPosition(mode, place.v, side);
    return {x >> kSubtexelBits, y >> kSubtexelBits, x & kSubtexelMask, y & kSubtexelMask};
}

template <class Level>
inline Int texelIndexOn(const CubePlace& place, const Level& level, Int x, Int y)
{
    return texelIndex(level, x, place.face * (level.width() + 2) + y);
}

template <class Fetch, class Level>
[[gnu::always_inline]] inline float4 nearestOn(const CubePlace& place, const Level& level)
{
    const Int x = nearestPosition(AddressMode::clamp, place.u, level.sideU());
    const Int y = nearestPosition(AddressMode::clamp, place.v, level.sideU());
    return Fetch::nearest(level, texelIndexOn(place, level, x, y));
}

template <class Fetch, class Level>
[[gnu::always_inline]] inline float4 bilinearOn(const CubePlace& place, const Level& level, const Pairs& at)
{
    return Fetch::bilinear(level, texelIndexOn(place, level, at.x, at.y), at.fx, at.fy);
}

template <class Level>
bool leavesOutAlpha(const CubePlace&, const Level& level)
{
    return leavesOut::alpha && level.isOpaque();
}

inline CubePlace placeOn(const samplerCUBE& s, const CubeMap& texture, const Meeting& at)
{
    return {s, texture, at.s * 0.5f + 0.5f, at.t * 0.5f + 0.5f, at.face.face()};
}

}  // namespace relief::inline RELIEF_WIDTH

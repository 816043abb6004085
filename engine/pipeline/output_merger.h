// The output merger: depth test, blending and format conversion of one block. The functions are templates on what they
// do, so that a draw that does not blend or test has no code for it.
#pragma once

#include "hlsl/intrinsics.h"
#include "pipeline/render_state.h"
#include "pipeline/tile.h"
#include "texture/color_space.h"

namespace relief {

template <Compare compare>
Mask compareDepth(Float z, Float stored)
{
    switch (compare) {
        case Compare::never:
            return Mask(false);
        case Compare::less:
            return z < stored;
        case Compare::equal:
            return z == stored;
        case Compare::lessEqual:
            return z <= stored;
        case Compare::greater:
            return z > stored;
        case Compare::notEqual:
            return z != stored;
        case Compare::greaterEqual:
            return z >= stored;
        case Compare::always:
            break;
    }
    return Mask(true);
}

// Whether the bounds alone show that no pixel of a triangle between the two depths can pass.
template <Compare compare>
bool isHidden(float nearest, float farthest, const DepthBounds& stored)
{
    switch (compare) {
        case Compare::less:
            return nearest >= stored.farthest;
        case Compare::lessEqual:
            return nearest > stored.farthest;
        case Compare::greater:
            return farthest <= stored.nearest;
        case Compare::greaterEqual:
            return farthest < stored.nearest;
        case Compare::equal:
            return nearest > stored.farthest || farthest < stored.nearest;
        default:
            return false;
    }
}

// After pixels between the two depths were tested and written. `whole`: every pixel of the block took part.
template <Compare compare>
void updateBounds(float nearest, float farthest, bool whole, DepthBounds& stored)
{
    constexpr bool keepsNearer = compare == Compare::less || compare == Compare::lessEqual;
    constexpr bool keepsFarther = compare == Compare::greater || compare == Compare::greaterEqual;
    if (keepsNearer && whole && farthest < stored.farthest) stored.farthest = farthest;
    if (keepsFarther && whole && nearest > stored.nearest) stored.nearest = nearest;
    if (!keepsNearer && farthest > stored.farthest) stored.farthest = farthest;
    if (!keepsFarther && nearest < stored.nearest) stored.nearest = nearest;
}

// FLOAT -> UNORM8: NaN to 0, clamp, scale, round half up (D3D 11.3, 3.2.3.6).
inline Int toUnorm8(Float c)
{
    return Int(native::truncateToInt((saturate(c) * 255.0f + 0.5f).value));
}

inline Int packRgba8(const float4& c)
{
    return toUnorm8(c.x) | toUnorm8(c.y) << 8 | toUnorm8(c.z) << 16 | toUnorm8(c.w) << 24;
}

inline float4 unpackRgba8(Int packed)
{
    const auto channel = [packed](int shift) { return Float(shiftRightLogical(packed, shift) & 255) / 255.0f; };
    return {channel(0), channel(8), channel(16), channel(24)};
}

inline float4 encodeSrgb(const float4& c)
{
    return {linearToSrgb(c.x), linearToSrgb(c.y), linearToSrgb(c.z), c.w};
}

// Decodes by the exact table of 256 values; only blending onto an sRGB target needs it.
inline float4 decodeSrgb8(Int packed)
{
    std::int32_t codes[kLanes];
    packed.store(codes);
    float linear[3][kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        for (int i = 0; i < 3; ++i) {
            linear[i][lane] = srgbToLinear(static_cast<std::uint8_t>(codes[lane] >> (8 * i)));
        }
    }
    return {Float::load(linear[0]), Float::load(linear[1]), Float::load(linear[2]), unpackRgba8(packed).w};
}

template <Blend blend>
float4 blendColors(const float4& source, const float4& destination)
{
    if constexpr (blend == Blend::additive) return source + destination;
    // Not as lerp(): d + (s - d) loses an opaque s where d is much brighter, and s - d can overflow.
    if constexpr (blend == Blend::alpha) return source * source.w + destination * (1.0f - source.w);
    return source;
}

// No NaN and no infinity enters a target: NaN becomes 0, infinities the largest finite number. Returns how many live
// pixels had one.
inline int sanitizeColor(float4& color, Mask live)
{
    // All exponent bits are set in NaN and infinities, and in nothing that is made of numbers below 2.
    constexpr std::int32_t exponent = 0x7f800000;
    const Int together = asInt(color.x) | asInt(color.y) | asInt(color.z) | asInt(color.w);
    if (none(live & ((together & exponent) == exponent))) [[likely]]
        return 0;

    const float largest = std::numeric_limits<float>::max();
    Mask finite = true;
    for (int c = 0; c < 4; ++c) finite &= abs(color[c]) <= largest;
    const Mask invalid = live & !finite;
    if (none(invalid)) return 0;
    for (int c = 0; c < 4; ++c) {
        color[c] = select(isnan(color[c]), Float(0.0f), clamp(color[c], -largest, largest));
    }
    return count(invalid);
}

// Blends the colours of a block's live pixels into the tile. Colours are linear.
template <Blend blend>
void mergeColor(Tile& tile, int block, float4 color, Mask live)
{
    if (tile.format() == ColorFormat::rgba32f) {
        float* stored = tile.color32f(block);
        float4 old;
        for (int c = 0; c < 4; ++c) old[c] = Float::load(stored + c * kLanes);
        if constexpr (blend != Blend::off) {
            color = blendColors<blend>(color, old);
            sanitizeColor(color, live);  // sums may overflow
        }
        for (int c = 0; c < 4; ++c) select(live, color[c], old[c]).store(stored + c * kLanes);
        return;
    }
    const bool srgb = tile.format() == ColorFormat::rgba8Srgb;
    std::int32_t* stored = tile.color8(block);
    const Int old = Int::load(stored);
    if constexpr (blend != Blend::off) {
        color = blendColors<blend>(saturate(color), srgb ? decodeSrgb8(old) : unpackRgba8(old));
    }
    select(live, packRgba8(srgb ? encodeSrgb(color) : color), old).store(stored);
}

}  // namespace relief

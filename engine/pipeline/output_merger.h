// The output merger: depth test and blending of one block. What a draw's state asks for is a branch a block, always the
// same way for a draw: next to nothing.
#pragma once

#include "pipeline/format.h"
#include "pipeline/render_state.h"
#include "pipeline/tile.h"

namespace relief::inline RELIEF_WIDTH {

inline Mask compareDepth(Compare compare, Float z, Float stored)
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
inline bool isHidden(Compare compare, float nearest, float farthest, const DepthBounds& stored)
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
inline void updateBounds(Compare compare, float nearest, float farthest, bool whole, DepthBounds& stored)
{
    const bool keepsNearer = compare == Compare::less || compare == Compare::lessEqual;
    const bool keepsFarther = compare == Compare::greater || compare == Compare::greaterEqual;
    if (keepsNearer && whole && farthest < stored.farthest) stored.farthest = farthest;
    if (keepsFarther && whole && nearest > stored.nearest) stored.nearest = nearest;
    if (!keepsNearer && farthest > stored.farthest) stored.farthest = farthest;
    if (!keepsFarther && nearest < stored.nearest) stored.nearest = nearest;
}

inline float4 blendColors(Blend blend, const float4& source, const float4& destination)
{
    if (blend == Blend::additive) return source + destination;
    // Not as lerp(): d + (s - d) loses an opaque s where d is much brighter, and s - d can overflow.
    if (blend == Blend::alpha) return source * source.w + destination * (1.0f - source.w);
    return source;
}

// Four numbers a lane as they lie in memory.
using Channels = float[4][kLanes];
inline float4 loadChannels(const Channels& c)
{
    return {Float::load(c[0]), Float::load(c[1]), Float::load(c[2]), Float::load(c[3])};
}

// A colour's channels in memory: NaN becomes 0, infinities the largest finite number. Returns how many live pixels had
// one.
[[gnu::noinline]] inline int replaceInvalid(Channels& channels, Mask live)
{
    const float largest = std::numeric_limits<float>::max();
    Mask finite = true;
    for (float(&channel)[kLanes] : channels) {
        const Float c = Float::load(channel);
        finite &= abs(c) <= largest;
        select(isnan(c), Float(0.0f), clamp(c, -largest, largest)).store(channel);
    }
    return count(live & !finite);
}

// No NaN and no infinity enters a target: they are replaced. Returns how many live pixels had one. The rare case is in
// a function of its own, so that the colour of all others stays in registers.
inline int sanitizeColor(float4& color, Mask live)
{
    // All exponent bits are set in NaN and infinities, and in nothing that is made of numbers below 2.
    constexpr std::int32_t exponent = 0x7f800000;
    const Int together = asInt(color.x) | asInt(color.y) | asInt(color.z) | asInt(color.w);
    if (none(live & ((together & exponent) == exponent))) [[likely]]
        return 0;
    alignas(Float) Channels channels;
    color.x.store(channels[0]);
    color.y.store(channels[1]);
    color.z.store(channels[2]);
    color.w.store(channels[3]);
    const int invalid = replaceInvalid(channels, live);
    color = loadChannels(channels);
    return invalid;
}

// A block's words in a tile.
template <Format format>
struct StoredColor
{
    std::array<Int, static_cast<std::size_t>(wordsPerPixel(format))> words{};

    static StoredColor load(const std::int32_t* from)
    {
        StoredColor stored;
        for (std::size_t i = 0; i < stored.words.size(); ++i) stored.words[i] = Int::load(from + i * kLanes);
        return stored;
    }
    void store(std::int32_t* to, Mask where, const StoredColor& elsewhere) const
    {
        for (std::size_t i = 0; i < words.size(); ++i)
            select(where, words[i], elsewhere.words[i]).store(to + i * kLanes);
    }
};

// Without blending: the colours of one block after the other into their words in a tile. Neighbours often have one
// colour, and then its words are there already.
template <Format format>
class ColorWriter
{
public:
    // The words of a block's colours, linear, which stay where they are until the next call. Returns how many of the
    // live pixels, a bit each, had a NaN or an infinity.
    int encode(const Channels& channels, unsigned live)
    {
        float4 color = loadChannels(channels);
        if (last != nullptr && isSame(color, loadChannels(*last))) return 0;
        // In all lanes: other pixels may be live in the next block.
        const bool isFinite = sanitizeColor(color, true) == 0;
        encoded.words = encodeColor<format>(color);
        last = isFinite ? &channels : nullptr;
        if (isFinite) [[likely]]
            return 0;
        color = loadChannels(channels);
        return sanitizeColor(color, Mask::fromBits(live));
    }

    // Writes them where a block is live.
    void store(std::int32_t* words, Mask live) const { encoded.store(words, live, StoredColor<format>::load(words)); }

private:
    static bool isSame(const float4& a, const float4& b)
    {
        const auto changed = [](Float x, Float y) { return asInt(x) ^ asInt(y); };
        return none((changed(a.x, b.x) | changed(a.y, b.y) | changed(a.z, b.z) | changed(a.w, b.w)) != 0);
    }

    const Channels* last = nullptr;
    StoredColor<format> encoded;
};

// With it: a block's live pixels, linear and finite.
template <Format format>
void blendOnto(std::int32_t* words, Blend blend, float4 color, Mask live)
{
    const auto old = StoredColor<format>::load(words);
    color = blendColors(blend, isUnorm(format) ? saturate(color) : color, decodeColor<format>(old.words));
    if (!isUnorm(format)) sanitizeColor(color, live);  // sums may overflow
    StoredColor<format>{encodeColor<format>(color)}.store(words, live, old);
}

}  // namespace relief::inline RELIEF_WIDTH

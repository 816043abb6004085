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

// Merges the colours of one block after the other into their words in a tile. Colours are linear.
template <Format format>
class ColorMerger
{
public:
    explicit ColorMerger(Blend blending) : blend(blending) {}

    // Of a block's live pixels. Returns how many of them had a NaN or an infinity.
    int merge(std::int32_t* stored, const float4& color, Mask live)
    {
        Words old;
        for (std::size_t i = 0; i < kWords; ++i) old[i] = Int::load(stored + i * kLanes);
        const int invalid = blend == Blend::off ? encodeUnlessSame(color, live) : blendWith(old, color, live);
        for (std::size_t i = 0; i < kWords; ++i) select(live, words[i], old[i]).store(stored + i * kLanes);
        return invalid;
    }

private:
    static constexpr std::size_t kWords = static_cast<std::size_t>(wordsPerPixel(format));
    using Words = std::array<Int, kWords>;

    // Neighbouring blocks often have one colour, and then the words are there already.
    int encodeUnlessSame(const float4& color, Mask live)
    {
        const auto changed = [&](int c) { return asInt(color[c]) ^ asInt(last[c]); };
        if (hasLast && none((changed(0) | changed(1) | changed(2) | changed(3)) != 0)) return 0;
        last = color;
        float4 finite = color;
        // In all lanes: other pixels may be live in the next block.
        hasLast = sanitizeColor(finite, true) == 0;
        words = encodeColor<format>(finite);
        float4 counted = color;
        return hasLast ? 0 : sanitizeColor(counted, live);
    }

    int blendWith(const Words& old, float4 color, Mask live)
    {
        const int invalid = sanitizeColor(color, live);
        color = blendColors(blend, isUnorm(format) ? saturate(color) : color, decodeColor<format>(old));
        if (!isUnorm(format)) sanitizeColor(color, live);  // sums may overflow
        words = encodeColor<format>(color);
        return invalid;
    }

    Blend blend;
    bool hasLast = false;
    float4 last{0.0f};
    Words words{};
};

}  // namespace relief::inline RELIEF_WIDTH

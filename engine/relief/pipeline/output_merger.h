// The output merger: depth bounds, stencil, blending and colours of one block; draw.cpp compares the depths. What a
// draw's state asks for is a branch a block, always the same way for a draw: next to nothing.
#pragma once

#include <algorithm>

#include "relief/pipeline/format.h"
#include "relief/pipeline/render_state.h"
#include "relief/pipeline/tile.h"

namespace relief::inline RELIEF_WIDTH {

// What an operation makes of 8-bit stencils.
inline Int operate(StencilOp op, Int old, int reference)
{
    switch (op) {
        case StencilOp::keep:
            break;
        case StencilOp::zero:
            return 0;
        case StencilOp::replace:
            return reference;
        case StencilOp::incrementClamp:
            return min(old + 1, Int(255));
        case StencilOp::decrementClamp:
            return max(old - 1, Int(0));
        case StencilOp::invert:
            return old ^ 255;
        case StencilOp::incrementWrap:
            return (old + 1) & 255;
        case StencilOp::decrementWrap:
            return (old - 1) & 255;
    }
    return old;
}

// Which pixels pass the stencil test.
inline Mask testStencil(const Stencil& state, const StencilFace& face, Int stored)
{
    return compareBy(face.test, Int(state.reference & state.readMask), stored & state.readMask);
}

// What is stored after both tests: `tested` pixels took part, `passed` the stencil test, `drawn` the depth test, too.
inline Int stencilAfter(const Stencil& state, const StencilFace& face, Int stored, Mask tested, Mask passed, Mask drawn)
{
    Int result = stored;
    const auto apply = [&](StencilOp op, Mask where) {
        result = select(where, operate(op, stored, state.reference), result);
    };
    apply(face.fail, tested & !passed);
    apply(face.depthFail, passed & !drawn);
    apply(face.pass, drawn);
    return (stored & (255 - state.writeMask)) | (result & state.writeMask);
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

// Whether they show that every pixel passes.
inline bool isInFront(Compare compare, float nearest, float farthest, const DepthBounds& stored)
{
    switch (compare) {
        case Compare::less:
            return farthest < stored.nearest;
        case Compare::lessEqual:
            return farthest <= stored.nearest;
        case Compare::greater:
            return nearest > stored.farthest;
        case Compare::greaterEqual:
            return nearest >= stored.farthest;
        default:
            return compare == Compare::always;
    }
}

// After pixels between the two depths were tested and written. `whole`: every pixel of the block took part. Minima and
// maxima, not branches: nobody can foresee which triangle is nearer. std::min and std::max give their first operand
// where it is NaN.
inline void updateBounds(Compare compare, float nearest, float farthest, bool whole, DepthBounds& stored)
{
    const bool keepsNearer = compare == Compare::less || compare == Compare::lessEqual;
    const bool keepsFarther = compare == Compare::greater || compare == Compare::greaterEqual;
    if (keepsNearer && whole) stored.farthest = std::min(stored.farthest, farthest);
    if (keepsFarther && whole) stored.nearest = std::max(stored.nearest, nearest);
    if (!keepsNearer) stored.farthest = std::max(stored.farthest, farthest);
    if (!keepsFarther) stored.nearest = std::min(stored.nearest, nearest);
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
// one. A function of its own for what is rare, so that all other colours stay in registers.
[[gnu::noinline]] inline int replaceInvalid(const Channels& from, Channels& to, Mask live)
{
    const float largest = std::numeric_limits<float>::max();
    Mask finite = true;
    for (std::size_t i = 0; i < 4; ++i) {
        const Float c = Float::load(from[i]);
        finite &= abs(c) <= largest;
        select(isnan(c), Float(0.0f), clamp(c, -largest, largest)).store(to[i]);
    }
    return count(live & !finite);
}

// Where a colour may have a NaN or an infinity: all exponent bits are set in these, and in nothing that is made of
// numbers below 2.
inline Mask mayBeInvalid(const float4& color)
{
    constexpr std::int32_t exponent = 0x7f800000;
    const Int together = asInt(color.x) | asInt(color.y) | asInt(color.z) | asInt(color.w);
    return (together & exponent) == exponent;
}

// No NaN and no infinity enters a target: they are replaced. Returns how many live pixels had one.
inline int sanitizeColor(float4& color, Mask live)
{
    if (none(live & mayBeInvalid(color))) [[likely]]
        return 0;
    alignas(Float) Channels channels;
    color.x.store(channels[0]);
    color.y.store(channels[1]);
    color.z.store(channels[2]);
    color.w.store(channels[3]);
    const int invalid = replaceInvalid(channels, channels, live);
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
    void store(std::int32_t* to) const
    {
        for (std::size_t i = 0; i < words.size(); ++i) words[i].store(to + i * kLanes);
    }
    void store(std::int32_t* to, Mask where, const StoredColor& elsewhere) const
    {
        for (std::size_t i = 0; i < words.size(); ++i)
            select(where, words[i], elsewhere.words[i]).store(to + i * kLanes);
    }
};

// Encodes what replaceInvalid() gave; a function of its own for the same reason.
template <Format format>
[[gnu::noinline]] StoredColor<format> encodeReplaced(const Channels& channels)
{
    return {encodeColor<format>(loadChannels(channels))};
}

// Without blending: the colours of one block after the other into their words in a tile. Neighbours often have one
// colour, and then its words are there already.
template <Format format>
class ColorWriter
{
public:
    // `areOfLarge`: whether the blocks are of large triangles. In small ones a block says nothing about the next one,
    // and to look for the same colours, or for whole blocks, costs more than it leaves out.
    explicit ColorWriter(bool areOfLarge) : whole(areOfLarge ? kAllLanes : ~0u) {}

    // A block's live pixels, a bit each, linear; `color` stays where it is until the next call. Returns how many of
    // them had a NaN or an infinity.
    int write(std::int32_t* words, const Channels& color, unsigned live)
    {
        const int invalid = set(color, live);
        store(words, live);
        return invalid;
    }

    // The two steps of it, for a colour that goes to several samples.
    int set(const Channels& color, unsigned live) { return isSame(color) ? 0 : encode(color, live); }
    void store(std::int32_t* words, unsigned live) const
    {
        if (live == whole)
            encoded.store(words);
        else
            encoded.store(words, Mask::fromBits(live), StoredColor<format>::load(words));
    }

private:
    bool isSame(const Channels& color) const
    {
        if (last == nullptr) return false;
        const auto same = [&](int i) { return asInt(Float::load(color[i])) == asInt(Float::load((*last)[i])); };
        return all(same(0) & same(1) & same(2) & same(3));
    }

    // In all lanes: other pixels may be live in the next block.
    int encode(const Channels& channels, unsigned live)
    {
        const float4 color = loadChannels(channels);
        if (any(mayBeInvalid(color))) [[unlikely]] {
            alignas(Float) Channels replaced;
            const int invalid = replaceInvalid(channels, replaced, Mask::fromBits(live));
            last = nullptr;
            encoded = encodeReplaced<format>(replaced);
            return invalid;
        }
        if (whole == kAllLanes) last = &channels;
        encoded.words = encodeColor<format>(color);
        return 0;
    }

    unsigned whole;  // live lanes that are worth a branch: all, or none
    const Channels* last = nullptr;
    StoredColor<format> encoded;
};

// With it: a block's live pixels, linear and finite.
template <Format format>
void blendInto(std::int32_t* words, Blend blend, float4 color, Mask live)
{
    const auto old = StoredColor<format>::load(words);
    color = blendColors(blend, isUnorm(format) ? saturate(color) : color, decodeColor<format>(old.words));
    if (!isUnorm(format)) sanitizeColor(color, live);  // sums may overflow
    StoredColor<format>{encodeColor<format>(color)}.store(words, live, old);
}

}  // namespace relief::inline RELIEF_WIDTH

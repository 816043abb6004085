// Texture addresses: from a texture coordinate to the texel or the 2x2 texels that it means, along one axis. First the
// range is reduced, in floats, so that no coordinate is too large for an integer; then the position is converted to
// fixed point, and the rest is integers (D3D 11.3, 7.18.4 to 7.18.9). NaN and, where a texture repeats, infinities give
// texel 0.
//
// Positions count from the frame's first texel (see mip_chain.h): texel i is at i + 1.
#pragma once

#include "relief/lanes/float.h"

namespace relief::inline RELIEF_WIDTH {

// What a texture looks like outside 0..1: repeated, repeated with every other copy mirrored, its edge texels drawn out,
// or one colour.
enum class AddressMode
{
    wrap,
    mirror,
    clamp,
    border
};

// Positions between texels are rounded to 1/4096 of a texel (D3D asks for 1/256). The weights of a bilinear fetch are
// then k/4096 with k < 4096: never 1, so that no rounding can carry a result beyond the texels it lies between. And a
// coordinate that means a texel's centre, but is a rounded quotient, gives exactly that texel: for sides up to 1024,
// and every power of two.
inline constexpr int kSubtexelBits = 12;
inline constexpr int kSubtexels = 1 << kSubtexelBits;
inline constexpr int kSubtexelMask = kSubtexels - 1;

// For the nearest texel, 1/256: there the centre is far away and the edge counts. Any side up to kMaxTextureSide has
// u = k/side in texel k.
inline constexpr int kNearestBits = 8;

// A texture's side along an axis, in texels and in the steps of positions. Both are exact, and at hand: a fetch need
// not compute them.
struct TextureSide
{
    explicit TextureSide(int side) : texels(side), subtexels(static_cast<float>(side) * static_cast<float>(kSubtexels))
    {
    }

    int texels;
    float subtexels;
};

// One for each lane, where lanes are on levels of different sizes.
struct TextureSides
{
    Int texels;
    Float subtexels;
};

// The coordinate brought into the range that the conversion to fixed point is safe for: one period where the texture
// repeats, else all that differs. It does not depend on the level. NaN stays or becomes 0.
[[gnu::always_inline]] inline Float reduceRange(AddressMode mode, Float u)
{
    switch (mode) {
        case AddressMode::wrap:
            return u - floor(u);  // 1 for u = -1e-8: the same place as 0
        case AddressMode::mirror: {
            const Float half = u * 0.5f;  // a picture and its mirror image
            return (half - floor(half)) * 2.0f;
        }
        case AddressMode::clamp:
            return clamp(u, 0.0f, 1.0f);
        case AddressMode::border:
            return select(isnan(u), u, clamp(u, -1.0f, 2.0f));  // outside is outside
    }
    return u;
}

// The position of the first of the two texels that a bilinear fetch lies between, and 1/4096 of the way to the second,
// in one number: position * 4096 + fraction. Position is in 0..side for wrap and 1..side for clamp and mirror (the last
// with fraction 0); in the border mode it can be outside.
template <class Side>  // TextureSide, TextureSides
[[gnu::always_inline]] inline Int pairPosition(AddressMode mode, Float reduced, const Side& side)
{
    // Half a texel back from the edge to the centre, one on for the frame.
    const Float position = reduced * side.subtexels + static_cast<float>(kSubtexels / 2);
    const Float number = select(position == position, position, static_cast<float>(kSubtexels));
    const Int rounded = Int(native::roundToInt(number.value));
    if (mode == AddressMode::wrap || mode == AddressMode::border) return rounded;
    const Int folded =
        mode == AddressMode::mirror ? min(rounded, (2 * side.texels + 1) * kSubtexels - rounded) : rounded;
    return clamp(folded, kSubtexels, side.texels * kSubtexels);
}

// The position of the nearest texel, in 1..side + 1 for wrap (the last is the frame's copy of the first texel), 1..side
// for clamp and mirror; in the border mode it can be outside.
template <class Side>
inline Int nearestPosition(AddressMode mode, Float reduced, const Side& side)
{
    constexpr int one = 1 << kNearestBits;
    const Float position =
        reduced * (side.subtexels * (static_cast<float>(one) / kSubtexels)) + static_cast<float>(one);
    const Float number = select(position == position, position, static_cast<float>(one));
    const Int rounded = Int(native::roundToInt(number.value)) >> kNearestBits;
    if (mode == AddressMode::wrap || mode == AddressMode::border) return rounded;
    const Int folded = mode == AddressMode::mirror ? min(rounded, 2 * side.texels + 1 - rounded) : rounded;
    return clamp(folded, 1, side.texels);
}

}  // namespace relief::inline RELIEF_WIDTH

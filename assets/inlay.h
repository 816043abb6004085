// Brass letters in a wall of bricks: the maps of one material that is several (bricks.h has its heights). The joints
// are in their own shadow, the letters are metal, and of every other brick the letter glows.
#pragma once

#include "bricks.h"

namespace textures {

// What lies at one texel; each 0..1.
struct Inlay
{
    float brick = 0;   // 0 in the joints
    float letter = 0;  // 1 where the stone is cut out and filled with metal
    float glow = 0;    // along the middle of the strokes of some
};

inline Inlay inlayAt(int x, int y)
{
    const BrickPlace place = placeInBrick(x, y);
    const float u = (static_cast<float>(x) + 0.5f) / kSize, v = (static_cast<float>(y) + 0.5f) / kSize;
    const float ragged = 3.0f * fractal(u, v, 24, 24, 3, 0.6f, 211);
    const float outside = outsideOfBox(place.x, place.y, kBrickWidth / 2 - 6, kBrickHeight / 2 - 6, 8) + ragged;
    const float stroke = fromLetter(place.x, place.y);
    const bool glows = place.brick % 4 == 0 || place.brick % 4 == 3;  // one of each row, from row to row the other one
    return {1.0f - smoothstep(-8.0f, 0.0f, outside), 1.0f - smoothstep(7.5f, 9.0f, stroke),
            glows ? 1.0f - smoothstep(2.0f, 4.5f, stroke) : 0.0f};
}

inline Colour inlayColour(int x, int y)
{
    constexpr Colour kBrass = {214, 168, 92};
    return mix(brickColour(x, y), kBrass, inlayAt(x, y).letter);
}

// Metallic in red, occlusion in green, where detail is in blue; smoothness is alpha.
struct Mask
{
    float metallic = 0, occlusion = 0, detail = 0, smoothness = 0;
};

inline Mask inlayMask(int x, int y)
{
    const Inlay at = inlayAt(x, y);
    const float u = (static_cast<float>(x) + 0.5f) / kSize, v = (static_cast<float>(y) + 0.5f) / kSize;
    const float stone = 0.18f + 0.10f * fractal(u, v, 16, 16, 4, 0.6f, 223);
    const float metal = 0.84f + 0.10f * fractal(u, v, 12, 12, 3, 0.6f, 241);
    // Light is kept out of joints, and of the edge around a letter.
    const float around = smoothstep(7.0f, 12.0f, fromLetter(placeInBrick(x, y).x, placeInBrick(x, y).y));
    const float rim = mix(0.55f, 1.0f, std::max(around, at.letter));
    return {at.letter, mix(0.25f, rim, at.brick), 1.0f - at.letter, mix(0.05f, mix(stone, metal, at.letter), at.brick)};
}

inline Colour inlayEmission(int x, int y)
{
    const float glow = inlayAt(x, y).glow;
    return {255.0f * glow, 120.0f * glow, 24.0f * glow};
}

}  // namespace textures

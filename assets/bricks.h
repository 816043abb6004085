// A brick wall: two bricks in a row, four rows, every other row shifted by half a brick. Each brick has an R cut into
// it, which looks like itself from no other side: a turned or mirrored picture shows. Row 0 of the picture is on top.
#pragma once

#include "noise.h"

namespace textures {

inline constexpr float kBrickWidth = 256, kBrickHeight = 128;  // texels, with half of the joints around it

// A texel's place in its brick, from the brick's middle: x to the right, y up.
struct BrickPlace
{
    float x = 0, y = 0;
    std::uint32_t brick = 0;  // a number of its own for each
};

inline BrickPlace placeInBrick(int x, int y)
{
    const int row = y / static_cast<int>(kBrickHeight);
    const float shifted = static_cast<float>(x) + 0.5f + (row % 2 == 1 ? kBrickWidth / 2 : 0);
    const int column = static_cast<int>(shifted / kBrickWidth) % 2;
    return {shifted - (std::floor(shifted / kBrickWidth) + 0.5f) * kBrickWidth,
            (static_cast<float>(row) + 0.5f) * kBrickHeight - static_cast<float>(y) - 0.5f,
            static_cast<std::uint32_t>(2 * row + column)};
}

// Texels outside of a rectangle of these half sizes with rounded corners; negative inside.
inline float outsideOfBox(float x, float y, float halfWidth, float halfHeight, float corner)
{
    const float dx = std::fabs(x) - halfWidth + corner, dy = std::fabs(y) - halfHeight + corner;
    const float ax = std::max(dx, 0.0f), ay = std::max(dy, 0.0f);
    return std::sqrt(ax * ax + ay * ay) + std::min(std::max(dx, dy), 0.0f) - corner;
}

// Texels from the line between two points.
inline float fromLine(float x, float y, float x0, float y0, float x1, float y1)
{
    const float dx = x1 - x0, dy = y1 - y0;
    const float along = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy);
    const float t = std::clamp(along, 0.0f, 1.0f);
    const float ex = x - x0 - t * dx, ey = y - y0 - t * dy;
    return std::sqrt(ex * ex + ey * ey);
}

// Texels from the strokes of an R, 76 texels high: an upright, a bow and a leg.
inline float fromLetter(float x, float y)
{
    const float upright = fromLine(x, y, -22, -38, -22, 38);
    const float bow = x < 4 ? std::min(fromLine(x, y, -22, 38, 4, 38), fromLine(x, y, -22, 0, 4, 0))
                            : std::fabs(std::sqrt((x - 4) * (x - 4) + (y - 19) * (y - 19)) - 19);
    const float leg = fromLine(x, y, 2, 0, 24, -38);
    return std::min(std::min(upright, bow), leg);
}

// 0 in the joints, about 0.9 on the bricks, 0.45 in the letters.
inline float brickHeight(int x, int y)
{
    const BrickPlace place = placeInBrick(x, y);
    const float u = (static_cast<float>(x) + 0.5f) / kSize, v = (static_cast<float>(y) + 0.5f) / kSize;
    const float ragged = 3.0f * fractal(u, v, 24, 24, 3, 0.6f, 211);
    const float outside = outsideOfBox(place.x, place.y, kBrickWidth / 2 - 6, kBrickHeight / 2 - 6, 8) + ragged;
    const float brick = 1.0f - smoothstep(-12.0f, 0.0f, outside);
    const float letter = 1.0f - smoothstep(5.0f, 11.0f, fromLetter(place.x, place.y));
    const float rough = 0.10f * fractal(u, v, 16, 16, 4, 0.6f, 223);
    const float mortar = 0.06f + 0.12f * fractal(u, v, 48, 48, 2, 0.6f, 227);
    return std::clamp(mix(mortar, 0.88f - 0.45f * letter + rough, brick), 0.0f, 1.0f);
}

inline Colour brickColour(int x, int y)
{
    constexpr Colour kMortar = {176, 168, 156};
    constexpr Colour kRed = {158, 84, 64};
    constexpr Colour kBrown = {120, 70, 58};
    constexpr Colour kOrange = {190, 112, 78};
    const BrickPlace place = placeInBrick(x, y);
    const float u = (static_cast<float>(x) + 0.5f) / kSize, v = (static_cast<float>(y) + 0.5f) / kSize;
    const float shade = static_cast<float>(hash(place.brick, 0, 239) % 1000u) / 999.0f;
    const float ragged = 3.0f * fractal(u, v, 24, 24, 3, 0.6f, 211);
    const float outside = outsideOfBox(place.x, place.y, kBrickWidth / 2 - 6, kBrickHeight / 2 - 6, 8) + ragged;
    const float letter = 1.0f - smoothstep(5.0f, 11.0f, fromLetter(place.x, place.y));

    Colour colour = shade < 0.5f ? mix(kBrown, kRed, 2 * shade) : mix(kRed, kOrange, 2 * shade - 1);
    colour = mix(colour, kBrown, 0.45f * smoothstep(-0.1f, 0.6f, fractal(u, v, 6, 6, 4, 0.6f, 229)));
    colour = mix(colour, kMortar, 0.75f * letter);
    colour = mix(kMortar, colour, 1.0f - smoothstep(-5.0f, 0.0f, outside));
    const float grain = 26.0f * fractal(u, v, 64, 64, 3, 0.7f, 233);
    for (float& channel : colour) channel += grain;
    return colour;
}

}  // namespace textures

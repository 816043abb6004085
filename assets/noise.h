// What the textures are made of: noise from integer hashes and nothing but + - * / sqrt on top, so that every machine
// makes the same bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace textures {

inline constexpr int kSize = 512;  // texels; a power of two, so that coordinates wrap by a mask

inline std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t seed)
{
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ seed * 0xc2b2ae3du;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

inline float mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

// 0 below `low`, 1 above `high`, smooth in between.
inline float smoothstep(float low, float high, float x)
{
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// Gradient noise (K. Perlin, "Improving noise", 2002), about -0.7..0.7, with eight directions. `cells` of them lie in
// 0..1 along x and along y, after which it repeats.
inline float noise(float x, float y, int cellsX, int cellsY, std::uint32_t seed)
{
    constexpr float kDiagonal = 0.70710678f;
    constexpr std::array<std::array<float, 2>, 8> kDirections = {{{1, 0},
                                                                  {kDiagonal, kDiagonal},
                                                                  {0, 1},
                                                                  {-kDiagonal, kDiagonal},
                                                                  {-1, 0},
                                                                  {-kDiagonal, -kDiagonal},
                                                                  {0, -1},
                                                                  {kDiagonal, -kDiagonal}}};
    const float scaledX = x * static_cast<float>(cellsX);
    const float scaledY = y * static_cast<float>(cellsY);
    const int cellX = static_cast<int>(std::floor(scaledX));
    const int cellY = static_cast<int>(std::floor(scaledY));
    const float tx = scaledX - static_cast<float>(cellX);
    const float ty = scaledY - static_cast<float>(cellY);
    const auto wrap = [](int cell, int cells) { return static_cast<std::uint32_t>((cell % cells + cells) % cells); };
    const auto corner = [&](int dx, int dy) {
        const auto& d = kDirections[hash(wrap(cellX + dx, cellsX), wrap(cellY + dy, cellsY), seed) % 8];
        return d[0] * (tx - static_cast<float>(dx)) + d[1] * (ty - static_cast<float>(dy));
    };
    const auto blend = [](float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); };
    return mix(mix(corner(0, 0), corner(1, 0), blend(tx)), mix(corner(0, 1), corner(1, 1), blend(tx)), blend(ty));
}

// Octaves of half the size and `gain` times the height each.
inline float fractal(float x, float y, int cellsX, int cellsY, int octaves, float gain, std::uint32_t seed)
{
    float sum = 0;
    float amplitude = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += amplitude * noise(x, y, cellsX << octave, cellsY << octave, seed + static_cast<std::uint32_t>(octave));
        amplitude *= gain;
    }
    return sum;
}

using Colour = std::array<float, 3>;  // sRGB codes, 0..255

inline Colour mix(const Colour& a, const Colour& b, float t)
{
    return {mix(a[0], b[0], t), mix(a[1], b[1], t), mix(a[2], b[2], t)};
}

}  // namespace textures

// What the tests of the sampler share: random textures of all formats, and a reference in double that follows the
// definitions (D3D 11.3, 7.18.4 to 7.18.9) texel by texel, with none of the sampler's shortcuts.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "relief/hlsl/derivatives.h"
#include "relief/texture/sampler.h"
#include "relief/texture/shading_scope.h"
#include "stability.h"

namespace sampler_fixture {

using namespace relief;
using stability::measured;
using stability::trials;

// Random numbers, the same on every run.
class Random
{
public:
    explicit Random(std::uint32_t seed) : state(seed) {}
    std::uint32_t bits()
    {
        state = state * 1664525u + 1013904223u;
        return state >> 8;
    }
    float operator()(float low, float high) { return low + (high - low) * static_cast<float>(bits()) / 16777216.0f; }

private:
    std::uint32_t state;
};

inline Texture randomTexture(TexelFormat format, int width, int height, std::uint32_t seed = 1)
{
    Random random(seed);
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
    if (format == TexelFormat::rgba8) {
        std::vector<std::uint8_t> pixels(count);
        for (auto& p : pixels) p = static_cast<std::uint8_t>(random.bits() >> 8);
        return *Texture::fromRgba8(width, height, pixels, ColorSpace::linear);
    }
    if (format == TexelFormat::rgba16) {
        std::vector<std::uint16_t> pixels(count);
        for (auto& p : pixels) p = static_cast<std::uint16_t>(random.bits());
        return *Texture::fromRgba16(width, height, pixels, ColorSpace::linear);
    }
    std::vector<float> pixels(format == TexelFormat::r32Float ? count / 4 : count);
    for (auto& p : pixels) p = random(-1.0f, 1.0f);
    if (format == TexelFormat::r32Float) return *Texture::fromRed(width, height, pixels);
    return *Texture::fromRgbaFloat(width, height, pixels);
}

inline constexpr TexelFormat kColorFormats[] = {TexelFormat::rgba8, TexelFormat::rgba16, TexelFormat::rgba32Float};
inline constexpr TexelFormat kFormats[] = {TexelFormat::rgba8, TexelFormat::rgba16, TexelFormat::rgba32Float,
                                           TexelFormat::r32Float};
inline constexpr AddressMode kModes[] = {AddressMode::wrap, AddressMode::mirror, AddressMode::clamp,
                                         AddressMode::border};
inline constexpr Filter kFilters[] = {Filter::nearest, Filter::bilinear, Filter::trilinear};

// The texel that index i means on an axis of n texels; -1 is the border.
inline int address(AddressMode mode, int i, int n)
{
    const auto modulo = [](int a, int b) { return (a % b + b) % b; };
    switch (mode) {
        case AddressMode::wrap:
            return modulo(i, n);
        case AddressMode::mirror:
            return modulo(i, 2 * n) < n ? modulo(i, 2 * n) : 2 * n - 1 - modulo(i, 2 * n);
        case AddressMode::clamp:
            return std::min(std::max(i, 0), n - 1);
        case AddressMode::border:
            return i < 0 || i >= n ? -1 : i;
    }
    return 0;
}

// Channel c of a texel of a level, in 0..1.
inline double texelOf(const sampler2D& s, const MipLevel& level, int x, int y, int c)
{
    const int i = address(s.u, x, level.width()), j = address(s.v, y, level.height());
    if (i < 0 || j < 0) return static_cast<double>(s.borderColor[c]);
    switch (s.texture->format()) {
        case TexelFormat::rgba8:
            return level.texel<std::uint8_t>(i, j)[c] / 255.0;
        case TexelFormat::rgba16:
            return level.texel<std::uint16_t>(i, j)[c] / 65535.0;
        case TexelFormat::rgba32Float:
            return static_cast<double>(level.texel<float>(i, j)[c]);
        case TexelFormat::r32Float:
            break;
    }
    return c == 0 ? static_cast<double>(*level.texel<float>(i, j)) : c == 3 ? 1.0 : 0.0;
}

inline double referenceNearest(const sampler2D& s, const MipLevel& level, double u, double v, int c)
{
    const int x = static_cast<int>(std::floor(u * level.width())), y = static_cast<int>(std::floor(v * level.height()));
    return texelOf(s, level, x, y, c);
}

inline double referenceBilinear(const sampler2D& s, const MipLevel& level, double u, double v, int c)
{
    const double x = u * level.width() - 0.5, y = v * level.height() - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double fx = x - i, fy = y - j;
    const double lower = texelOf(s, level, i, j, c) * (1.0 - fx) + texelOf(s, level, i + 1, j, c) * fx;
    const double upper = texelOf(s, level, i, j + 1, c) * (1.0 - fx) + texelOf(s, level, i + 1, j + 1, c) * fx;
    return lower * (1.0 - fy) + upper * fy;
}

// One coordinate for all lanes.
inline float4 lodSample(const sampler2D& s, float u, float v, float lod = 0.0f)
{
    return tex2Dlod(s, {Float(u), Float(v), Float(0.0f), Float(lod)});
}

inline bool sameBits(const float4& a, const float4& b, int lane)
{
    for (int c = 0; c < 4; ++c) {
        if (asInt(a[c])[lane] != asInt(b[c])[lane]) return false;
    }
    return true;
}

// f(lane) in every lane. Through memory, because g++ 12 takes lanes that are set one by one for uninitialized.
template <class Function>
Float perLane(Function f)
{
    float lanes[kLanes];
    for (int i = 0; i < kLanes; ++i) lanes[i] = f(i);
    return Float::load(lanes);
}

// 0, 1, 2, ...
inline Int laneNumbers()
{
    std::int32_t lanes[kLanes];
    for (int i = 0; i < kLanes; ++i) lanes[i] = i;
    return Int::load(lanes);
}

// Lanes that count, for as long as it lives.
struct ActiveLanes
{
    explicit ActiveLanes(unsigned lanes) { shading.activeLanes = lanes; }
    ~ActiveLanes() { shading.activeLanes = kAllLanes; }
    ActiveLanes(const ActiveLanes&) = delete;
    ActiveLanes& operator=(const ActiveLanes&) = delete;
};

}  // namespace sampler_fixture

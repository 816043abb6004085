// A height map whose slopes are known: a sine wave, straight or across, and the texture of it.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "relief/texture/texture.h"

namespace relief::experiments {

// h(u, v) = 1/2 + 1/2 sin(2 pi d / period), d = u cos(angle) + v sin(angle): texels. Heights count `scale` times: the
// steepest slope is 1.
struct HeightWave
{
    double period = 64.0, angle = 0.0;

    double frequency() const { return 2.0 * std::numbers::pi / period; }
    double scale() const { return 2.0 / frequency(); }
    double phase(double u, double v) const { return frequency() * (u * std::cos(angle) + v * std::sin(angle)); }
    double height(double u, double v = 0.0) const { return 0.5 + 0.5 * std::sin(phase(u, v)); }
    double slopeU(double u, double v = 0.0) const { return std::cos(angle) * std::cos(phase(u, v)); }
    double slopeV(double u, double v = 0.0) const { return std::sin(angle) * std::cos(phase(u, v)); }
};

inline constexpr int kWaveTexels = 256;  // on a side
// Both fit the texture a whole number of times.
inline const HeightWave kWaveAlong, kWaveAcross{64.0 / std::numbers::sqrt2, std::numbers::pi / 4.0};

// To so many bits, as a file stores it; 0: not at all.
inline double quantized(double value, int bits)
{
    if (bits == 0) return value;
    const double codes = std::ldexp(1.0, bits) - 1.0;
    return std::floor(value * codes + 0.5) / codes;
}

// The heights at the texels' centres: 8 and 16 bits, or 0 for floats.
inline std::shared_ptr<const Texture> waveTexture(const HeightWave& wave, int bits)
{
    const auto pixels = [&](auto pixel) {
        std::vector<decltype(pixel(0.0))> all;
        for (int row = kWaveTexels - 1; row >= 0; --row) {  // files begin with the upper row
            for (int column = 0; column < kWaveTexels; ++column)
                all.insert(all.end(), 4, pixel(wave.height(column + 0.5, row + 0.5)));
        }
        return all;
    };
    Expected<Texture> texture = fail("");
    if (bits == 8) {
        texture = Texture::fromRgba8(kWaveTexels, kWaveTexels,
                                     pixels([](double h) { return static_cast<std::uint8_t>(h * 255.0 + 0.5); }),
                                     ColorSpace::linear);
    } else if (bits == 16) {
        texture = Texture::fromRgba16(kWaveTexels, kWaveTexels,
                                      pixels([](double h) { return static_cast<std::uint16_t>(h * 65535.0 + 0.5); }),
                                      ColorSpace::linear);
    } else {
        texture =
            Texture::fromRgbaFloat(kWaveTexels, kWaveTexels, pixels([](double h) { return static_cast<float>(h); }));
    }
    return std::make_shared<const Texture>(std::move(*texture));
}

}  // namespace relief::experiments

// sRGB and linear light. In: the codes of an 8- or 16-bit image, decoded once when a texture is made of it. Out: the
// linear colour of a pixel, encoded when the framebuffer is written. Both follow IEC 61966-2-1 as D3D 11.3 states it
// (3.2.3.7 and 3.2.3.8), from exact operations alone, so that the bits are the same everywhere.
#pragma once

#include <array>
#include <cstdint>

#include "relief/lanes/float.h"

namespace relief {

// What the numbers of an image mean: colours as a monitor shows them, or plain numbers (heights, normals, masks).
enum class ColorSpace
{
    linear,
    srgb
};

// The linear value, in 0..1, of an encoded one in 0..1. Relative error below 1e-15.
double decodeSrgb(double encoded);

namespace color_space {
extern const std::array<float, 256> kSrgbToLinear;
}

// The linear value of an 8-bit code: decodeSrgb(code / 255) rounded to the nearest float. srgbToLinear(0) is 0,
// srgbToLinear(255) is 1.
inline float srgbToLinear(std::uint8_t code)
{
    return color_space::kSrgbToLinear[code];
}

// The same in 16 bits, rounded to nearest: what a texture holds. Half a step of 1/65535 is 0.025 of an 8-bit sRGB code
// where the curve is steepest (the first 10 codes), and less everywhere else.
std::uint16_t srgbToLinear16(std::uint8_t code);
std::uint16_t srgbToLinear16(std::uint16_t code);

// The encoded value, in 0..1, of a linear one. Below 0 and NaN become 0, above 1 becomes 1. Rounded to 8 bits it is at
// most 0.51 of a code away from the exact curve (D3D 11.3, 3.2.3.8 allows 0.6), never decreases, and takes each of the
// 256 decoded codes back to itself.
//
// The curve's upper part is 1.055 x^(1/2.4) - 0.055. As a function of q = x^(1/4) it is nearly straight, and a fourth
// root is two square roots, which are exact: the polynomial is a minimax fit in q over [0.0031308^(1/4), 1], absolute
// error below 3.5e-5 (0.009 of an 8-bit code).
inline Float linearToSrgb(Float linear)
{
    const Float x = saturate(linear);
    const Float q = sqrt(sqrt(x));
    Float p = 0.08132997538f;
    p = p * q - 0.3355015547f;
    p = p * q + 1.12268162f;
    p = p * q + 0.1961358677f;
    p = p * q - 0.06461153786f;
    const float join = 0.0031308f;
    return select(x > join, clamp(p, join * 12.92f, 1.0f), x * 12.92f);  // no step back where the two parts meet
}

}  // namespace relief

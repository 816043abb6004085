// From linear colours in lanes to the words that a target's format stores, and back.
#pragma once

#include <array>

#include "relief/hlsl/intrinsics.h"
#include "relief/pipeline/framebuffer.h"
#include "relief/texture/color_space.h"

namespace relief::inline RELIEF_WIDTH {

// FLOAT -> UNORM8: NaN to 0 and clamp, which saturate() does, scale, round half up (D3D 11.3, 3.2.3.6). The last two:
inline Int codeOf(Float saturated)
{
    return Int(native::truncateToInt((saturated * 255.0f + 0.5f).value));
}

// Of numbers in 0 ... 1.
inline Int packRgba8(const float4& c)
{
    return codeOf(c.x) | codeOf(c.y) << 8 | codeOf(c.z) << 16 | codeOf(c.w) << 24;
}

inline float4 unpackRgba8(Int packed)
{
    const auto channel = [packed](int shift) { return Float(shiftRightLogical(packed, shift) & 255) / 255.0f; };
    return {channel(0), channel(8), channel(16), channel(24)};
}

// Numbers in 0 ... 1.
inline float4 encodeSrgb(const float4& c)
{
    return {linearToSrgb(c.x), linearToSrgb(c.y), linearToSrgb(c.z), saturate(c.w)};
}

// Decodes by the exact table of 256 values; only blending onto an sRGB target needs it.
inline float4 decodeSrgb8(Int packed)
{
    std::int32_t codes[kLanes];
    packed.store(codes);
    float linear[3][kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        for (int i = 0; i < 3; ++i) {
            linear[i][lane] = srgbToLinear(static_cast<std::uint8_t>(codes[lane] >> (8 * i)));
        }
    }
    return {Float::load(linear[0]), Float::load(linear[1]), Float::load(linear[2]), unpackRgba8(packed).w};
}

// FLOAT -> half in the low 16 bits, to nearest, ties to even; clamped to +-65504, NaN to -65504.
inline Int toHalf(Float c)
{
    const Float limited = clamp(c, -65504.0f, 65504.0f);
    const Int sign = shiftRightLogical(asInt(limited), 16) & 0x8000;
    const Int bits = asInt(abs(limited));
    // Below 2^-14 halves are multiples of 2^-24, and so are the floats from 0.5 to 1: the sum rounds.
    const Int small = asInt(abs(limited) + 0.5f) - asInt(Float(0.5f));
    const Int rounded = shiftRightLogical(bits - (112 << 23) + 0xfff + (shiftRightLogical(bits, 13) & 1), 13);
    return sign | select(bits < (113 << 23), small, rounded);
}

// Finite halves, in the low 16 bits; exact.
inline Float fromHalf(Int half)
{
    const Float magnitude = asFloat((half & 0x7fff) << 13) * 0x1p112f;  // the exponents' biases differ by 112
    return asFloat(asInt(magnitude) | (half & 0x8000) << 16);
}

// A block's colours as words of the format: the first words of all lanes, then the second ones.
template <Format format>
std::array<Int, static_cast<std::size_t>(wordsPerPixel(format))> encodeColor(const float4& color)
{
    if constexpr (format == Format::rgba8) return {packRgba8(saturate(color))};
    if constexpr (format == Format::rgba8Srgb) return {packRgba8(encodeSrgb(color))};
    if constexpr (format == Format::rgba16f)
        return {toHalf(color.x) | toHalf(color.y) << 16, toHalf(color.z) | toHalf(color.w) << 16};
    if constexpr (format == Format::rgba32f) return {asInt(color.x), asInt(color.y), asInt(color.z), asInt(color.w)};
    if constexpr (format == Format::r32f || !isColor(format)) return {asInt(color.x)};
}

// Back again. What a format does not have is (0, 0, 0, 1).
template <Format format>
float4 decodeColor(const std::array<Int, static_cast<std::size_t>(wordsPerPixel(format))>& words)
{
    if constexpr (format == Format::rgba8) return unpackRgba8(words[0]);
    if constexpr (format == Format::rgba8Srgb) return decodeSrgb8(words[0]);
    if constexpr (format == Format::rgba16f)
        return {fromHalf(words[0] & 0xffff), fromHalf(shiftRightLogical(words[0], 16)), fromHalf(words[1] & 0xffff),
                fromHalf(shiftRightLogical(words[1], 16))};
    if constexpr (format == Format::rgba32f)
        return {asFloat(words[0]), asFloat(words[1]), asFloat(words[2]), asFloat(words[3])};
    if constexpr (format == Format::r32f || !isColor(format))
        return {asFloat(words[0]), Float(0.0f), Float(0.0f), Float(1.0f)};
}

// Calls function.operator()<format>().
template <class Function>
auto withFormat(Format format, const Function& function)
{
    switch (format) {
        case Format::rgba8:
            return function.template operator()<Format::rgba8>();
        case Format::rgba8Srgb:
            return function.template operator()<Format::rgba8Srgb>();
        case Format::rgba16f:
            return function.template operator()<Format::rgba16f>();
        case Format::r32f:
            return function.template operator()<Format::r32f>();
        case Format::rgba32f:
            return function.template operator()<Format::rgba32f>();
        case Format::stencil8:
            return function.template operator()<Format::stencil8>();
        case Format::depth32f:
            break;
    }
    return function.template operator()<Format::depth32f>();
}

// Whether a format holds 0 ... 1 only: blending limits the source first.
constexpr bool isUnorm(Format format)
{
    return format == Format::rgba8 || format == Format::rgba8Srgb;
}

}  // namespace relief::inline RELIEF_WIDTH

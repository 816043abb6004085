// From pixels in a file's order to texels in memory, and the sRGB curve in tables.
#include "relief/texture/pixels.h"

#include <algorithm>
#include <array>
#include <variant>
#include <vector>

#include "relief/lanes/environment.h"

namespace relief {
namespace {

// Turns pixels upside down, row by row: fill(from, to, texels) writes all channels of a row.
template <class Channel, class Source, class Fill>
MipLevel importRows(TexelFormat format, int width, int height, const Source* pixels, Fill fill)
{
    MipLevel level = MipLevel::forOverwrite(format, width, height);
    for (int y = height; y-- > 0; pixels += width * channelsPerTexel(format)) {
        fill(pixels, level.texel<Channel>(0, y), width);
    }
    level.fillFrame();
    return level;
}

// As they are.
template <class Channel>
MipLevel copyPixels(TexelFormat format, int width, int height, std::span<const Channel> pixels)
{
    const int channels = channelsPerTexel(format);
    return importRows<Channel>(format, width, height, pixels.data(), [channels](auto* from, auto* to, int texels) {
        std::copy_n(from, texels * channels, to);
    });
}

// sRGB to 16 bits of linear light, by these two functions of a code.
template <class Code, class Color, class Alpha>
MipLevel decodePixels(int width, int height, std::span<const Code> rgba, Color color, Alpha alpha)
{
    return importRows<std::uint16_t>(TexelFormat::rgba16, width, height, rgba.data(),
                                     [&](const Code* from, std::uint16_t* to, int texels) {
                                         for (; texels-- > 0; from += 4, to += 4) {
                                             for (int c = 0; c < 3; ++c) to[c] = color(from[c]);
                                             to[3] = alpha(from[3]);
                                         }
                                     });
}

}  // namespace

std::string problemWithPixels(int width, int height, int channels, std::size_t numbers)
{
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > kMaxTextureSide || height > kMaxTextureSide) {
        return "a texture of " + size + " texels is not possible; each side must be in 1.." +
               std::to_string(kMaxTextureSide);
    }
    const std::size_t expected =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
    if (numbers == expected) return {};
    return std::to_string(numbers) + " numbers do not make a texture of " + size + " texels; pass width * height * " +
           std::to_string(channels) + " = " + std::to_string(expected);
}

std::string problemWithPixels(const ImageFile& picture)
{
    return std::visit(
        [](const auto& image) { return problemWithPixels(image.width, image.height, 4, image.pixels.size()); },
        picture);
}

TexelFormat formatOf(const ImageFile& picture, ColorSpace meaning)
{
    if (std::holds_alternative<ImageFloat>(picture)) return TexelFormat::rgba32Float;
    if (std::holds_alternative<Image16>(picture) || meaning == ColorSpace::srgb) return TexelFormat::rgba16;
    return TexelFormat::rgba8;
}

MipLevel levelFromRgba8(int width, int height, std::span<const std::uint8_t> rgba, ColorSpace meaning)
{
    if (meaning == ColorSpace::linear) return copyPixels(TexelFormat::rgba8, width, height, rgba);
    std::array<std::uint16_t, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = srgbToLinear16(static_cast<std::uint8_t>(i));
    return decodePixels(
        width, height, rgba, [&table](std::uint8_t code) { return table[code]; },
        [](std::uint8_t code) { return static_cast<std::uint16_t>(code * 257); });
}

MipLevel levelFromRgba16(int width, int height, std::span<const std::uint16_t> rgba, ColorSpace meaning)
{
    if (meaning == ColorSpace::linear) return copyPixels(TexelFormat::rgba16, width, height, rgba);
    return decodePixels(width, height, rgba, decodeSrgb16, [](std::uint16_t code) { return code; });
}

MipLevel levelFromRgbaFloat(int width, int height, std::span<const float> rgba)
{
    return copyPixels(TexelFormat::rgba32Float, width, height, rgba);
}

MipLevel levelFromRed(int width, int height, std::span<const float> red)
{
    return copyPixels(TexelFormat::r32Float, width, height, red);
}

MipLevel levelFromPicture(const ImageFile& picture, ColorSpace meaning)
{
    if (const auto* image = std::get_if<Image8>(&picture)) {
        return levelFromRgba8(image->width, image->height, image->pixels, meaning);
    }
    if (const auto* image = std::get_if<Image16>(&picture)) {
        return levelFromRgba16(image->width, image->height, image->pixels, meaning);
    }
    const auto& image = std::get<ImageFloat>(picture);
    return levelFromRgbaFloat(image.width, image.height, image.pixels);
}

glm::vec4 readTexel(TexelFormat format, const MipLevel& level, int x, int y)
{
    glm::vec4 r;
    for (int c = 0; c < 4; ++c) {
        switch (format) {
            case TexelFormat::rgba8:
                r[c] = static_cast<float>(level.texel<std::uint8_t>(x, y)[c]) / 255.0f;
                break;
            case TexelFormat::rgba16:
                r[c] = static_cast<float>(level.texel<std::uint16_t>(x, y)[c]) / 65535.0f;
                break;
            case TexelFormat::rgba32Float:
                r[c] = level.texel<float>(x, y)[c];
                break;
            case TexelFormat::r32Float:
                r[c] = c == 0 ? *level.texel<float>(x, y) : c == 3 ? 1.0f : 0.0f;
                break;
        }
    }
    return r;
}

// Decoding takes a fifth root per number, so every code is decoded once per process.
std::uint16_t decodeSrgb16(std::uint16_t code)
{
    static const std::vector<std::uint16_t> table = [] {
        std::vector<std::uint16_t> decoded(65536);
        for (std::size_t i = 0; i < decoded.size(); ++i) decoded[i] = srgbToLinear16(static_cast<std::uint16_t>(i));
        return decoded;
    }();
    return table[code];
}

std::uint16_t encodeSrgb16(std::uint16_t linear)
{
    static const std::vector<std::uint16_t> table = [] {
        const DefaultFloatingPoint environment;
        std::vector<std::uint16_t> encoded(65536);
        for (std::size_t i = 0; i < encoded.size(); ++i) {
            const float code = linearToSrgb(Float(static_cast<float>(i) / 65535.0f))[0];
            encoded[i] = static_cast<std::uint16_t>(code * 65535.0f + 0.5f);
        }
        return encoded;
    }();
    return table[linear];
}

}  // namespace relief

// From pixels in a file's order to texels in memory, and the sRGB curve in tables.
#include "relief/texture/pixels.h"

#include <algorithm>
#include <array>
#include <variant>
#include <vector>

#include "relief/lanes/environment.h"

namespace relief {
namespace {

// Copies pixels, turned upside down and converted one by one: convert(pixel, texel) reads and writes all channels.
template <class Channel, class Source, class Convert>
MipLevel importPixels(TexelFormat format, int width, int height, const Source* rgba, Convert convert)
{
    MipLevel level(format, width, height);
    const int channels = channelsPerTexel(format);
    for (int y = height; y-- > 0;) {
        Channel* texel = level.texel<Channel>(0, y);
        for (int x = 0; x < width; ++x, rgba += channels, texel += channels) convert(rgba, texel);
    }
    level.fillFrame();
    return level;
}

constexpr auto kCopyTexel = [](const auto* from, auto* to) { std::copy_n(from, 4, to); };

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
    if (meaning == ColorSpace::linear) {
        return importPixels<std::uint8_t>(TexelFormat::rgba8, width, height, rgba.data(), kCopyTexel);
    }
    std::array<std::uint16_t, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = srgbToLinear16(static_cast<std::uint8_t>(i));
    const auto decode = [&table](const std::uint8_t* from, std::uint16_t* to) {
        for (int c = 0; c < 3; ++c) to[c] = table[from[c]];
        to[3] = static_cast<std::uint16_t>(from[3] * 257);
    };
    return importPixels<std::uint16_t>(TexelFormat::rgba16, width, height, rgba.data(), decode);
}

MipLevel levelFromRgba16(int width, int height, std::span<const std::uint16_t> rgba, ColorSpace meaning)
{
    if (meaning == ColorSpace::linear) {
        return importPixels<std::uint16_t>(TexelFormat::rgba16, width, height, rgba.data(), kCopyTexel);
    }
    const auto decode = [](const std::uint16_t* from, std::uint16_t* to) {
        for (int c = 0; c < 3; ++c) to[c] = decodeSrgb16(from[c]);
        to[3] = from[3];
    };
    return importPixels<std::uint16_t>(TexelFormat::rgba16, width, height, rgba.data(), decode);
}

MipLevel levelFromRgbaFloat(int width, int height, std::span<const float> rgba)
{
    return importPixels<float>(TexelFormat::rgba32Float, width, height, rgba.data(), kCopyTexel);
}

MipLevel levelFromRed(int width, int height, std::span<const float> red)
{
    const auto copy = [](const float* from, float* to) { *to = *from; };
    return importPixels<float>(TexelFormat::r32Float, width, height, red.data(), copy);
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

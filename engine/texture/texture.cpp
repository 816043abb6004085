// Textures from pixels, and their mip levels on demand.
#include "texture/texture.h"

#include <algorithm>
#include <string>
#include <vector>

namespace relief {
namespace {

// What is wrong with a picture that cannot become a texture; nothing, where the message is empty.
std::string problemWith(int width, int height, std::size_t numbers)
{
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > kMaxTextureSide || height > kMaxTextureSide) {
        return "a texture of " + size + " texels is not possible; each side must be in 1.." +
               std::to_string(kMaxTextureSide);
    }
    const std::size_t expected = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
    if (numbers == expected) return {};
    return std::to_string(numbers) + " numbers do not make a texture of " + size +
           " texels; pass width * height * 4 = " + std::to_string(expected);
}

// Copies pixels, turned upside down and converted one by one: convert(pixel, texel) reads and writes four channels.
template <class Channel, class Source, class Convert>
MipLevel importPixels(TexelFormat format, int width, int height, const Source* rgba, Convert convert)
{
    MipLevel level(format, width, height);
    for (int y = height; y-- > 0;) {
        Channel* texel = level.texel<Channel>(0, y);
        for (int x = 0; x < width; ++x, rgba += 4, texel += 4) convert(rgba, texel);
    }
    level.fillFrame();
    return level;
}

constexpr auto kCopyTexel = [](const auto* from, auto* to) { std::copy_n(from, 4, to); };

// 16-bit decoding takes a fifth root per number, so every code is decoded once per process.
std::uint16_t decodeCode16(std::uint16_t code)
{
    static const std::vector<std::uint16_t> table = [] {
        std::vector<std::uint16_t> decoded(65536);
        for (std::size_t i = 0; i < decoded.size(); ++i) decoded[i] = srgbToLinear16(static_cast<std::uint16_t>(i));
        return decoded;
    }();
    return table[code];
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
        }
    }
    return r;
}

}  // namespace

Expected<Texture> Texture::fromRgba8(int width, int height, std::span<const std::uint8_t> rgba, ColorSpace meaning)
{
    if (std::string problem = problemWith(width, height, rgba.size()); !problem.empty())
        return fail(std::move(problem));
    if (meaning == ColorSpace::linear) {
        constexpr TexelFormat format = TexelFormat::rgba8;
        return Texture(format, importPixels<std::uint8_t>(format, width, height, rgba.data(), kCopyTexel));
    }
    constexpr TexelFormat format = TexelFormat::rgba16;
    std::array<std::uint16_t, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = srgbToLinear16(static_cast<std::uint8_t>(i));
    const auto decode = [&table](const std::uint8_t* from, std::uint16_t* to) {
        for (int c = 0; c < 3; ++c) to[c] = table[from[c]];
        to[3] = static_cast<std::uint16_t>(from[3] * 257);
    };
    return Texture(format, importPixels<std::uint16_t>(format, width, height, rgba.data(), decode));
}

Expected<Texture> Texture::fromRgba16(int width, int height, std::span<const std::uint16_t> rgba, ColorSpace meaning)
{
    if (std::string problem = problemWith(width, height, rgba.size()); !problem.empty())
        return fail(std::move(problem));
    constexpr TexelFormat format = TexelFormat::rgba16;
    if (meaning == ColorSpace::linear) {
        return Texture(format, importPixels<std::uint16_t>(format, width, height, rgba.data(), kCopyTexel));
    }
    const auto decode = [](const std::uint16_t* from, std::uint16_t* to) {
        for (int c = 0; c < 3; ++c) to[c] = decodeCode16(from[c]);
        to[3] = from[3];
    };
    return Texture(format, importPixels<std::uint16_t>(format, width, height, rgba.data(), decode));
}

Expected<Texture> Texture::fromRgbaFloat(int width, int height, std::span<const float> rgba)
{
    if (std::string problem = problemWith(width, height, rgba.size()); !problem.empty())
        return fail(std::move(problem));
    constexpr TexelFormat format = TexelFormat::rgba32Float;
    return Texture(format, importPixels<float>(format, width, height, rgba.data(), kCopyTexel));
}

const Texture& Texture::white()
{
    static const Texture texture =
        *fromRgba8(1, 1, std::array<std::uint8_t, 4>{255, 255, 255, 255}, ColorSpace::linear);
    return texture;
}

const Texture& Texture::grey()
{
    static const Texture texture = *fromRgba8(1, 1, std::array<std::uint8_t, 4>{128, 128, 128, 255}, ColorSpace::srgb);
    return texture;
}

const Texture& Texture::black()
{
    static const Texture texture = *fromRgba8(1, 1, std::array<std::uint8_t, 4>{0, 0, 0, 255}, ColorSpace::linear);
    return texture;
}

// In floats: no integer code is exactly one half.
const Texture& Texture::flatNormal()
{
    static const Texture texture = *fromRgbaFloat(1, 1, std::array{0.5f, 0.5f, 1.0f, 0.5f});
    return texture;
}

Texture::Texture(TexelFormat format, MipLevel finest)
    : chain(std::make_unique<Chain>()),
      firstTexel(readTexel(format, finest, 0, 0)),
      sizes(1.0f / finest.widthInFloat(), 1.0f / finest.heightInFloat(), finest.widthInFloat(), finest.heightInFloat()),
      texelFormat(format),
      columns(finest.width()),
      rows(finest.height()),
      levels(mipLevelCount(finest.width(), finest.height()))
{
    chain->levels[0] = std::move(finest);
    chain->published[0].store(&*chain->levels[0], std::memory_order_release);
}

glm::vec4 Texture::texel(int x, int y) const
{
    return readTexel(texelFormat, level(0), x, y);
}

const MipLevel& Texture::buildLevel(int k) const
{
    const std::lock_guard lock(chain->building);
    for (std::size_t i = 1; i <= static_cast<std::size_t>(k); ++i) {
        if (chain->levels[i]) continue;
        chain->levels[i] = coarserLevel(texelFormat, *chain->levels[i - 1]);
        chain->published[i].store(&*chain->levels[i], std::memory_order_release);
    }
    return *chain->levels[static_cast<std::size_t>(k)];
}

int Texture::levelsBuilt() const
{
    int built = 0;
    while (built < levels && chain->published[static_cast<std::size_t>(built)].load(std::memory_order_acquire)) ++built;
    return built;
}

}  // namespace relief

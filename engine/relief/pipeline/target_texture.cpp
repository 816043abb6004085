#include "relief/pipeline/target_texture.h"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "relief/lanes/environment.h"
#include "relief/pipeline/format.h"

namespace relief {

namespace {

// The two halves of each word as floats.
std::vector<float> decoded(std::span<const std::uint32_t> words)
{
    std::vector<float> numbers(words.size() * 2);
    for (std::size_t first = 0; first < words.size(); first += kLanes) {
        const std::size_t count = std::min<std::size_t>(kLanes, words.size() - first);
        std::int32_t some[kLanes] = {};
        for (std::size_t i = 0; i < count; ++i) some[i] = static_cast<std::int32_t>(words[first + i]);
        const Int lanes = Int::load(some);
        const Float low = fromHalf(lanes & 0xffff), high = fromHalf(shiftRightLogical(lanes, 16));
        for (std::size_t i = 0; i < count; ++i) {
            numbers[2 * (first + i)] = low[static_cast<int>(i)];
            numbers[2 * (first + i) + 1] = high[static_cast<int>(i)];
        }
    }
    return numbers;
}

}  // namespace

Expected<Texture> textureOf(const Framebuffer& target, int attachment)
{
    const DefaultFloatingPoint environment;
    const std::string name = "attachment " + std::to_string(attachment) + " of a target as a texture: ";
    const auto& attachments = target.attachments();
    if (attachment < 0 || attachment >= static_cast<int>(attachments.size()))
        return fail(name + "the target has " + std::to_string(attachments.size()) + ", counted from 0");
    const Attachment& what = attachments[static_cast<std::size_t>(attachment)];
    if (what.store == Store::texture)
        return fail(name + "it is one already, and need not be copied: the target's texture()");
    if (what.store == Store::discard)
        return fail(name + "it is discarded when a frame has run; create it with Store::keep");
    const std::span<const std::uint32_t> words = target.words(attachment);
    const int width = target.width(), height = target.height();
    // R, G, B and A: the words as they lie in memory, but for machines that put the highest byte first.
    const auto fromBytes = [&](ColorSpace space) {
        if constexpr (std::endian::native == std::endian::little) {
            return Texture::fromRgba8(width, height,
                                      {reinterpret_cast<const std::uint8_t*>(words.data()), words.size() * 4}, space);
        } else {
            std::vector<std::uint8_t> bytes;
            bytes.reserve(words.size() * 4);
            for (const std::uint32_t pixel : words) {
                for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(pixel >> shift));
            }
            return Texture::fromRgba8(width, height, bytes, space);
        }
    };
    const auto floats = [&] { return std::span(reinterpret_cast<const float*>(words.data()), words.size()); };
    switch (what.format) {
        case Format::rgba8:
            return fromBytes(ColorSpace::linear);
        case Format::rgba8Srgb:
            return fromBytes(ColorSpace::srgb);
        case Format::rgba16f:
            return Texture::fromRgbaFloat(width, height, decoded(words));
        case Format::rgba32f:
            return Texture::fromRgbaFloat(width, height, floats());
        case Format::r32f:
        case Format::depth32f:
            return Texture::fromRed(width, height, floats());
        case Format::stencil8:
            break;
    }
    return fail(name + "it is a stencil, which no sampler reads; choose a colour or the depth");
}

}  // namespace relief

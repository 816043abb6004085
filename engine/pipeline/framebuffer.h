// The render target: colour in one of three formats, and depth as 32-bit floats. Row 0 is the top row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "error.h"

namespace relief {

enum class ColorFormat
{
    rgba8,      // UNORM, written as it is
    rgba8Srgb,  // UNORM, encoded from linear colour when written, decoded when blended with
    rgba32f,
};

// A transient depth buffer lives in the tiles only, while they are drawn: nothing is written to memory. Keep it when
// something reads it afterwards, or when a later frame draws on without clearing.
enum class DepthStorage
{
    transient,
    keep
};

class Framebuffer
{
public:
    // Width and height 1 ... 16384; anything else is an error.
    static Expected<Framebuffer> create(int width, int height, ColorFormat format = ColorFormat::rgba8Srgb,
                                        DepthStorage depthStorage = DepthStorage::transient);

    int width() const { return mWidth; }
    int height() const { return mHeight; }
    ColorFormat format() const { return mFormat; }
    DepthStorage depthStorage() const { return mDepthStorage; }

    // Row by row, no padding. The 8-bit formats: R, G, B, A from the lowest byte up; empty for rgba32f. And so on.
    std::span<std::uint32_t> color8() { return mColor8; }
    std::span<const std::uint32_t> color8() const { return mColor8; }
    std::span<glm::vec4> color32f() { return mColor32f; }
    std::span<const glm::vec4> color32f() const { return mColor32f; }
    std::span<float> depth() { return mDepth; }  // empty when transient
    std::span<const float> depth() const { return mDepth; }

    // Whether colour and depth are equal, bit by bit.
    bool samePixels(const Framebuffer& other) const;

private:
    Framebuffer() = default;

    int mWidth = 0, mHeight = 0;
    ColorFormat mFormat = ColorFormat::rgba8Srgb;
    DepthStorage mDepthStorage = DepthStorage::transient;
    std::vector<std::uint32_t> mColor8;
    std::vector<glm::vec4> mColor32f;
    std::vector<float> mDepth;
};

}  // namespace relief

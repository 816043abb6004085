// One level of a texture in memory, and the next coarser one from it. What enters are texels, already linear; what
// leaves is the average over the area that each coarse texel covers, exact and then rounded once, for any size; of
// floats it is summed in double.
//
// In memory a level has a frame one texel wide, which repeats the texels of the opposite side: with it, the 2x2 texels
// of a bilinear fetch always lie side by side, also where a repeated texture meets itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "relief/texture/address.h"

namespace relief {

// Red, green, blue, alpha. The first two hold numbers in 0..1 (UNORM: code / 255, code / 65535). The last one is red
// alone, such as a depth, and is (red, 0, 0, 1) when it is sampled.
enum class TexelFormat
{
    rgba8,
    rgba16,
    rgba32Float,
    r32Float
};

constexpr int channelsPerTexel(TexelFormat format)
{
    return format == TexelFormat::r32Float ? 1 : 4;
}

constexpr int bytesPerTexel(TexelFormat format)
{
    return format == TexelFormat::rgba32Float ? 16 : format == TexelFormat::rgba16 ? 8 : 4;
}

inline constexpr int kMaxTextureSide = 16384;  // texels; D3D's own limit, and what 32-bit texel indices are safe for
inline constexpr int kMaxMipLevels = 15;       // 16384 down to 1

// floor(log2(longer side)) + 1: a 257x511 texture has 9 levels. Sides are in 1..kMaxTextureSide.
int mipLevelCount(int width, int height);

// The bytes that a level takes.
std::uint64_t levelBytes(TexelFormat format, int width, int height);

// The side of the next level: half of it, rounded down, and at least 1.
constexpr int nextSide(int side)
{
    return side > 1 ? side / 2 : 1;
}

// Lane addresses are made of these fields, so that a fetch computes as little as possible per level.
class MipLevel
{
public:
    // All texels zero. Sides are in 1..kMaxTextureSide.
    MipLevel(TexelFormat format, int width, int height);

    // Texels are not set: for who writes them all, and then fills the frame. To zero a level takes as long as to copy
    // it.
    static MipLevel forOverwrite(TexelFormat format, int width, int height);

    int width() const { return columns.texels; }
    int height() const { return rows.texels; }
    const TextureSide& sideU() const { return columns; }
    const TextureSide& sideV() const { return rows; }

    // From one row to the next, in texels, frame included. A row takes an odd number of cache lines: a column of
    // texels then walks through all sets of the cache, where rows of exactly 4096 bytes would share one set.
    int rowTexels() const { return stride; }
    std::size_t rowBytes() const { return strideInBytes; }

    // The frame's first texel. Texel (x, y), counted from the lower left of the picture, has the index
    // (y + 1) * rowTexels() + x + 1 from here; x = -1..width and y = -1..height exist.
    const std::byte* texels() const { return lines.data()->bytes; }

    // The one above it.
    const std::byte* texelsAbove() const { return texels() + strideInBytes; }

    // The channels of a texel (x = -1..width, y = -1..height), to write or read one at a time. Channel is std::uint8_t,
    // std::uint16_t or float, as the format says.
    template <class Channel>
    Channel* texel(int x, int y)
    {
        return reinterpret_cast<Channel*>(lines.data()->bytes) + offset(x, y) * (texelBytes / sizeof(Channel));
    }
    template <class Channel>
    const Channel* texel(int x, int y) const
    {
        return reinterpret_cast<const Channel*>(lines.data()->bytes) + offset(x, y) * (texelBytes / sizeof(Channel));
    }

    // Copies the texels of each side to the frame on the opposite one; what pads a row is 0. To be called once all
    // texels are written.
    void fillFrame();

    // Whether alpha is 1 in every texel of a UNORM level, known from fillFrame() on: a fetch then leaves alpha out.
    bool isOpaque() const { return opaque; }

private:
    struct alignas(64) CacheLine
    {
        CacheLine() {}  // sets nothing
        std::byte bytes[64];
    };
    struct Unset
    {
    };

    MipLevel(Unset, TexelFormat format, int width, int height);

    std::size_t offset(int x, int y) const
    {
        return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(x + 1);
    }

    std::vector<CacheLine> lines;
    TexelFormat texelFormat;
    TextureSide columns, rows;
    int stride;
    std::size_t texelBytes, strideInBytes;
    bool opaque = false;
};

// What a fetch needs of all levels of a texture, by number: lanes that are on several look it up (lane_levels.h).
struct LevelTable
{
    static constexpr int kSize = 16;
    static_assert(kSize >= kMaxMipLevels);

    alignas(64) std::int32_t width[kSize]{}, height[kSize]{}, rowTexels[kSize]{};
    const std::byte *texels[kSize]{}, *texelsAbove[kSize]{};
    bool isOpaque[kSize]{};  // this level and all before it

    // To be called for every level before anybody looks: all sizes are looked up together.
    void setSize(TexelFormat format, int number, int itsWidth, int itsHeight);

    // The level is complete, and all before it are.
    void setTexels(int number, const MipLevel& level);
};

// The next coarser level. Every coarse texel is the average of the fine area it covers: 2x2 texels where both sides
// are even; where a side is odd, 3 texels across with weights that shift from one end to the other, so that no part of
// the picture counts more than another. Sums of UNORM are exact; it is rounded to nearest.
MipLevel coarserLevel(TexelFormat format, const MipLevel& fine);

}  // namespace relief

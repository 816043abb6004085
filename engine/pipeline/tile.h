// A tile's colour and depth while one thread works on it. They are kept block by block, one value per lane, so that a
// block's colour or depth is one load; the rows of the image exist only when the finished tile is written out.
#pragma once

#include <memory>

#include "lanes/float.h"
#include "pipeline/framebuffer.h"
#include "pipeline/geometry.h"

namespace relief {

// What a depth test can know about a block without looking at its pixels. Conservative: some pixel may be nearer to the
// other bound, none lies outside.
struct DepthBounds
{
    float nearest, farthest;
};

class Tile
{
public:
    // For tiles of `size` x `size` pixels of a target of this format.
    Tile(int size, ColorFormat format);

    // Starts on the tile at pixel (x, y): from the clear values, or from what the target holds.
    void clear(int x, int y, const glm::vec4& color, float depth);
    void load(int x, int y, const Framebuffer& target, float transientDepth);

    // Writes the pixels that lie in the target.
    void store(Framebuffer& target) const;

    ColorFormat format() const { return mFormat; }
    int blockAt(int x, int y) const
    {
        const auto column = static_cast<unsigned>(x - originX), row = static_cast<unsigned>(y - originY);
        return static_cast<int>(row / kBlockHeight) * blocksWide + static_cast<int>(column / kBlockWidth);
    }

    std::int32_t* color8(int block) { return mColor8.get() + static_cast<std::size_t>(block) * kLanes; }
    float* color32f(int block)
    {
        return mColor32f.get() + static_cast<std::size_t>(block) * kLanes * 4;
    }  // R.., G.., B.., A..
    float* depth(int block) { return mDepth.get() + static_cast<std::size_t>(block) * kLanes; }
    DepthBounds& bounds(int block) { return mBounds[static_cast<std::size_t>(block)]; }

private:
    int size, blocksWide, blockCount;
    ColorFormat mFormat;
    int originX = 0, originY = 0;
    std::unique_ptr<std::int32_t[]> mColor8;
    std::unique_ptr<float[]> mColor32f;
    std::unique_ptr<float[]> mDepth;
    std::unique_ptr<DepthBounds[]> mBounds;
};

// A colour as the format stores it; only for the 8-bit formats.
std::uint32_t packColor(const glm::vec4& color, ColorFormat format);

// Fills the part of a rectangle that lies in the target, without a tile in between: where nothing is drawn.
void clearRectangle(Framebuffer& target, const Rectangle& pixels, const glm::vec4& color, float depth);

}  // namespace relief

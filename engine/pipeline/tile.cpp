#include "pipeline/tile.h"

#include <algorithm>
#include <cstring>

#include "pipeline/output_merger.h"

namespace relief {

namespace {

// Pixels that are neighbours in a row and in neighbouring lanes come in pairs: quad by quad.
template <class PixelPair>
void forEachPair(int x0, int y0, int size, const PixelPair& visit)
{
    int lane = 0;
    for (int y = 0; y < size; y += kBlockHeight) {
        for (int x = 0; x < size; x += kBlockWidth, lane += kLanes) {
            for (int i = 0; i < kLanes; i += 2) visit(x0 + x + laneX(i), y0 + y + laneY(i), lane + i);
        }
    }
}

}  // namespace

Tile::Tile(int tileSize, ColorFormat format)
    : size(tileSize),
      blocksWide(tileSize / kBlockWidth),
      blockCount(blocksWide * (tileSize / kBlockHeight)),
      mFormat(format)
{
    const auto lanes = static_cast<std::size_t>(blockCount) * kLanes;
    if (format == ColorFormat::rgba32f) {
        mColor32f = std::make_unique<float[]>(lanes * 4);
    } else {
        mColor8 = std::make_unique<std::int32_t[]>(lanes);
    }
    mDepth = std::make_unique<float[]>(lanes);
    mBounds = std::make_unique<DepthBounds[]>(static_cast<std::size_t>(blockCount));
}

void Tile::clear(int x, int y, const glm::vec4& color, float depthValue)
{
    originX = x;
    originY = y;
    const auto lanes = static_cast<std::size_t>(blockCount) * kLanes;
    if (mFormat == ColorFormat::rgba32f) {
        for (std::size_t i = 0; i < lanes * 4; ++i) mColor32f[i] = color[static_cast<int>(i / kLanes % 4)];
    } else {
        std::fill_n(mColor8.get(), lanes, static_cast<std::int32_t>(packColor(color, mFormat)));
    }
    std::fill_n(mDepth.get(), lanes, depthValue);
    std::fill_n(mBounds.get(), blockCount, DepthBounds{depthValue, depthValue});
}

void Tile::load(int x0, int y0, const Framebuffer& target, float transientDepth)
{
    clear(x0, y0, glm::vec4(0.0f), transientDepth);
    const int width = target.width();
    forEachPair(x0, y0, size, [&](int px, int py, int lane) {
        for (int i = 0; i < 2; ++i, ++px, ++lane) {
            if (px >= width || py >= target.height()) return;
            const auto pixel =
                static_cast<std::size_t>(py) * static_cast<std::size_t>(width) + static_cast<std::size_t>(px);
            if (mFormat == ColorFormat::rgba32f) {
                for (int c = 0; c < 4; ++c) {
                    mColor32f[static_cast<std::size_t>(lane / kLanes * 4 * kLanes + c * kLanes + lane % kLanes)] =
                        target.color32f()[pixel][c];
                }
            } else {
                mColor8[static_cast<std::size_t>(lane)] = static_cast<std::int32_t>(target.color8()[pixel]);
            }
            if (!target.depth().empty()) mDepth[static_cast<std::size_t>(lane)] = target.depth()[pixel];
        }
    });
    if (target.depth().empty()) return;
    for (int block = 0; block < blockCount; ++block) {
        const auto [low, high] = std::minmax_element(depth(block), depth(block) + kLanes);
        bounds(block) = {*low, *high};
    }
}

namespace {

// Copies blocks of pixels, row after row each, to the rows of an image. `store` puts block b's into an array.
template <class Pixel, class Store>
void storeRows(int width, int height, int blocksWide, std::size_t stride, Pixel* target, const Store& store)
{
    for (int y = 0; y < height; y += kBlockHeight) {
        for (int x = 0; x < width; x += kBlockWidth) {
            Pixel rows[kLanes];
            store(y / kBlockHeight * blocksWide + x / kBlockWidth, rows);
            Pixel* corner = target + static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
            const auto copy = [&](int columns, int count) {
                for (int row = 0; row < count; ++row) {
                    std::memcpy(corner + static_cast<std::size_t>(row) * stride, rows + row * kBlockWidth,
                                static_cast<std::size_t>(columns) * sizeof(Pixel));
                }
            };
            if (x + kBlockWidth <= width && y + kBlockHeight <= height) {
                copy(kBlockWidth, kBlockHeight);  // with the sizes as constants
            } else {
                copy(std::min(kBlockWidth, width - x), std::min(kBlockHeight, height - y));
            }
        }
    }
}

}  // namespace

void Tile::store(Framebuffer& target) const
{
    const auto stride = static_cast<std::size_t>(target.width());
    const std::size_t first = static_cast<std::size_t>(originY) * stride + static_cast<std::size_t>(originX);
    const int width = std::min(size, target.width() - originX), height = std::min(size, target.height() - originY);
    const auto lane = [](int block) { return static_cast<std::size_t>(block) * kLanes; };
    if (mFormat == ColorFormat::rgba32f) {
        storeRows(width, height, blocksWide, stride, target.color32f().data() + first, [&](int block, glm::vec4* rows) {
            const float* r = mColor32f.get() + lane(block) * 4;
            for (int i = 0; i < kLanes; ++i) {
                rows[laneY(i) * kBlockWidth + laneX(i)] = {r[i], r[kLanes + i], r[2 * kLanes + i], r[3 * kLanes + i]};
            }
        });
    } else {
        storeRows(width, height, blocksWide, stride, reinterpret_cast<std::int32_t*>(target.color8().data()) + first,
                  [&](int block, std::int32_t* rows) { inRows(Int::load(mColor8.get() + lane(block))).store(rows); });
    }
    if (!target.depth().empty()) {
        storeRows(width, height, blocksWide, stride, target.depth().data() + first, [&](int block, float* rows) {
            asFloat(inRows(asInt(Float::load(mDepth.get() + lane(block))))).store(rows);
        });
    }
}

void clearRectangle(Framebuffer& target, const Rectangle& pixels, const glm::vec4& color, float depth)
{
    const Rectangle inside = intersect(pixels, {0, 0, target.width(), target.height()});
    const auto stride = static_cast<std::size_t>(target.width());
    const auto count = static_cast<std::size_t>(inside.x1 - inside.x0);
    const bool isFloat = target.format() == ColorFormat::rgba32f;
    const std::uint32_t packed = isFloat ? 0 : packColor(color, target.format());
    for (int y = inside.y0; y < inside.y1; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(inside.x0);
        if (isFloat) {
            std::fill_n(target.color32f().data() + row, count, color);
        } else {
            std::fill_n(target.color8().data() + row, count, packed);
        }
        if (!target.depth().empty()) std::fill_n(target.depth().data() + row, count, depth);
    }
}

std::uint32_t packColor(const glm::vec4& color, ColorFormat format)
{
    const float4 c = broadcast(color);
    return static_cast<std::uint32_t>(packRgba8(format == ColorFormat::rgba8Srgb ? encodeSrgb(c) : c)[0]);
}

}  // namespace relief

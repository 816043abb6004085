#include "pipeline/tile.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "pipeline/format.h"

namespace relief {

namespace {

// The value that an attachment is cleared to; false where it is not.
bool clearValue(const Attachment& attachment, const Clear& clear, std::int32_t (&words)[4])
{
    if (attachment.format == Format::depth32f) {
        if (clear.depth) words[0] = std::bit_cast<std::int32_t>(*clear.depth);
        return clear.depth.has_value();
    }
    if (clear.color) packColor(*clear.color, attachment.format, words);
    return clear.color.has_value();
}

// Copies blocks of pixels, row after row each, to the rows of an image. `words` are those of a pixel.
template <int words>
void storeRows(int width, int height, int blocksWide, std::size_t stride, const std::int32_t* blocks,
               std::uint32_t* target)
{
    constexpr std::size_t pixelBytes = words * sizeof(std::uint32_t);
    for (int y = 0; y < height; y += kBlockHeight) {
        for (int x = 0; x < width; x += kBlockWidth) {
            const std::int32_t* block = blocks + (y / kBlockHeight * blocksWide + x / kBlockWidth) * kLanes * words;
            std::int32_t rows[kLanes * words];
            if constexpr (words == 1) {
                inRows(Int::load(block)).store(rows);
            } else {
                for (int i = 0; i < kLanes; ++i) {
                    for (int c = 0; c < words; ++c)
                        rows[(laneY(i) * kBlockWidth + laneX(i)) * words + c] = block[c * kLanes + i];
                }
            }
            std::uint32_t* corner = target + (static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)) * words;
            const auto copy = [&](int columns, int count) {
                for (int row = 0; row < count; ++row) {
                    std::memcpy(corner + static_cast<std::size_t>(row) * stride * words,
                                rows + row * kBlockWidth * words, static_cast<std::size_t>(columns) * pixelBytes);
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

TargetMemory::TargetMemory(Framebuffer& target)
    : width(target.width()), height(target.height()), attachments(target.attachments())
{
    for (std::size_t i = 0; i < attachments.size(); ++i) words.push_back(target.words(static_cast<int>(i)).data());
}

Tile::Tile(int tileSize, const std::vector<Attachment>& attachments)
    : size(tileSize), blocksWide(tileSize / kBlockWidth), blockCount(blocksWide * (tileSize / kBlockHeight))
{
    const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    for (const Attachment& attachment : attachments) {
        const auto words = static_cast<std::size_t>(wordsPerPixel(attachment.format));
        planes.push_back({attachment.format, std::make_unique<std::int32_t[]>(pixels * words)});
    }
    for (const Plane& plane : planes) (plane.format == Format::depth32f ? depthPlane : colorPlane) = &plane;
    mBounds = std::make_unique<DepthBounds[]>(static_cast<std::size_t>(blockCount));
}

bool Tile::isFor(const std::vector<Attachment>& attachments) const
{
    return std::equal(planes.begin(), planes.end(), attachments.begin(), attachments.end(),
                      [](const Plane& plane, const Attachment& a) { return plane.format == a.format; });
}

void Tile::begin(int x, int y, const TargetMemory& target, const Clear& clear)
{
    originX = x;
    originY = y;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        std::int32_t value[4] = {};
        const bool isCleared = clearValue(target.attachments[i], clear, value);
        const bool isPartial = x + size > target.width || y + size > target.height;
        if (isCleared || isPartial || target.words[i] == nullptr) fill(planes[i], value);
        if (!isCleared && target.words[i] != nullptr) load(planes[i], target, target.words[i]);
    }
    if (!depthPlane) return;
    if (clear.depth) {
        std::fill_n(mBounds.get(), blockCount, DepthBounds{*clear.depth, *clear.depth});
    } else {
        setBounds();
    }
}

void Tile::fill(const Plane& plane, const std::int32_t (&value)[4])
{
    const int words = wordsPerPixel(plane.format);
    if (words == 1) {
        std::fill_n(plane.words.get(), blockCount * kLanes, value[0]);
        return;
    }
    for (int block = 0; block < blockCount; ++block) {
        for (int c = 0; c < words; ++c) std::fill_n(plane.at(block) + c * kLanes, kLanes, value[c]);
    }
}

void Tile::load(const Plane& plane, const TargetMemory& target, const std::uint32_t* from)
{
    const int words = wordsPerPixel(plane.format);
    for (int block = 0; block < blockCount; ++block) {
        const int x = originX + block % blocksWide * kBlockWidth, y = originY + block / blocksWide * kBlockHeight;
        std::int32_t* to = plane.at(block);
        for (int i = 0; i < kLanes; ++i) {
            const int px = x + laneX(i), py = y + laneY(i);
            if (px >= target.width || py >= target.height) continue;
            const std::size_t pixel =
                static_cast<std::size_t>(py) * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(px);
            for (int c = 0; c < words; ++c)
                to[c * kLanes + i] = static_cast<std::int32_t>(from[pixel * static_cast<std::size_t>(words) + static_cast<std::size_t>(c)]);
        }
    }
}

void Tile::setBounds()
{
    for (int block = 0; block < blockCount; ++block) {
        const auto [low, high] = std::minmax_element(depth(block), depth(block) + kLanes);
        bounds(block) = {*low, *high};
    }
}

void Tile::store(const TargetMemory& target) const
{
    const auto stride = static_cast<std::size_t>(target.width);
    const std::size_t first = static_cast<std::size_t>(originY) * stride + static_cast<std::size_t>(originX);
    const int width = std::min(size, target.width - originX), height = std::min(size, target.height - originY);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (target.words[i] == nullptr) continue;
        const int words = wordsPerPixel(planes[i].format);
        const auto storePlane = words == 1 ? storeRows<1> : words == 2 ? storeRows<2> : storeRows<4>;
        storePlane(width, height, blocksWide, stride, planes[i].words.get(),
                   target.words[i] + first * static_cast<std::size_t>(words));
    }
}

void packColor(const glm::vec4& color, Format format, std::int32_t (&words)[4])
{
    Int lanes[4];
    encodeColor(format, broadcast(color), lanes);
    for (int i = 0; i < wordsPerPixel(format); ++i) words[i] = lanes[i][0];
}

void clearRectangle(const TargetMemory& target, const Rectangle& pixels, const Clear& clear)
{
    const Rectangle inside = intersect(pixels, {0, 0, target.width, target.height});
    if (inside.x0 >= inside.x1) return;
    const auto stride = static_cast<std::size_t>(target.width);
    const auto count = static_cast<std::size_t>(inside.x1 - inside.x0);
    for (std::size_t i = 0; i < target.words.size(); ++i) {
        std::int32_t value[4] = {};
        if (target.words[i] == nullptr || !clearValue(target.attachments[i], clear, value)) continue;
        const auto words = static_cast<std::size_t>(wordsPerPixel(target.attachments[i].format));
        for (int y = inside.y0; y < inside.y1; ++y) {
            std::uint32_t* row = target.words[i] + (static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(inside.x0)) * words;
            if (words == 1) {
                std::fill_n(row, count, static_cast<std::uint32_t>(value[0]));
                continue;
            }
            for (std::size_t k = 0; k < count * words; ++k) row[k] = static_cast<std::uint32_t>(value[k % words]);
        }
    }
}

}  // namespace relief

#include "relief/pipeline/tile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "relief/bits.h"
#include "relief/pipeline/format.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// What the attachments are cleared to, one after the other.
class ClearValues
{
public:
    explicit ClearValues(const Clear& values) : clear(values) {}

    // The next attachment's; false where it is not cleared.
    bool next(const Attachment& attachment, std::int32_t (&words)[4])
    {
        if (attachment.format == Format::depth32f) {
            if (clear.depth) words[0] = bitCast<std::int32_t>(*clear.depth);
            return clear.depth.has_value();
        }
        if (attachment.format == Format::stencil8) {
            if (clear.stencil) words[0] = *clear.stencil;
            return clear.stencil.has_value();
        }
        const std::optional<glm::vec4>& value = clear.color[colors++];
        if (value) packColor(*value, attachment.format, words);
        return value.has_value();
    }

private:
    const Clear& clear;
    std::size_t colors = 0;
};

// Part of an attachment in memory: a tile's. Goes by value, or its numbers would be read again after every pixel
// written.
template <class Word>
struct TilePixels
{
    Framebuffer::Rows<Word> rows;  // from the tile's upper left pixel on
    int width, height;             // as far as it lies in the target
    bool isTexture8;               // of rgba8
};
template <class Word>
TilePixels<Word> tilePixels(const TargetMemory& target, const std::vector<Framebuffer::Rows<Word>>& rows,
                            std::size_t attachment, int x, int y, int size)
{
    const auto [format, store] = target.attachments[attachment];
    const auto [top, stride] = rows[attachment];
    return {{top + y * stride + static_cast<std::ptrdiff_t>(x) * wordsPerPixel(format), stride},
            std::min(size, target.width - x),
            std::min(size, target.height - y),
            format == Format::rgba8 && store == Store::texture};
}

// Texels are bytes, R first: on machines that put a word's highest byte first they are turned round.
template <class Word>
void orderBytes(TilePixels<Word> target, std::int32_t* pixels, int count)
{
    if constexpr (std::endian::native != std::endian::little) {
        for (int i = 0; i < count && target.isTexture8; ++i) {
            const auto w = static_cast<std::uint32_t>(pixels[i]);
            pixels[i] = static_cast<std::int32_t>(w >> 24 | (w >> 8 & 0xff00) | (w << 8 & 0xff0000) | w << 24);
        }
    }
}

// Visits the blocks of a tile that lie in a target: visit(block, its first pixel there, columns, rows).
template <int words, class Word, class Visit>
void forEachBlock(TilePixels<Word> pixels, int blocksWide, const Visit& visit)
{
    for (int y = 0; y < pixels.height; y += kBlockHeight) {
        int block = y / kBlockHeight * blocksWide;
        for (int x = 0; x < pixels.width; x += kBlockWidth) {
            visit(block++, pixels.rows.top + y * pixels.rows.stride + x * words,
                  std::min(kBlockWidth, pixels.width - x), std::min(kBlockHeight, pixels.height - y));
        }
    }
}

// Copies `columns` x `rows` pixels of `words` words; a whole block's with the sizes as constants. Strides are words.
template <int words, class To, class From>
void copyRows(To* to, std::ptrdiff_t toStride, const From* from, std::ptrdiff_t fromStride, int columns, int rows)
{
    static_assert(sizeof(To) == 4 && sizeof(From) == 4);
    const auto copy = [&](int width, int height) {
        for (int row = 0; row < height; ++row)
            std::memcpy(to + row * toStride, from + row * fromStride, static_cast<std::size_t>(width * words) * 4);
    };
    if (columns == kBlockWidth && rows == kBlockHeight) {
        copy(kBlockWidth, kBlockHeight);
    } else {
        copy(columns, rows);
    }
}

// The pixel of a lane among the block's, row after row.
constexpr int pixelOf(int lane)
{
    return laneY(lane) * kBlockWidth + laneX(lane);
}

template <int words>
void storeBlocks(const std::int32_t* blocks, int blocksWide, TilePixels<std::uint32_t> target)
{
    forEachBlock<words>(target, blocksWide, [&](int block, std::uint32_t* to, int columns, int rows) {
        const std::int32_t* from = blocks + block * kLanes * words;
        std::int32_t pixels[kLanes * words];
        if constexpr (words == 1) {
            inRows(Int::load(from)).store(pixels);
        } else {
            for (int i = 0; i < kLanes; ++i) {
                for (int c = 0; c < words; ++c) pixels[pixelOf(i) * words + c] = from[c * kLanes + i];
            }
        }
        orderBytes(target, pixels, kLanes * words);
        copyRows<words>(to, target.rows.stride, pixels, kBlockWidth * words, columns, rows);
    });
}

template <int words>
void loadBlocks(std::int32_t* blocks, int blocksWide, TilePixels<const std::uint32_t> target)
{
    forEachBlock<words>(target, blocksWide, [&](int block, const std::uint32_t* from, int columns, int rows) {
        std::int32_t* to = blocks + block * kLanes * words;
        std::int32_t pixels[kLanes * words] = {};
        copyRows<words>(pixels, kBlockWidth * words, from, target.rows.stride, columns, rows);
        orderBytes(target, pixels, kLanes * words);
        if constexpr (words == 1) {
            fromRows(Int::load(pixels)).store(to);
        } else {
            for (int i = 0; i < kLanes; ++i) {
                for (int c = 0; c < words; ++c) to[c * kLanes + i] = pixels[pixelOf(i) * words + c];
            }
        }
    });
}

// The mean of a block's samples, `count` (a power of two) of them one after the other, in linear light. Of equal ones
// it is they themselves, whatever a sum of them would round to.
template <Format format>
void resolveColor(const std::int32_t* samples, int count, std::int32_t* to)
{
    const float share = 1.0f / static_cast<float>(count);
    float4 sum = 0.0f;
    constexpr auto size = static_cast<std::size_t>(wordsPerPixel(format));
    std::array<Int, size> words, first;
    Mask areEqual(true);
    for (int s = 0; s < count; ++s) {
        for (std::size_t i = 0; i < size; ++i) {
            words[i] = Int::load(samples);
            samples += kLanes;
            if (s == 0) first[i] = words[i];
            areEqual = areEqual & (words[i] == first[i]);
        }
        sum = sum + decodeColor<format>(words) * share;
    }
    const std::array<Int, size> mean = encodeColor<format>(sum);
    for (std::size_t i = 0; i < size; ++i) {
        select(areEqual, first[i], mean[i]).store(to);
        to += kLanes;
    }
}

}  // namespace

bool Clear::isAny() const
{
    const auto has = [](const std::optional<glm::vec4>& c) { return c.has_value(); };
    return depth || stencil || std::any_of(color.begin(), color.end(), has);
}

TargetMemory::TargetMemory(Framebuffer& target)
    : width(target.width()), height(target.height()), samples(&target.samples()), attachments(target.attachments())
{
    for (int i = 0; i < static_cast<int>(attachments.size()); ++i) {
        drawn.push_back(target.drawnRows(i));
        shown.push_back(target.shownRows(i));
    }
}

bool TargetMemory::movesPixels(const Clear& clear) const
{
    ClearValues values(clear);
    return std::any_of(attachments.begin(), attachments.end(), [&](const Attachment& attachment) {
        std::int32_t value[4];
        return !values.next(attachment, value) && attachment.store == Store::texture;
    });
}

Tile::Tile(int tileSize, const TargetMemory& target)
    : size(tileSize),
      blocksWide(tileSize / kBlockWidth),
      blockCount(blocksWide * (tileSize / kBlockHeight)),
      pattern(target.samples)
{
    for (const Attachment& attachment : target.attachments) {
        Plane& plane = planes.emplace_back(Plane{attachment.format, {}});
        plane.words.resize(
            static_cast<std::size_t>(blockCount * kLanes * pattern->count * wordsPerPixel(plane.format)));
    }
    std::size_t colors = 0;
    for (Plane& plane : planes) {
        std::int32_t* const words = plane.words.data();
        if (plane.format == Format::depth32f) depthWords = reinterpret_cast<float*>(words);
        if (plane.format == Format::stencil8) stencilWords = words;
        if (isColor(plane.format)) mColorPlanes[colors++] = {plane.format, words};
    }
    mColors = (1u << colors) - 1;
    mBounds = std::make_unique<DepthBounds[]>(static_cast<std::size_t>(blockCount));
}

bool Tile::isFor(const TargetMemory& target) const
{
    return pattern == target.samples &&
           std::equal(planes.begin(), planes.end(), target.attachments.begin(), target.attachments.end(),
                      [](const Plane& plane, const Attachment& a) { return plane.format == a.format; });
}

void Tile::moveTo(int x, int y)
{
    originX = x;
    originY = y;
    blockAtOrigin = numberOf(x, y);
}

void Tile::begin(int x, int y, const TargetMemory& target, const Clear& clear)
{
    moveTo(x, y);
    seen = {};
    ClearValues values(clear);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        std::int32_t value[4] = {};
        const bool isCleared = values.next(target.attachments[i], value);
        const bool isPartial = x + size > target.width || y + size > target.height;
        if (isCleared || isPartial) fill(planes[i], value);
        if (!isCleared) load(planes[i], target, i);
    }
    if (!hasDepth()) return;
    if (clear.depth) {
        const DepthBounds all = {*clear.depth, *clear.depth};
        std::fill_n(mBounds.get(), blockCount, all);
        mWholeBounds = all;
    } else {
        setBounds();
        refreshWholeBounds();
    }
}

void Tile::fill(Plane& plane, const std::int32_t (&value)[4])
{
    const int words = wordsPerPixel(plane.format), blocks = blockCount * pattern->count;
    if (words == 1) {
        std::fill_n(plane.words.data(), blocks * kLanes, value[0]);
        return;
    }
    for (int block = 0; block < blocks; ++block) {
        for (int c = 0; c < words; ++c)
            std::fill_n(plane.words.data() + (block * words + c) * kLanes, kLanes, value[c]);
    }
}

void Tile::load(Plane& plane, const TargetMemory& target, std::size_t attachment)
{
    const int words = wordsPerPixel(plane.format);
    const auto loadPlane = words == 1 ? loadBlocks<1> : words == 2 ? loadBlocks<2> : loadBlocks<4>;
    std::int32_t* to = plane.words.data();
    if (pattern->isMultiple()) {
        onePerPixel.resize(static_cast<std::size_t>(blockCount * kLanes * words));
        to = onePerPixel.data();
        std::fill_n(to, onePerPixel.size(), 0);  // beyond the target nothing is loaded
    }
    loadPlane(to, blocksWide, tilePixels(target, target.shown, attachment, originX, originY, size));
    for (int k = 0; k < blockCount * pattern->count && pattern->isMultiple(); ++k)
        std::copy_n(to + k / pattern->count * kLanes * words, kLanes * words, plane.words.data() + k * kLanes * words);
}

// What is kept of several samples, block by block: the mean of colours, the first one's depth and stencil.
const std::int32_t* Tile::resolved(const Plane& plane)
{
    if (!pattern->isMultiple()) return plane.words.data();
    const int count = pattern->count;
    onePerPixel.resize(plane.words.size() / static_cast<std::size_t>(count));
    withFormat(plane.format, [&]<Format format>() {
        constexpr int words = kLanes * wordsPerPixel(format);
        for (int block = 0; block < blockCount; ++block) {
            const std::int32_t* from = plane.words.data() + block * count * words;
            std::int32_t* to = onePerPixel.data() + block * words;
            if constexpr (isColor(format)) {
                resolveColor<format>(from, count, to);
            } else {
                std::copy_n(from, words, to);
            }
        }
    });
    return onePerPixel.data();
}

void Tile::setBounds()
{
    for (int block = 0; block < blockCount; ++block) {
        const float* first = depth(sampleOf(block, 0));
        const float* const last = first + kLanes * pattern->count;
        const float* const nan = std::find_if(first, last, [](float z) { return std::isnan(z); });
        const auto [low, high] = std::minmax_element(first, last);
        bounds(block) = nan != last ? DepthBounds{*nan, *nan} : DepthBounds{*low, *high};
    }
}

void Tile::refreshWholeBounds()
{
    // Nearest and farthest alternate, so even lanes hold the one and odd lanes the other.
    static_assert(sizeof(DepthBounds) == 2 * sizeof(float));
    const float* numbers = &mBounds[0].nearest;
    Float low = Float::load(numbers), high = low;
    Mask unknown = isnan(low);
    for (int i = kLanes; i < 2 * blockCount; i += kLanes) {
        const Float some = Float::load(numbers + i);
        low = min(low, some);
        high = max(high, some);
        unknown |= isnan(some);
    }
    if (any(unknown)) [[unlikely]]
        low = high = quietNan();
    mWholeBounds = {low[0], high[1]};
    for (int lane = 2; lane < kLanes; lane += 2) {
        mWholeBounds.nearest = std::min(mWholeBounds.nearest, low[lane]);
        mWholeBounds.farthest = std::max(mWholeBounds.farthest, high[lane + 1]);
    }
}

void Tile::store(const TargetMemory& target)
{
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (target.drawn[i].top == nullptr) continue;
        const int words = wordsPerPixel(planes[i].format);
        const auto storePlane = words == 1 ? storeBlocks<1> : words == 2 ? storeBlocks<2> : storeBlocks<4>;
        storePlane(resolved(planes[i]), blocksWide, tilePixels(target, target.drawn, i, originX, originY, size));
    }
}

std::vector<std::int32_t> Tile::save() const
{
    std::vector<std::int32_t> saved;
    for (const Plane& plane : planes)
        saved.insert(saved.end(), plane.words.data(), plane.words.data() + plane.words.size());
    return saved;
}

void Tile::restore(int x, int y, const std::vector<std::int32_t>& saved)
{
    moveTo(x, y);
    seen = {};
    const std::int32_t* from = saved.data();
    for (Plane& plane : planes) {
        std::copy_n(from, plane.words.size(), plane.words.data());
        from += plane.words.size();
    }
    if (!hasDepth()) return;
    setBounds();
    refreshWholeBounds();
}

void packColor(const glm::vec4& color, Format format, std::int32_t (&words)[4])
{
    withFormat(format, [&]<Format f>() {
        const auto lanes = encodeColor<f>(broadcast(color));
        for (std::size_t i = 0; i < lanes.size(); ++i) words[i] = lanes[i][0];
    });
}

void clearRectangle(const TargetMemory& target, const Rectangle& pixels, const Clear& clear)
{
    const Rectangle inside = intersect(pixels, {0, 0, target.width, target.height});
    if (inside.x0 >= inside.x1) return;
    const auto count = static_cast<std::size_t>(inside.x1 - inside.x0);
    ClearValues values(clear);
    for (std::size_t i = 0; i < target.attachments.size(); ++i) {
        std::int32_t value[4] = {};
        if (!values.next(target.attachments[i], value) || target.drawn[i].top == nullptr) continue;
        const auto words = static_cast<std::size_t>(wordsPerPixel(target.attachments[i].format));
        const TilePixels<std::uint32_t> to = tilePixels(target, target.drawn, i, inside.x0, inside.y0, kMaxTargetSize);
        orderBytes(to, value, 1);
        for (int y = 0; y < inside.y1 - inside.y0; ++y) {
            std::uint32_t* row = to.rows.top + y * to.rows.stride;
            if (words == 1) {
                std::fill_n(row, count, static_cast<std::uint32_t>(value[0]));
                continue;
            }
            for (std::size_t k = 0; k < count * words; ++k) row[k] = static_cast<std::uint32_t>(value[k % words]);
        }
    }
}

}  // namespace relief::inline RELIEF_WIDTH

// A tile's attachments while one thread works on it. They are kept block by block, one value per lane, so that a
// block's colour or depth is one load; the rows of the image exist only when the finished tile is written out.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "relief/lanes/float.h"
#include "relief/pipeline/framebuffer.h"
#include "relief/pipeline/geometry.h"

namespace relief::inline RELIEF_WIDTH {

// What a depth test can know about a block without looking at its pixels. Conservative: some pixel may be nearer to the
// other bound, none lies outside. Both are NaN where some pixel's depth may be, and stay so: no comparison with them
// shows anything.
struct DepthBounds
{
    float nearest, farthest;
};

// What attachments hold before a frame's first draw. What is not cleared keeps what it holds. Colour is linear.
struct Clear
{
    std::array<std::optional<glm::vec4>, kMaxColors> color;  // of each colour attachment
    std::optional<float> depth;
    std::optional<std::uint8_t> stencil;

    bool isAny() const;
};

// Where a target's attachments lie, as Framebuffer has it: where tiles are stored to, and where they are loaded from.
// One value a pixel, however many samples it has.
struct TargetMemory
{
    int width = 0, height = 0;
    const SamplePattern* samples;
    std::vector<Attachment> attachments;
    std::vector<Framebuffer::Rows<std::uint32_t>> drawn;
    std::vector<Framebuffer::Rows<const std::uint32_t>> shown;

    explicit TargetMemory(Framebuffer& target);

    // Whether all tiles have to be loaded and stored, drawn to or not: what is not cleared of a texture lies elsewhere.
    bool movesPixels(const Clear& clear) const;
};

// Words of lanes, a vector after the other, each where it is read at once: a vector that lies in two cache lines takes
// twice as long.
class LaneWords
{
public:
    void resize(std::size_t words) { vectors.resize(words / kLanes); }
    std::size_t size() const { return vectors.size() * kLanes; }
    std::int32_t* data() { return vectors.data()->words; }
    const std::int32_t* data() const { return vectors.data()->words; }

private:
    struct alignas(Int) Vector
    {
        std::int32_t words[kLanes];
    };
    std::vector<Vector> vectors;
};

class Tile
{
public:
    // For tiles of `size` x `size` pixels of such targets.
    Tile(int size, const TargetMemory& target);

    Tile(const Tile&) = delete;
    Tile& operator=(const Tile&) = delete;

    bool isFor(const TargetMemory& target) const;

    // Starts on the tile at pixel (x, y): from the clear values, or from what the target holds.
    void begin(int x, int y, const TargetMemory& target, const Clear& clear);

    // Writes the pixels that lie in the target; of several samples what is kept of them.
    void store(const TargetMemory& target);

    // All that the tile holds, every sample, for later.
    std::vector<std::int32_t> save() const;
    void restore(int x, int y, const std::vector<std::int32_t>& saved);

    const SamplePattern& samples() const { return *pattern; }

    int blockAt(int x, int y) const { return numberOf(x, y) - blockAtOrigin; }

    // The colour attachments, a bit each.
    unsigned colors() const { return mColors; }
    bool hasDepth() const { return depthWords != nullptr; }
    bool hasStencil() const { return stencilWords != nullptr; }
    Format colorFormat(int target) const { return mColorPlanes[static_cast<std::size_t>(target)].format; }

    // A block's words: the first ones of all lanes, then the second ones. The caller knows the format. Where a pixel
    // has several samples, `block` is sampleOf() one of them.
    template <Format format>
    std::int32_t* color(int target, int block)
    {
        return mColorPlanes[static_cast<std::size_t>(target)].words +
               static_cast<std::ptrdiff_t>(block) * (kLanes * wordsPerPixel(format));
    }
    float* depth(int block) { return depthWords + static_cast<std::ptrdiff_t>(block) * kLanes; }
    std::int32_t* stencil(int block) { return stencilWords + static_cast<std::ptrdiff_t>(block) * kLanes; }
    int sampleOf(int block, int sample) const { return block * pattern->count + sample; }
    DepthBounds& bounds(int block) { return mBounds[static_cast<std::size_t>(block)]; }

    // Of all blocks together: conservative, and as narrow as they were when they were last refreshed.
    DepthBounds& wholeBounds() { return mWholeBounds; }
    void refreshWholeBounds();

    // Of the draw that came last to this tile: whether its program was seen to sample textures.
    struct Seen
    {
        const void* draw = nullptr;
        bool samples = false;
    } seen;

private:
    struct Plane
    {
        Format format;
        LaneWords words;
    };

    void fill(Plane& plane, const std::int32_t (&value)[4]);
    void load(Plane& plane, const TargetMemory& target, std::size_t attachment);
    const std::int32_t* resolved(const Plane& plane);
    void setBounds();

    // Blocks counted row by row, from the target's first pixel on, as if it were as wide as the tile.
    int numberOf(int x, int y) const
    {
        const auto column = static_cast<unsigned>(x), row = static_cast<unsigned>(y);
        return static_cast<int>(row / kBlockHeight) * blocksWide + static_cast<int>(column / kBlockWidth);
    }
    void moveTo(int x, int y);

    int size, blocksWide, blockCount;
    const SamplePattern* pattern;
    int originX = 0, originY = 0, blockAtOrigin = 0;
    struct ColorPlane
    {
        Format format;
        std::int32_t* words;
    };

    std::vector<Plane> planes;  // one for each attachment, and below where they lie
    std::array<ColorPlane, kMaxColors> mColorPlanes{};
    unsigned mColors = 0;
    float* depthWords = nullptr;
    std::int32_t* stencilWords = nullptr;
    LaneWords onePerPixel;  // room, where there are several samples
    std::unique_ptr<DepthBounds[]> mBounds;
    DepthBounds mWholeBounds{};
};

// A colour as the format stores it.
void packColor(const glm::vec4& color, Format format, std::int32_t (&words)[4]);

// Clears the part of a rectangle that lies in the target, without a tile in between: where nothing is drawn.
void clearRectangle(const TargetMemory& target, const Rectangle& pixels, const Clear& clear);

}  // namespace relief::inline RELIEF_WIDTH

#include "relief/pipeline/inspect.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "relief/pipeline/exchange.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// What stands in for a draw's fragment program.
struct WatchedDraw
{
    OwnProgram own;
    std::optional<Slots> slots;
    bool writesDepth;
    Inspection* result;  // each pixel's values are written by the one thread that has its tile
};

// A block together with its triangle.
struct WatchedBlock
{
    const WatchedDraw& draw;
    const ShadedBlock& block;
    const TriangleBatch& batch;
    const TriangleCorners* corners;

    // Runs the program once more, with other quads; gives what it fetched, which is not counted.
    FetchCounters runAgain(unsigned quads) const
    {
        ShadedBlock copy = block;
        MoreOutputs more;
        copy.more = &more;
        copy.quads = quads;
        const FetchCounters before = std::exchange(shading.fetches, {});
        draw.own.shadeBlocks({&copy, 1}, batch, corners);
        return std::exchange(shading.fetches, before);
    }

    void edges(Float (&edge)[3]) const
    {
        TriangleEdges all;
        all.set(batch, block.covered.triangle);
        all.at(block.covered.x, block.covered.y, edge);
    }

    // Calls function(the pixel's value, lane) for some of the block's lanes. There is a value then.
    template <class Function>
    void forPixels(unsigned lanes, const Function& function) const
    {
        Inspection& result = *draw.result;
        for (int lane = 0; lane < kLanes; ++lane) {
            const int x = block.covered.x + laneX(lane), y = block.covered.y + laneY(lane);
            if ((lanes >> lane & 1u) == 0 || x >= result.width || y >= result.height) continue;
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) + static_cast<std::size_t>(x);
            function(result.values[pixel], lane);
            result.drawn[pixel] = 1;
        }
    }
    void put(unsigned lanes, float value) const
    {
        forPixels(lanes, [&](glm::vec4& pixel, int) { pixel.x = value; });
    }
    void add(unsigned lanes, float value) const
    {
        forPixels(lanes, [&](glm::vec4& pixel, int) { pixel.x += value; });
    }
    template <class Function>
    void forQuads(const Function& function) const
    {
        for (unsigned quad = 0xfu; (quad & kAllLanes) != 0; quad <<= 4) {
            if ((quad & block.quads) != 0) function(quad);
        }
    }
};

// The depth that is written; where a pixel has several samples, that of its centre.
void noteDepth(const WatchedBlock& b, unsigned lanes)
{
    if (!b.draw.writesDepth) return;
    if (b.draw.own.programs->outputs.depth) {
        const Float depth = saturate(Float::load(b.block.more->depth));
        return b.forPixels(lanes, [&](glm::vec4& pixel, int lane) { pixel.x = depth[lane]; });
    }
    Float edge[3];
    b.edges(edge);
    TriangleWeights weights;
    weights.set(b.batch, b.block.covered.triangle);
    const Float depth = weights.depth(edge[1], edge[2]);
    b.forPixels(lanes, [&](glm::vec4& pixel, int lane) { pixel.x = depth[lane]; });
}

// An interpolator as the fragment program gets it.
void noteInterpolator(const WatchedBlock& b, unsigned lanes)
{
    if (!b.draw.slots) return;
    const Slots& slots = *b.draw.slots;
    Float edge[3];
    b.edges(edge);
    if (slots.interpolation == Interpolation::centroid) {
        for (int k = 0; k < 3; ++k) edge[k] = Float::load(b.block.centroid[k]);
    }
    TriangleWeights triangle;
    triangle.set(b.batch, b.block.covered.triangle);
    const BlockWeights weights = triangle.of(edge, b.block.covered.coverage);
    const auto& [first, second, third] = b.corners[b.block.covered.triangle].components;
    for (int c = 0; c < slots.count; ++c) {
        const int slot = slots.first + c;
        Float value = interpolated(slots.interpolation, first[slot], second[slot], third[slot], weights);
        if (slots.isInteger) value = Float(asInt(value));
        if (b.draw.result->view.name == "uv") value = value - floor(value);
        b.forPixels(lanes, [&](glm::vec4& pixel, int lane) { pixel[c] = value[lane]; });
    }
}

// Quad by quad, so that no other quad of the block plays a part.
void noteMipLevels(const WatchedBlock& b, unsigned lanes)
{
    b.forQuads([&](unsigned quad) {
        alignas(Int) std::int32_t levels[kLanes];
        Int(-1).store(levels);
        shading.levels = levels;
        const bool samples = b.runAgain(quad).fetched() > 0;
        b.runAgain(quad | kWatched);
        shading.levels = nullptr;
        if (!samples) return;
        // A sample of a texture or sampler without mip levels says nothing: it takes level 0.
        b.forPixels(lanes & quad, [&](glm::vec4& pixel, int lane) {
            pixel.x = static_cast<float>(std::max(levels[lane], 0)) / 256.0f;
        });
    });
}

// 24 bits, which a float holds exactly, from where the triangle lies.
void noteTriangle(const WatchedBlock& b, unsigned lanes)
{
    const Triangle& triangle = *b.batch.triangle[b.block.covered.triangle];
    std::uint32_t hash = 2166136261u + triangle.drawIndex();
    for (int k = 0; k < 3; ++k) {
        for (const std::int32_t word : {triangle.x[k], triangle.y[k]}) {
            hash = (hash ^ static_cast<std::uint32_t>(word)) * 0x9e3779b1u;
            hash ^= hash >> 15;
        }
    }
    b.put(lanes, static_cast<float>(hash >> 8));
}

// The fastest of a few runs, in nanoseconds.
void noteTime(const WatchedBlock& b)
{
    using Clock = std::chrono::steady_clock;
    std::chrono::nanoseconds fastest = std::chrono::nanoseconds::max();
    for (int i = 0; i < 5; ++i) {
        const Clock::time_point begin = Clock::now();
        b.runAgain(b.block.quads);
        fastest = std::min<std::chrono::nanoseconds>(fastest, Clock::now() - begin);
    }
    b.add(b.block.live, static_cast<float>(fastest.count()));
}

void note(const WatchedBlock& b)
{
    const unsigned live = b.block.live, kept = b.draw.own.programs->discards ? live & ~b.block.discarded : live;
    const int blockNumber = b.block.covered.x / kBlockWidth + b.block.covered.y / kBlockHeight;
    switch (b.draw.result->view.sight) {
        case Sight::color:
            return;
        case Sight::depth:
            return noteDepth(b, kept);
        case Sight::interpolator:
            return noteInterpolator(b, kept);
        case Sight::mipLevel:
            return noteMipLevels(b, kept);
        case Sight::triangles:
            return noteTriangle(b, kept);
        case Sight::blocks:
            return b.put(kAllLanes, static_cast<float>(blockNumber & 1));
        case Sight::overdraw:
            return b.add(live, 1.0f);
        case Sight::lanes:
            return b.put(live, static_cast<float>(countBits(live)));
        case Sight::samples:
            return b.forQuads(
                [&](unsigned quad) { b.add(live & quad, static_cast<float>(b.runAgain(quad).fetched()) / 4.0f); });
        case Sight::time:
            return noteTime(b);
    }
}

// In the place of Programs::shadeBlocks.
void shadeWatched(const void* watched, std::span<ShadedBlock> blocks, const TriangleBatch& batch,
                  const TriangleCorners* corners)
{
    const WatchedDraw& draw = *static_cast<const WatchedDraw*>(watched);
    draw.own.shadeBlocks(blocks, batch, corners);
    for (const ShadedBlock& block : blocks) note({draw, block, batch, corners});
}

// Runs the frame with programs that note.
void runWatched(Frame::Storage& frame, Inspection& result)
{
    const auto watched = [&result](const Draw& draw, const OwnProgram& own) {
        return WatchedDraw{own, slotsOf(draw, result.view.name), draw.state.depthWrite, &result};
    };
    const ExchangedPrograms<WatchedDraw> exchanged(frame, watched, shadeWatched);
    result.statistics = frame.run();
}

// The scale's ends: what the view's numbers can be, or else the smallest and the largest of the picture.
void findRange(Inspection& result)
{
    const auto between = [&](float low, float high) {
        result.lowest = low;
        result.highest = high;
    };
    if (result.view.name == "uv") return between(0.0f, 1.0f);
    if (result.view.name == "normal") return between(-1.0f, 1.0f);
    if (result.view.sight == Sight::lanes) return between(1.0f, static_cast<float>(kLanes));
    fitRange(result, result.view.sight != Sight::depth && result.view.sight != Sight::interpolator);
}

}  // namespace

void fitRange(Inspection& result, bool fromZero)
{
    bool any = fromZero;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        for (int c = 0; c < result.components && result.drawn[i] != 0; ++c) {
            const float value = result.values[i][c];
            if (!std::isfinite(value)) continue;
            result.lowest = any ? std::min(result.lowest, value) : value;
            result.highest = any ? std::max(result.highest, value) : value;
            any = true;
        }
    }
}

Expected<Inspection> inspect(Frame& frame, const std::string& name)
{
    Expected<View> view = findView(frame, name);
    if (!view) return tl::unexpected(view.error());
    Frame::Storage& storage = frame.internals();
    Inspection result;
    result.view = std::move(*view);
    const Sight sight = result.view.sight;
    result.width = storage.target.width();
    result.height = storage.target.height();
    result.tileSize = storage.tileSize;
    if (sight == Sight::color) {
        result.showAs = ShowAs::picture;
        result.statistics = frame.run();
        return result;
    }
    result.components = 1;
    if (sight == Sight::interpolator) {
        for (const Draw& draw : storage.draws) {
            if (const std::optional<Slots> slots = slotsOf(draw, name))
                result.components = std::max(result.components, slots->count);
        }
    }
    if (sight == Sight::triangles) result.showAs = ShowAs::names;
    if (sight == Sight::blocks) result.showAs = ShowAs::parity;
    if (result.components > 1) result.showAs = ShowAs::vector;
    const std::size_t pixels = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
    result.values.assign(pixels, glm::vec4(0.0f));
    result.drawn.assign(pixels, 0);
    runWatched(storage, result);
    findRange(result);
    return result;
}

}  // namespace relief::inline RELIEF_WIDTH

// From covered blocks to pixels: the early depth test, the fragment program, the output merger. Blocks go through these
// steps in small groups, so that a program is called once for several of them; a group's data stay in the first-level
// cache. All depths of a group are tested and written before its first colour is merged: depth does not depend on
// colour, and both keep the order of submission, so every pixel is what it would be one block at a time. Only a program
// that discards decides about depth, and alpha to coverage does: their blocks go one by one.
#include "pipeline/draw.h"

#include <algorithm>
#include <array>
#include <limits>

#include "leave_out.h"
#include "pipeline/output_merger.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

constexpr std::size_t kBlocksPerGroup = 16;

// Where a run has so many blocks a triangle it pays to look at the bounds of the whole tile, which are often in front
// of all that is drawn over it later.
constexpr int kBlocksOfLargeTriangle = 64;

// Of one run of blocks.
struct Counts
{
    unsigned blocks = 0, quadPixels = 0, pixels = 0, covered = 0, invalid = 0;
};

// What of a draw's state a block asks for: any, with one sample a pixel or several, or the usual one, of which the
// compiler knows most.
template <bool several>
struct AnyState
{
    static constexpr bool severalSamples = several;
    Compare depthTest;
    bool usesDepth, depthWrite, discards, readsEdges, readsCentroids;

    AnyState(const Draw& draw, const Tile& tile)
        : depthTest(tile.hasDepth() ? draw.state.depthTest : Compare::always),
          usesDepth(tile.hasDepth() && (depthTest != Compare::always || draw.state.depthWrite)),
          depthWrite(tile.hasDepth() && draw.state.depthWrite),
          discards(draw.programs->discards || draw.state.alphaToCoverage),
          readsEdges(draw.programs->components > 0),
          readsCentroids(draw.geometry.hasCentroid)
    {
    }
    bool isUsual() const { return depthTest == Compare::less && depthWrite && !discards && !readsCentroids; }
};
template <bool interpolates>
struct UsualState
{
    static constexpr bool severalSamples = false;
    static constexpr Compare depthTest = Compare::less;
    static constexpr bool usesDepth = true, depthWrite = true, discards = false, readsEdges = interpolates,
                          readsCentroids = false;
};

// One triangle's way through a run of blocks: its edges at the pixels' centres, and at their samples, where there are
// several.
template <bool severalSamples>
struct TriangleInTile
{
    TriangleWeights weights;
    TriangleEdges edges;
    std::array<TriangleEdges, severalSamples ? kMaxSamples : 0> sampleEdges;
    int lane;

    TriangleInTile(const TriangleBatch& batch, int triangle) { set(batch, triangle); }
    void set(const TriangleBatch& batch, int triangle)
    {
        lane = triangle;
        weights.set(batch, triangle);
        edges.set(batch, triangle);
        if constexpr (severalSamples) {
            for (std::size_t s = 0; s < static_cast<std::size_t>(batch.samples->count); ++s)
                sampleEdges[s].set(batch, triangle, batch.samples->position[s]);
        }
    }
};

// Writes the depth of a block's live pixels.
template <class State>
void writeDepth(const State& state, const TriangleWeights& triangle, bool isWhole, unsigned live, Float depth,
                Float old, float* stored, DepthBounds& bounds)
{
    if (!state.depthWrite || live == 0) return;
    select(Mask::fromBits(live), depth, old).store(stored);
    updateBounds(state.depthTest, triangle.nearest, triangle.farthest, isWhole, bounds);
}

// Not in a loop, in which g++ 12 would keep the values in memory.
void storeEdges(const Float (&edge)[3], float (&to)[3][kLanes])
{
    edge[0].store(to[0]);
    edge[1].store(to[1]);
    edge[2].store(to[2]);
}

// A block that is to be shaded.
void setBlock(ShadedBlock& block, const CoveredBlock& covered, int index, unsigned live, Counts& counts)
{
    block.live = live;
    block.quads = wholeQuads(leavesOut::hidden ? live : covered.coverage);
    block.index = index;
    block.covered = covered;
    counts.quadPixels += static_cast<unsigned>(countBits(block.quads));
    counts.pixels += static_cast<unsigned>(countBits(live));
}

// Before the program runs: which pixels pass the depth test. `inTile`: bounds of all blocks together. Their depth is
// written here, too, unless the program may throw them away afterwards. Returns whether there is anything to shade.
template <class State>
bool testEarly(const State& state, const TriangleInTile<false>& triangle, const CoveredBlock& covered,
               const SampleCoverage* /* the one sample's is the block's */, const DepthBounds& inTile,
               ShadedBlock& block, Tile& tile, Counts& counts)
{
    const TriangleWeights& weights = triangle.weights;
    const int x = covered.x, y = covered.y, index = tile.blockAt(x, y);
    const unsigned coverage = covered.coverage;
    counts.covered += static_cast<unsigned>(countBits(coverage));
    const auto hidden = [&](const DepthBounds& bounds) {
        return isHidden(state.depthTest, weights.nearest, weights.farthest, bounds);
    };
    if (leavesOut::hidden && state.usesDepth && (hidden(inTile) || hidden(tile.bounds(index)))) return false;
    unsigned live = coverage;
    if (state.usesDepth || state.readsEdges) {
        Float edge[3];
        triangle.edges.at(x, y, edge);
        if (state.usesDepth) {
            float* const stored = tile.depth(index);
            const Float depth = weights.depth(edge[1], edge[2]), old = Float::load(stored);
            live &= compareDepth(state.depthTest, depth, old).bits();
            if (leavesOut::hidden && live == 0) return false;
            if (!state.discards)
                writeDepth(state, weights, coverage == kAllLanes, live, depth, old, stored, tile.bounds(index));
        }
        if (state.readsEdges) storeEdges(edge, block.edge);
        if (state.readsCentroids) storeEdges(edge, block.centroid);
    }
    setBlock(block, covered, index, live, counts);
    return true;
}

// The same where a pixel has several samples, each with a depth of its own.
template <class State>
bool testEarly(const State& state, const TriangleInTile<true>& triangle, const CoveredBlock& covered,
               const SampleCoverage* samples, const DepthBounds& inTile, ShadedBlock& block, Tile& tile, Counts& counts)
{
    const TriangleWeights& weights = triangle.weights;
    const int x = covered.x, y = covered.y, index = tile.blockAt(x, y);
    DepthBounds& bounds = tile.bounds(index);
    counts.covered += static_cast<unsigned>(countBits(covered.coverage));
    const auto hidden = [&](const DepthBounds& b) {
        return isHidden(state.depthTest, weights.nearest, weights.farthest, b);
    };
    if (leavesOut::hidden && state.usesDepth && (hidden(inTile) || hidden(bounds))) return false;
    Float edge[3];
    triangle.edges.at(x, y, edge);
    storeEdges(edge, block.edge);
    storeEdges(edge, block.centroid);
    const unsigned inside = ((edge[0] >= 0.0f) & (edge[1] >= 0.0f) & (edge[2] >= 0.0f)).bits();
    unsigned live = 0, everywhere = kAllLanes, placed = inside;
    for (int s = 0; s < tile.samples().count; ++s) {
        unsigned lanes = (*samples)[static_cast<std::size_t>(s)];
        everywhere &= lanes;
        triangle.sampleEdges[static_cast<std::size_t>(s)].at(x, y, edge);
        // The centroid of a pixel whose centre is not in the triangle is its first sample that is.
        const Mask first = Mask::fromBits(lanes & ~placed);
        for (int k = 0; k < 3; ++k) select(first, edge[k], Float::load(block.centroid[k])).store(block.centroid[k]);
        placed |= lanes;
        if (state.usesDepth) {
            float* const stored = tile.depth(tile.sampleOf(index, s));
            const Float depth = weights.depth(edge[1], edge[2]), old = Float::load(stored);
            lanes &= compareDepth(state.depthTest, depth, old).bits();
            if (!state.discards) writeDepth(state, weights, false, lanes, depth, old, stored, bounds);
        }
        block.liveSamples[static_cast<std::size_t>(s)] = static_cast<std::uint16_t>(lanes);
        live |= lanes;
    }
    if (leavesOut::hidden && live == 0) return false;
    if (everywhere == kAllLanes && state.depthWrite && !state.discards)
        updateBounds(state.depthTest, weights.nearest, weights.farthest, true, bounds);
    setBlock(block, covered, index, live, counts);
    block.covered.coverage = static_cast<std::uint16_t>(inside);
    return true;
}

// Which of these lanes a discarding program has left, and whose alpha is enough for a sample: the first one takes the
// least, and each one after it more.
unsigned keptLanes(const Draw& draw, const ShadedBlock& block, unsigned lanes, int sample, int count)
{
    if (draw.programs->discards) lanes &= ~block.discarded;
    if (!draw.state.alphaToCoverage) return lanes;
    const float least = (static_cast<float>(sample) + 0.5f) / static_cast<float>(count);
    return lanes & (Float::load(block.color[3]) >= least).bits();
}

// After the program: the depth of what is left is written now.
template <class State>
void writeDepthLate(const State& state, const TriangleWeights& weights, const TriangleEdges& edges,
                    const ShadedBlock& block, unsigned lanes, float* stored, Tile& tile)
{
    Float edge[3];
    edges.at(block.covered.x, block.covered.y, edge);
    writeDepth(state, weights, false, lanes, weights.depth(edge[1], edge[2]), Float::load(stored), stored,
               tile.bounds(block.index));
}
template <class State>
void testLate(const State& state, const Draw& draw, const TriangleInTile<false>& triangle, ShadedBlock& block,
              Tile& tile)
{
    block.live = keptLanes(draw, block, block.live, 0, 1);
    if (state.usesDepth)
        writeDepthLate(state, triangle.weights, triangle.edges, block, block.live, tile.depth(block.index), tile);
}
template <class State>
void testLate(const State& state, const Draw& draw, const TriangleInTile<true>& triangle, ShadedBlock& block,
              Tile& tile)
{
    block.live = 0;
    for (int s = 0; s < tile.samples().count; ++s) {
        std::uint16_t& lanes = block.liveSamples[static_cast<std::size_t>(s)];
        lanes = static_cast<std::uint16_t>(keptLanes(draw, block, lanes, s, tile.samples().count));
        block.live |= lanes;
        if (state.usesDepth) {
            writeDepthLate(state, triangle.weights, triangle.sampleEdges[static_cast<std::size_t>(s)], block, lanes,
                           tile.depth(tile.sampleOf(block.index, s)), tile);
        }
    }
}

// Calls merge(words, live lanes) for each sample of a block.
template <Format format, bool severalSamples, class Merge>
void forSamples(Tile& tile, const ShadedBlock& block, const Merge& merge)
{
    if constexpr (severalSamples) {
        for (int s = 0; s < tile.samples().count; ++s)
            merge(tile.color<format>(tile.sampleOf(block.index, s)), block.liveSamples[static_cast<std::size_t>(s)]);
    } else {
        merge(tile.color<format>(block.index), block.live);
    }
}

template <Format format, bool severalSamples>
void mergeBlocks(std::span<const ShadedBlock> blocks, Blend blend, Tile& tile, Counts& counts)
{
    const auto forEach = [&](const auto& merge) {
        for (const ShadedBlock& block : blocks) counts.invalid += static_cast<unsigned>(merge(block));
    };
    if (blend == Blend::off) {
        ColorWriter<format> writer;
        forEach([&](const ShadedBlock& block) {
            const int invalid = writer.set(block.color, block.live);
            forSamples<format, severalSamples>(tile, block,
                                               [&](std::int32_t* words, unsigned live) { writer.store(words, live); });
            return invalid;
        });
    } else {
        forEach([&](const ShadedBlock& block) {
            float4 color = loadChannels(block.color);
            const int invalid = sanitizeColor(color, Mask::fromBits(block.live));
            forSamples<format, severalSamples>(tile, block, [&](std::int32_t* words, unsigned live) {
                blendInto<format>(words, blend, color, Mask::fromBits(live));
            });
            return invalid;
        });
    }
}

TriangleCorners cornersOf(const Draw& draw, const TriangleChunk& chunk, const Triangle& triangle)
{
    return {{componentsOf(draw.geometry, chunk, triangle.vertex[0]),
             componentsOf(draw.geometry, chunk, triangle.vertex[1]),
             componentsOf(draw.geometry, chunk, triangle.vertex[2])}};
}

template <class State>
void shadeBlocksIn(const State& state, const Draw& draw, std::span<const CoveredBlock> blocks,
                   const SampleCoverage* samples, const TriangleBatch& batch, const TriangleChunk& chunk, Tile& tile,
                   Counts& counts)
{
    constexpr bool severalSamples = State::severalSamples;
    const bool runsProgram = tile.hasColor() || state.discards;
    const std::size_t groupSize = state.discards ? 1 : kBlocksPerGroup;
    const bool isLarge = static_cast<int>(blocks.size()) >= kBlocksOfLargeTriangle * countBits(batch.visible);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const DepthBounds inTile = isLarge ? tile.wholeBounds() : DepthBounds{-infinity, infinity};
    std::array<ShadedBlock, kBlocksPerGroup> group;
    std::array<TriangleCorners, kLanes> corners;
    TriangleInTile<severalSamples> triangle(batch, blocks.front().triangle);
    corners[static_cast<std::size_t>(triangle.lane)] = cornersOf(draw, chunk, *batch.triangle[triangle.lane]);
    for (auto next = blocks.begin(); next != blocks.end();) {
        ShadedBlock* free = group.data();
        for (; next != blocks.end() && free != group.data() + groupSize; ++next) {
            if (next->triangle != triangle.lane) {
                triangle.set(batch, next->triangle);
                corners[static_cast<std::size_t>(triangle.lane)] =
                    cornersOf(draw, chunk, *batch.triangle[triangle.lane]);
            }
            const SampleCoverage* of = severalSamples ? samples + (next - blocks.begin()) : nullptr;
            if (testEarly(state, triangle, *next, of, inTile, *free, tile, counts)) ++free;
        }
        const std::span<ShadedBlock> shaded(group.data(), free);
        counts.blocks += static_cast<unsigned>(shaded.size());
        if (!runsProgram || shaded.empty()) continue;
        draw.programs->shadeBlocks(draw.fragmentProgram.get(), shaded, batch, corners.data());
        if (state.discards) testLate(state, draw, triangle, group[0], tile);
        if (!tile.hasColor()) continue;
        withFormat(tile.colorFormat(), [&]<Format format>() {
            mergeBlocks<format, severalSamples>(shaded, draw.state.blend, tile, counts);
        });
    }
    if (!state.depthWrite) return;
    updateBounds(state.depthTest, 0.0f, 1.0f, false, tile.wholeBounds());  // whatever was written
    if (isLarge) tile.refreshWholeBounds();
}

// By itself, so that the usual ways below have the registers.
[[gnu::noinline, gnu::flatten]] Counts shadeSamples(const Draw& draw, std::span<const CoveredBlock> blocks,
                                                    const SampleCoverage* samples, const TriangleBatch& batch,
                                                    const TriangleChunk& chunk, Tile& tile)
{
    Counts counts;
    shadeBlocksIn(AnyState<true>(draw, tile), draw, blocks, samples, batch, chunk, tile, counts);
    return counts;
}

}  // namespace

[[gnu::flatten]] void shadeBlocks(const Draw& draw, std::span<const CoveredBlock> blocks, const SampleCoverage* samples,
                                  const TriangleBatch& batch, const TriangleChunk& chunk, Tile& tile,
                                  Statistics& statistics)
{
    Counts counts;
    const AnyState<false> state(draw, tile);
    if (tile.samples().isMultiple()) {
        counts = shadeSamples(draw, blocks, samples, batch, chunk, tile);
    } else if (state.isUsual() && state.readsEdges) {
        shadeBlocksIn(UsualState<true>(), draw, blocks, nullptr, batch, chunk, tile, counts);
    } else if (state.isUsual()) {
        shadeBlocksIn(UsualState<false>(), draw, blocks, nullptr, batch, chunk, tile, counts);
    } else {
        shadeBlocksIn(state, draw, blocks, nullptr, batch, chunk, tile, counts);
    }
    shading.activeLanes = kAllLanes;
    statistics.blocksShaded += counts.blocks;
    statistics.quadsShaded += counts.quadPixels / 4;
    statistics.pixelsShaded += counts.pixels;
    statistics.pixelsHidden += counts.covered - counts.pixels;
    statistics.invalidColors += counts.invalid;
}

}  // namespace relief::inline RELIEF_WIDTH

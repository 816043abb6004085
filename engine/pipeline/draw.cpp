// From covered blocks to pixels: the early depth test, the fragment program, the output merger. Blocks go through these
// steps in small groups, so that a program is called once for several of them; a group's data stay in the first-level
// cache. All depths of a group are tested and written before its first colour is merged: depth does not depend on
// colour, and both keep the order of submission, so every pixel is what it would be one block at a time. Only a program
// that discards decides about depth: its blocks go one by one.
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

// What of a draw's state a block asks for: any, or the usual one, of which the compiler knows most.
struct AnyState
{
    Compare depthTest;
    bool usesDepth, depthWrite, discards, readsEdges;

    AnyState(const Draw& draw, const Tile& tile)
        : depthTest(tile.hasDepth() ? draw.state.depthTest : Compare::always),
          usesDepth(tile.hasDepth() && (depthTest != Compare::always || draw.state.depthWrite)),
          depthWrite(tile.hasDepth() && draw.state.depthWrite),
          discards(draw.programs->discards),
          readsEdges(draw.programs->components > 0)
    {
    }
    bool isUsual() const { return depthTest == Compare::less && depthWrite && !discards; }
};
template <bool interpolates>
struct UsualState
{
    static constexpr Compare depthTest = Compare::less;
    static constexpr bool usesDepth = true, depthWrite = true, discards = false, readsEdges = interpolates;
};

// One triangle's way through a run of blocks.
struct TriangleInTile
{
    TriangleWeights weights;
    TriangleEdges edges;
    int lane;

    TriangleInTile(const TriangleBatch& batch, int triangle) { set(batch, triangle); }
    void set(const TriangleBatch& batch, int triangle)
    {
        lane = triangle;
        weights.set(batch, triangle);
        edges.set(batch, triangle);
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

// Before the program runs: which pixels pass the depth test. `inTile`: bounds of all blocks together. Their depth is
// written here, too, unless the program may throw them away afterwards. Returns whether there is anything to shade.
template <class State>
bool testEarly(const State& state, const TriangleInTile& triangle, const CoveredBlock& covered,
               const DepthBounds& inTile, ShadedBlock& block, Tile& tile, Counts& counts)
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
        if (state.readsEdges) {
            edge[0].store(block.edge[0]);
            edge[1].store(block.edge[1]);
            edge[2].store(block.edge[2]);
        }
    }
    const unsigned quads = wholeQuads(leavesOut::hidden ? live : coverage);
    counts.quadPixels += static_cast<unsigned>(countBits(quads));
    counts.pixels += static_cast<unsigned>(countBits(live));
    block.live = live;
    block.quads = quads;
    block.index = index;
    block.covered = covered;
    return true;
}

// What a discarding program has left of a block: its depth is written now.
template <class State>
void testLate(const State& state, const TriangleInTile& triangle, ShadedBlock& block, Tile& tile)
{
    block.live &= ~block.discarded;
    if (!state.usesDepth) return;
    Float edge[3];
    triangle.edges.at(block.covered.x, block.covered.y, edge);
    float* const stored = tile.depth(block.index);
    writeDepth(state, triangle.weights, false, block.live, triangle.weights.depth(edge[1], edge[2]),
               Float::load(stored), stored, tile.bounds(block.index));
}

template <Format format>
void mergeBlocks(std::span<const ShadedBlock> blocks, Blend blend, Tile& tile, Counts& counts)
{
    const auto forEach = [&](const auto& merge) {
        for (const ShadedBlock& block : blocks)
            counts.invalid += static_cast<unsigned>(merge(tile.color<format>(block.index), block));
    };
    if (blend == Blend::off) {
        ColorWriter<format> writer;
        forEach([&](std::int32_t* words, const ShadedBlock& b) { return writer.write(words, b.color, b.live); });
    } else {
        forEach([&](std::int32_t* words, const ShadedBlock& b) {
            return blendInto<format>(words, blend, b.color, Mask::fromBits(b.live));
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
                   const TriangleBatch& batch, const TriangleChunk& chunk, Tile& tile, Counts& counts)
{
    const bool runsProgram = tile.hasColor() || state.discards;
    const std::size_t groupSize = state.discards ? 1 : kBlocksPerGroup;
    const bool isLarge = static_cast<int>(blocks.size()) >= kBlocksOfLargeTriangle * countBits(batch.visible);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const DepthBounds inTile = isLarge ? tile.wholeBounds() : DepthBounds{-infinity, infinity};
    std::array<ShadedBlock, kBlocksPerGroup> group;
    std::array<TriangleCorners, kLanes> corners;
    TriangleInTile triangle(batch, blocks.front().triangle);
    corners[static_cast<std::size_t>(triangle.lane)] = cornersOf(draw, chunk, *batch.triangle[triangle.lane]);
    for (auto next = blocks.begin(); next != blocks.end();) {
        ShadedBlock* free = group.data();
        for (; next != blocks.end() && free != group.data() + groupSize; ++next) {
            if (next->triangle != triangle.lane) {
                triangle.set(batch, next->triangle);
                corners[static_cast<std::size_t>(triangle.lane)] =
                    cornersOf(draw, chunk, *batch.triangle[triangle.lane]);
            }
            if (testEarly(state, triangle, *next, inTile, *free, tile, counts)) ++free;
        }
        const std::span<ShadedBlock> shaded(group.data(), free);
        counts.blocks += static_cast<unsigned>(shaded.size());
        if (!runsProgram || shaded.empty()) continue;
        draw.programs->shadeBlocks(draw.fragmentProgram.get(), shaded, batch, corners.data());
        if (state.discards) testLate(state, triangle, group[0], tile);
        if (!tile.hasColor()) continue;
        withFormat(tile.colorFormat(),
                   [&]<Format format>() { mergeBlocks<format>(shaded, draw.state.blend, tile, counts); });
    }
    if (!state.depthWrite) return;
    updateBounds(state.depthTest, 0.0f, 1.0f, false, tile.wholeBounds());  // whatever was written
    if (isLarge) tile.refreshWholeBounds();
}

}  // namespace

[[gnu::flatten]] void shadeBlocks(const Draw& draw, std::span<const CoveredBlock> blocks, const TriangleBatch& batch,
                                  const TriangleChunk& chunk, Tile& tile, Statistics& statistics)
{
    Counts counts;
    const AnyState state(draw, tile);
    if (state.isUsual() && state.readsEdges) {
        shadeBlocksIn(UsualState<true>(), draw, blocks, batch, chunk, tile, counts);
    } else if (state.isUsual()) {
        shadeBlocksIn(UsualState<false>(), draw, blocks, batch, chunk, tile, counts);
    } else {
        shadeBlocksIn(state, draw, blocks, batch, chunk, tile, counts);
    }
    shading.activeLanes = kAllLanes;
    statistics.blocksShaded += counts.blocks;
    statistics.quadsShaded += counts.quadPixels / 4;
    statistics.pixelsShaded += counts.pixels;
    statistics.pixelsHidden += counts.covered - counts.pixels;
    statistics.invalidColors += counts.invalid;
}

}  // namespace relief::inline RELIEF_WIDTH

// From covered blocks to pixels: the early depth test, the fragment program, the output merger. Blocks go through these
// steps in small groups, so that a program is called once for several of them; a group's data stay in the first-level
// cache. All depths of a group are tested and written before its first colour is merged: depth does not depend on
// colour, and both keep the order of submission, so every pixel is what it would be one block at a time. Only a program
// that discards decides about depth: its blocks go one by one.
#include "pipeline/draw.h"

#include <algorithm>
#include <array>

#include "leave_out.h"
#include "pipeline/output_merger.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

constexpr std::size_t kBlocksPerGroup = 16;

// With so many blocks in a run its triangles are large: it pays to look at the bounds of the whole tile, which are
// often in front of all that is drawn over it later.
constexpr std::size_t kBlocksOfLargeTriangles = 64;

// Of one run of blocks.
struct Counts
{
    unsigned blocks = 0, quads = 0, pixels = 0, hidden = 0, invalid = 0;
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
struct UsualState
{
    static constexpr Compare depthTest = Compare::less;
    static constexpr bool usesDepth = true, depthWrite = true, discards = false;
    bool readsEdges;
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
void writeDepth(const State& state, const TriangleWeights& triangle, const ShadedBlock& block, Mask live, Float depth,
                Float old, Tile& tile)
{
    if (!state.depthWrite || none(live)) return;
    select(live, depth, old).store(tile.depth(block.index));
    updateBounds(state.depthTest, triangle.nearest, triangle.farthest, !state.discards && block.coverage == kAllLanes,
                 tile.bounds(block.index));
}

// Before the program runs: which pixels pass the depth test. Their depth is written here, too, unless the program may
// throw them away afterwards. Returns whether there is anything to shade.
template <class State>
bool testEarly(const State& state, const TriangleInTile& triangle, ShadedBlock& block, Tile& tile, Counts& counts)
{
    const TriangleWeights& weights = triangle.weights;
    block.live = block.coverage;
    if (leavesOut::hidden && state.usesDepth &&
        isHidden(state.depthTest, weights.nearest, weights.farthest, tile.bounds(block.index))) {
        counts.hidden += static_cast<unsigned>(countBits(block.coverage));
        return false;
    }
    if (state.usesDepth || state.readsEdges) {
        const Float edge1 = triangle.edges.at(1, block.x, block.y), edge2 = triangle.edges.at(2, block.x, block.y);
        if (state.usesDepth) {
            const Float depth = weights.depth(edge1, edge2), old = Float::load(tile.depth(block.index));
            const Mask live = Mask::fromBits(block.coverage) & compareDepth(state.depthTest, depth, old);
            block.live = live.bits();
            if (!state.discards) writeDepth(state, weights, block, live, depth, old, tile);
            counts.hidden += static_cast<unsigned>(countBits(block.coverage) - countBits(block.live));
            if (leavesOut::hidden && block.live == 0) return false;
        }
        if (state.readsEdges) {
            triangle.edges.at(0, block.x, block.y).store(block.edge[0]);
            edge1.store(block.edge[1]);
            edge2.store(block.edge[2]);
        }
    }
    block.quads = wholeQuads(leavesOut::hidden ? block.live : block.coverage);
    counts.blocks += 1;
    counts.quads += static_cast<unsigned>(countBits(block.quads)) / 4;
    counts.pixels += static_cast<unsigned>(countBits(block.live));
    return true;
}

// What a discarding program has left of a block: its depth is written now.
template <class State>
void testLate(const State& state, const TriangleInTile& triangle, ShadedBlock& block, Tile& tile)
{
    block.live &= ~block.discarded;
    if (!state.usesDepth) return;
    const Float edge1 = triangle.edges.at(1, block.x, block.y), edge2 = triangle.edges.at(2, block.x, block.y);
    writeDepth(state, triangle.weights, block, Mask::fromBits(block.live), triangle.weights.depth(edge1, edge2),
               Float::load(tile.depth(block.index)), tile);
}

template <Format format>
void mergeBlocks(std::span<const ShadedBlock> blocks, Blend blend, Tile& tile, Counts& counts)
{
    ColorMerger<format> merger(blend);
    for (const ShadedBlock& block : blocks) {
        const float4 color(Float::load(block.color[0]), Float::load(block.color[1]), Float::load(block.color[2]),
                           Float::load(block.color[3]));
        counts.invalid +=
            static_cast<unsigned>(merger.merge(tile.color<format>(block.index), color, Mask::fromBits(block.live)));
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
    const bool isLarge = blocks.size() >= kBlocksOfLargeTriangles;
    std::array<ShadedBlock, kBlocksPerGroup> group;
    std::array<TriangleCorners, kLanes> corners;
    TriangleInTile triangle(batch, blocks.front().triangle);
    corners[static_cast<std::size_t>(triangle.lane)] = cornersOf(draw, chunk, *batch.triangle[triangle.lane]);
    for (auto next = blocks.begin(); next != blocks.end();) {
        std::size_t count = 0;
        for (; next != blocks.end() && count < groupSize; ++next) {
            if (next->triangle != triangle.lane) {
                triangle.set(batch, next->triangle);
                corners[static_cast<std::size_t>(triangle.lane)] =
                    cornersOf(draw, chunk, *batch.triangle[triangle.lane]);
            }
            if (leavesOut::hidden && isLarge && state.usesDepth &&
                isHidden(state.depthTest, triangle.weights.nearest, triangle.weights.farthest, tile.wholeBounds())) {
                counts.hidden += static_cast<unsigned>(countBits(next->coverage));
                continue;
            }
            ShadedBlock& block = group[count];
            block.x = next->x;
            block.y = next->y;
            block.index = tile.blockAt(next->x, next->y);
            block.triangle = next->triangle;
            block.coverage = next->coverage;
            if (testEarly(state, triangle, block, tile, counts)) ++count;
        }
        if (!runsProgram || count == 0) continue;
        const std::span<ShadedBlock> shaded(group.data(), count);
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
    if (state.isUsual()) {
        shadeBlocksIn(UsualState{state.readsEdges}, draw, blocks, batch, chunk, tile, counts);
    } else {
        shadeBlocksIn(state, draw, blocks, batch, chunk, tile, counts);
    }
    shading.activeLanes = kAllLanes;
    statistics.blocksShaded += counts.blocks;
    statistics.quadsShaded += counts.quads;
    statistics.pixelsShaded += counts.pixels;
    statistics.pixelsHidden += counts.hidden;
    statistics.invalidColors += counts.invalid;
}

}  // namespace relief::inline RELIEF_WIDTH

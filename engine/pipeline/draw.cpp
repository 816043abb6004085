// From covered blocks to pixels: the early depth test, the fragment program, the output merger. Blocks go through these
// steps in small groups, so that a program is called once for several of them; a group's data stay in the first-level
// cache. All depths of a group are tested and written before its first colour is merged: depth does not depend on
// colour, and both keep the order of submission, so every pixel is what it would be one block at a time. Only a program
// that discards decides about depth: its blocks go one by one.
#include "pipeline/draw.h"

#include <array>

#include "leave_out.h"
#include "pipeline/output_merger.h"

namespace relief {

namespace {

constexpr std::size_t kBlocksPerGroup = 16;

// One triangle's way through a run of blocks.
struct TriangleInTile
{
    TriangleWeights weights;
    TriangleEdges edges;
    int lane = -1;

    void set(const TriangleBatch& batch, int triangle)
    {
        lane = triangle;
        weights.set(batch, triangle);
        edges.set(batch, triangle);
    }
};

// What of a draw's state a block asks for.
struct BlockState
{
    Compare depthTest;
    bool usesDepth, depthWrite, discards;

    BlockState(const Draw& draw, const Tile& tile)
        : depthTest(tile.hasDepth() ? draw.state.depthTest : Compare::always),
          usesDepth(tile.hasDepth() && (depthTest != Compare::always || draw.state.depthWrite)),
          depthWrite(tile.hasDepth() && draw.state.depthWrite),
          discards(draw.programs->discards)
    {
    }
};

// Writes the depth of a block's live pixels.
void writeDepth(const BlockState& state, const TriangleWeights& triangle, const ShadedBlock& block, Float depth,
                Float old, Tile& tile)
{
    if (!state.depthWrite || none(block.live)) return;
    select(block.live, depth, old).store(tile.depth(block.index));
    updateBounds(state.depthTest, triangle.nearest, triangle.farthest,
                 !state.discards && block.coverage == kAllLanes, tile.bounds(block.index));
}

// Before the program runs: which pixels pass the depth test. Their depth is written here, too, unless the program may
// throw them away afterwards. Returns whether there is anything to shade.
bool testEarly(const BlockState& state, const TriangleWeights& triangle, ShadedBlock& block, Tile& tile,
               Statistics& statistics)
{
    const auto hidden = [&](int pixels) { statistics.pixelsHidden += static_cast<unsigned>(pixels); };
    block.live = Mask::fromBits(block.coverage);
    if (state.usesDepth) {
        if (leavesOut::hidden &&
            isHidden(state.depthTest, triangle.nearest, triangle.farthest, tile.bounds(block.index))) {
            hidden(countBits(block.coverage));
            return false;
        }
        const Float depth = triangle.depth(block.edge), old = Float::load(tile.depth(block.index));
        block.live &= compareDepth(state.depthTest, depth, old);
        if (!state.discards) writeDepth(state, triangle, block, depth, old, tile);
        hidden(countBits(block.coverage) - count(block.live));
        if (leavesOut::hidden && none(block.live)) return false;
    }
    block.quads = wholeQuads(leavesOut::hidden ? block.live.bits() : block.coverage);
    statistics.blocksShaded += 1;
    statistics.quadsShaded += static_cast<unsigned>(countBits(block.quads)) / 4;
    statistics.pixelsShaded += static_cast<unsigned>(count(block.live));
    return true;
}

// After the program has run.
void merge(const Draw& draw, const BlockState& state, const TriangleWeights& triangle, ShadedBlock& block, Tile& tile,
           Statistics& statistics)
{
    if (state.discards) {
        block.live &= !block.discarded;
        if (state.usesDepth) {
            writeDepth(state, triangle, block, triangle.depth(block.edge), Float::load(tile.depth(block.index)), tile);
        }
    }
    if (!tile.hasColor()) return;
    statistics.invalidColors += static_cast<unsigned>(sanitizeColor(block.color, block.live));
    mergeColor(tile.colorFormat(), draw.state.blend, tile.color(block.index), block.color, block.live);
}

}  // namespace

void shadeBlocks(const Draw& draw, std::span<const CoveredBlock> blocks, const TriangleBatch& batch,
                 const TriangleChunk& chunk, Tile& tile, Statistics& statistics)
{
    const BlockState state(draw, tile);
    const bool runsProgram = tile.hasColor() || state.discards;
    const std::size_t groupSize = state.discards ? 1 : kBlocksPerGroup;
    std::array<ShadedBlock, kBlocksPerGroup> group;
    std::array<TriangleCorners, kLanes> corners;
    TriangleInTile triangle;
    for (auto next = blocks.begin(); next != blocks.end();) {
        std::size_t count = 0;
        for (; next != blocks.end() && count < groupSize; ++next) {
            if (next->triangle != triangle.lane) {
                triangle.set(batch, next->triangle);
                for (int k = 0; k < 3; ++k) {
                    corners[next->triangle].components[k] =
                        componentsOf(draw.geometry, chunk, batch.triangle[next->triangle]->vertex[k]);
                }
            }
            ShadedBlock& block = group[count];
            block.x = next->x;
            block.y = next->y;
            block.index = tile.blockAt(next->x, next->y);
            block.triangle = next->triangle;
            block.coverage = next->coverage;
            triangle.edges.at(block.x, block.y, block.edge);
            if (testEarly(state, triangle.weights, block, tile, statistics)) ++count;
        }
        if (!runsProgram || count == 0) continue;
        const std::span<ShadedBlock> shaded(group.data(), count);
        draw.programs->shadeBlocks(draw.fragmentProgram.get(), shaded, batch, corners.data());
        for (ShadedBlock& block : shaded) merge(draw, state, triangle.weights, block, tile, statistics);
    }
    shading.activeLanes = kAllLanes;
}

}  // namespace relief

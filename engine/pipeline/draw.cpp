// From covered blocks to pixels: the early depth test, the fragment program, the output merger. Blocks go through these
// steps in small groups, so that a program is called once for several of them; a group's data stay in the first-level
// cache. All depths of a group are tested and written before its first colour is merged: depth does not depend on
// colour, and both keep the order of submission, so every pixel is what it would be one block at a time. Only a program
// that discards decides about depth, and alpha to coverage does: their blocks go one by one.
#include "pipeline/draw.h"

#include <algorithm>
#include <array>

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
    TriangleEdges sampleEdges[severalSamples ? kMaxSamples : 1];
    int lane;

    TriangleInTile(const TriangleBatch& batch, int triangle) { set(batch, triangle); }
    void set(const TriangleBatch& batch, int triangle)
    {
        lane = triangle;
        weights.set(batch, triangle);
        edges.set(batch, triangle);
        if constexpr (severalSamples) {
            for (int s = 0; s < batch.samples->count; ++s)
                sampleEdges[s].set(batch, triangle, batch.samples->position[static_cast<std::size_t>(s)]);
        }
    }
    void edgesAt(int sample, int x, int y, Float (&edge)[3]) const
    {
        (severalSamples ? sampleEdges[sample] : edges).at(x, y, edge);
    }
};

// How many samples there are, where one of a block's lies in the tile's planes, and in which lanes it counts: known
// while compiling where there is one.
template <bool several>
int sampleCount(const Tile& tile)
{
    return several ? tile.samples().count : 1;
}
template <bool several>
int placeOf(const Tile& tile, int block, int sample)
{
    return several ? tile.sampleOf(block, sample) : block;
}
template <bool several>
unsigned liveLanes(const ShadedBlock& block, int sample)
{
    return several ? block.liveSamples[static_cast<std::size_t>(sample)] : block.live;
}

// Writes the depth of a block's live pixels.
template <class State>
void writeDepth(const State& state, const TriangleWeights& triangle, bool isWhole, Mask live, Float depth, Float old,
                float* stored, DepthBounds& bounds)
{
    if (!state.depthWrite || none(live)) return;
    select(live, depth, old).store(stored);
    updateBounds(state.depthTest, triangle.nearest, triangle.farthest, isWhole, bounds);
}

void storeEdges(const Float (&edge)[3], float (&to)[3][kLanes])
{
    for (int k = 0; k < 3; ++k) edge[k].store(to[k]);
}

// Moves pixels whose centre is not in the triangle to the first sample that is.
template <bool several>
void findCentroids(const TriangleInTile<several>& triangle, const SampleCoverage& samples, unsigned inside,
                   const CoveredBlock& covered, int count, ShadedBlock& block)
{
    for (int s = 0; s < count; ++s) {
        const unsigned lanes = samples[static_cast<std::size_t>(s)] & ~inside;
        if (lanes == 0) continue;
        Float edge[3];
        triangle.edgesAt(s, covered.x, covered.y, edge);
        for (int k = 0; k < 3; ++k)
            select(Mask::fromBits(lanes), edge[k], Float::load(block.centroid[k])).store(block.centroid[k]);
        inside |= lanes;
    }
}

// Before the program runs: which samples pass the depth test. Their depth is written here, too, unless the program may
// throw them away afterwards. Returns whether there is anything to shade. `samples` where a pixel has several.
template <class State>
bool testEarly(const State& state, const TriangleInTile<State::severalSamples>& triangle, const CoveredBlock& covered,
               const SampleCoverage* samples, bool isLarge, ShadedBlock& block, Tile& tile, Counts& counts)
{
    constexpr bool several = State::severalSamples;
    const TriangleWeights& weights = triangle.weights;
    const int x = covered.x, y = covered.y, index = tile.blockAt(x, y);
    const unsigned coverage = covered.coverage;
    counts.covered += static_cast<unsigned>(countBits(coverage));
    const auto hidden = [&](const DepthBounds& bounds) {
        return isHidden(state.depthTest, weights.nearest, weights.farthest, bounds);
    };
    if (leavesOut::hidden && state.usesDepth) {
        if (isLarge && hidden(tile.wholeBounds())) return false;
        if (hidden(tile.bounds(index))) return false;
    }
    Float centre[3];
    if (several || state.usesDepth || state.readsEdges) triangle.edges.at(x, y, centre);
    unsigned live = several ? 0 : coverage, everywhere = coverage;
    for (int s = 0; s < sampleCount<several>(tile) && (several || state.usesDepth); ++s) {
        unsigned lanes = several ? (*samples)[static_cast<std::size_t>(s)] : coverage;
        everywhere &= lanes;
        if (state.usesDepth) {
            Float edge[3] = {centre[0], centre[1], centre[2]};
            if constexpr (several) triangle.edgesAt(s, x, y, edge);
            float* const stored = tile.depth(placeOf<several>(tile, index, s));
            const Float depth = weights.depth(edge[1], edge[2]), old = Float::load(stored);
            const Mask passed = Mask::fromBits(lanes) & compareDepth(state.depthTest, depth, old);
            const bool isWhole = !several && coverage == kAllLanes;
            if (!state.discards) writeDepth(state, weights, isWhole, passed, depth, old, stored, tile.bounds(index));
            lanes = passed.bits();
        }
        if constexpr (several) block.liveSamples[static_cast<std::size_t>(s)] = static_cast<std::uint16_t>(lanes);
        live = several ? live | lanes : lanes;
    }
    if (leavesOut::hidden && live == 0) return false;
    if (several && everywhere == kAllLanes && state.depthWrite && !state.discards)
        updateBounds(state.depthTest, weights.nearest, weights.farthest, true, tile.bounds(index));
    if (state.readsEdges) storeEdges(centre, block.edge);
    if (state.readsCentroids) storeEdges(centre, block.centroid);
    const unsigned quads = wholeQuads(leavesOut::hidden ? live : coverage);
    counts.quadPixels += static_cast<unsigned>(countBits(quads));
    counts.pixels += static_cast<unsigned>(countBits(live));
    block.live = live;
    block.quads = quads;
    block.index = index;
    block.covered = covered;
    if constexpr (several) {
        const Mask inside = (centre[0] >= 0.0f) & (centre[1] >= 0.0f) & (centre[2] >= 0.0f);
        block.covered.coverage = static_cast<std::uint16_t>(inside.bits());
        if (state.readsCentroids)
            findCentroids(triangle, *samples, inside.bits(), covered, tile.samples().count, block);
    }
    return true;
}

// The lanes whose alpha is enough for a sample: the first one takes the least, and each one after it more.
unsigned keptByAlpha(const ShadedBlock& block, int sample, int count)
{
    const float least = (static_cast<float>(sample) + 0.5f) / static_cast<float>(count);
    return (Float::load(block.color[3]) >= least).bits();
}

// What a discarding program has left of a block, or its alpha: its depth is written now.
template <class State>
void testLate(const State& state, const Draw& draw, const TriangleInTile<State::severalSamples>& triangle,
              ShadedBlock& block, Tile& tile)
{
    constexpr bool several = State::severalSamples;
    const int count = sampleCount<several>(tile);
    unsigned live = 0;
    for (int s = 0; s < count; ++s) {
        unsigned lanes = liveLanes<several>(block, s);
        if (draw.programs->discards) lanes &= ~block.discarded;
        if (draw.state.alphaToCoverage) lanes &= keptByAlpha(block, s, count);
        if constexpr (several) block.liveSamples[static_cast<std::size_t>(s)] = static_cast<std::uint16_t>(lanes);
        live |= lanes;
        if (!state.usesDepth) continue;
        Float edge[3];
        triangle.edgesAt(s, block.covered.x, block.covered.y, edge);
        float* const stored = tile.depth(placeOf<several>(tile, block.index, s));
        writeDepth(state, triangle.weights, false, Mask::fromBits(lanes), triangle.weights.depth(edge[1], edge[2]),
                   Float::load(stored), stored, tile.bounds(block.index));
    }
    block.live = live;
}

template <Format format, bool several>
void mergeBlocks(std::span<const ShadedBlock> blocks, Blend blend, Tile& tile, Counts& counts)
{
    ColorWriter<format> writer;
    for (const ShadedBlock& block : blocks) {
        float4 color;
        if (blend == Blend::off) {
            counts.invalid += static_cast<unsigned>(writer.encode(block.color, block.live));
        } else {
            color = loadChannels(block.color);
            counts.invalid += static_cast<unsigned>(sanitizeColor(color, Mask::fromBits(block.live)));
        }
        for (int s = 0; s < sampleCount<several>(tile); ++s) {
            const Mask live = Mask::fromBits(liveLanes<several>(block, s));
            std::int32_t* const words = tile.color<format>(placeOf<several>(tile, block.index, s));
            if (blend == Blend::off) {
                writer.store(words, live);
            } else {
                blendOnto<format>(words, blend, color, live);
            }
        }
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
    std::array<ShadedBlock, kBlocksPerGroup> group;
    std::array<TriangleCorners, kLanes> corners;
    TriangleInTile<severalSamples> triangle(batch, blocks.front().triangle);
    corners[static_cast<std::size_t>(triangle.lane)] = cornersOf(draw, chunk, *batch.triangle[triangle.lane]);
    for (auto next = blocks.begin(); next != blocks.end();) {
        std::size_t count = 0;
        for (; next != blocks.end() && count < groupSize; ++next) {
            if (next->triangle != triangle.lane) {
                triangle.set(batch, next->triangle);
                corners[static_cast<std::size_t>(triangle.lane)] =
                    cornersOf(draw, chunk, *batch.triangle[triangle.lane]);
            }
            const SampleCoverage* of = severalSamples ? samples + (next - blocks.begin()) : nullptr;
            if (testEarly(state, triangle, *next, of, isLarge, group[count], tile, counts)) ++count;
        }
        counts.blocks += static_cast<unsigned>(count);
        if (!runsProgram || count == 0) continue;
        const std::span<ShadedBlock> shaded(group.data(), count);
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

}  // namespace

[[gnu::flatten]] void shadeBlocks(const Draw& draw, std::span<const CoveredBlock> blocks, const SampleCoverage* samples,
                                  const TriangleBatch& batch, const TriangleChunk& chunk, Tile& tile,
                                  Statistics& statistics)
{
    Counts counts;
    const AnyState<false> state(draw, tile);
    if (tile.samples().isMultiple()) {
        shadeBlocksIn(AnyState<true>(draw, tile), draw, blocks, samples, batch, chunk, tile, counts);
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

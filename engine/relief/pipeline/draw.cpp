// From covered blocks to pixels: the early depth test, the fragment program, the output merger. Blocks go through these
// steps in small groups, so that a program is called once for several of them; a group's data stay in the first-level
// cache. All depths and stencils of a group are tested and written before its first colour is merged: they do not
// depend on colour, and both keep the order of submission, so every pixel is what it would be one block at a time. Only
// a program that discards, or gives depth or coverage, decides about them, and alpha to coverage does: their blocks go
// one by one.
#include "relief/pipeline/draw.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "relief/leave_out.h"
#include "relief/pipeline/output_merger.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

constexpr std::size_t kBlocksPerGroup = 16;
constexpr std::size_t kFirstGroup = 4;  // of a draw in a tile, when it is not known yet whether its blocks will share

// Where a run has so many blocks a triangle it pays to look at the bounds of the whole tile, which are often in front
// of all that is drawn over it later; and at what a block has in common with the one before.
constexpr int kBlocksOfLargeTriangle = 64;

// Of one run of blocks.
struct Counts
{
    unsigned blocks = 0, quadPixels = 0, pixels = 0, hidden = 0, colorless = 0, invalid = 0;
    unsigned whole = 0;  // blocks of which all pixels are live: in none of the pixels above
    unsigned stencilTested = 0, stencilPassed = 0;
};

// What of a draw's state a block asks for: any, with one sample a pixel or several, or the usual one, of which the
// compiler knows most.
template <bool several>
struct AnyState
{
    static constexpr bool severalSamples = several, hasOneTarget = false;
    Compare depthTest;
    bool usesDepth, depthWrite, usesStencil;
    bool decides;    // decidesCoverage()
    bool testsLate;  // and whether the tests need to know
    bool readsEdges, readsCentroids;
    const Outputs& outputs;
    const Stencil& stencil;

    AnyState(const Draw& draw, const Tile& tile)
        : depthTest(tile.hasDepth() ? draw.state.depthTest : Compare::always),
          usesDepth(tile.hasDepth() && (depthTest != Compare::always || draw.state.depthWrite)),
          depthWrite(tile.hasDepth() && draw.state.depthWrite),
          usesStencil(tile.hasStencil() && draw.state.stencil.isUsed()),
          decides(decidesCoverage(draw)),
          testsLate(draw.programs->outputs.depth || (decides && usesStencil)),
          readsEdges(draw.programs->components > 0),
          readsCentroids(draw.geometry.hasCentroid),
          outputs(draw.programs->outputs),
          stencil(draw.state.stencil)
    {
    }
    bool isUsual() const
    {
        return depthTest == Compare::less && depthWrite && !usesStencil && !decides && !readsCentroids &&
               !outputs.more();
    }
};
template <bool interpolates>
struct UsualState
{
    static constexpr bool severalSamples = false, hasOneTarget = true;
    static constexpr Compare depthTest = Compare::less;
    static constexpr bool usesDepth = true, depthWrite = true, usesStencil = false, decides = false, testsLate = false,
                          readsEdges = interpolates, readsCentroids = false;
    static constexpr Outputs outputs = {1, false, false};
    static constexpr Stencil stencil = {};
};

// One triangle's way through a run of blocks: its edges at the pixels' centres, and at their samples, where there are
// several.
template <bool severalSamples>
struct TriangleInTile
{
    TriangleWeights weights;
    DepthPlane<Float> plane;
    TriangleEdges edges;
    std::array<TriangleEdges, severalSamples ? kMaxSamples : 0> sampleEdges;
    int lane = -1;
    bool isFront;

    void set(const Draw& draw, const TriangleBatch& batch, int triangle)
    {
        lane = triangle;
        isFront = relief::isFront(draw.geometry, *batch.triangle[lane]);
        weights.set(batch, triangle);
        plane.set(batch, triangle);
        edges.set(batch, triangle);
        if constexpr (severalSamples) {
            for (std::size_t s = 0; s < static_cast<std::size_t>(batch.samples->count); ++s)
                sampleEdges[s].set(batch, triangle, batch.samples->position[s]);
        }
    }
};

// Whether bounds alone show that a triangle is behind all that they are of.
template <class State>
bool isBehind(const State& state, const TriangleWeights& triangle, const DepthBounds& bounds)
{
    return leavesOut::hidden && state.usesDepth && !state.usesStencil && !state.testsLate &&
           isHidden(state.depthTest, triangle.nearest, triangle.farthest, bounds);
}

// Whether a triangle covers all of a block, and bounds alone show that it is in front of what is there: nothing is
// compared then.
template <class State>
bool replacesDepths(const State& state, const TriangleWeights& triangle, bool isWhole, const DepthBounds& bounds)
{
    return isWhole && state.depthWrite && !state.decides &&
           isInFront(state.depthTest, triangle.nearest, triangle.farthest, bounds);
}

// Writes the depth of a block's live pixels, all of which lie between two depths.
template <class State>
void writeDepth(const State& state, const DepthBounds& between, bool isWhole, unsigned live, Float depth, Float old,
                float* stored, DepthBounds& bounds)
{
    if (!state.depthWrite || live == 0) return;
    select(Mask::fromBits(live), depth, old).store(stored);
    updateBounds(state.depthTest, between.nearest, between.farthest, isWhole, bounds);
}

DepthBounds depthsOf(const TriangleWeights& triangle)
{
    return {triangle.nearest, triangle.farthest};
}

// The stencil test, the depth test, and what both write, of one sample of a block's pixels. Returns the lanes that
// pass.
template <class State>
[[gnu::noinline]] unsigned testStencilAndDepth(const State& state, bool isFront, unsigned lanes, Float depth,
                                               const DepthBounds& between, int block, int sample, Tile& tile,
                                               Counts& counts)
{
    const StencilFace& face = isFront ? state.stencil.front : state.stencil.back;
    std::int32_t* const words = state.usesStencil ? tile.stencil(sample) : nullptr;
    const unsigned tested = lanes;
    if (words != nullptr) {
        lanes &= testStencil(state.stencil, face, Int::load(words)).bits();
        counts.stencilTested += static_cast<unsigned>(countBits(tested));
        counts.stencilPassed += static_cast<unsigned>(countBits(lanes));
    }
    const unsigned passed = lanes;
    if (state.usesDepth) {
        float* const stored = tile.depth(sample);
        const Float old = Float::load(stored);
        lanes &= compareBy(state.depthTest, depth, old).bits();
        writeDepth(state, between, false, lanes, depth, old, stored, tile.bounds(block));
    }
    if (words != nullptr) {
        stencilAfter(state.stencil, face, Int::load(words), Mask::fromBits(tested), Mask::fromBits(passed),
                     Mask::fromBits(lanes))
            .store(words);
    }
    return lanes;
}

// Not in a loop, in which g++ 12 would keep the values in memory.
void storeEdges(const Float (&edge)[3], float (&to)[3][kLanes])
{
    edge[0].store(to[0]);
    edge[1].store(to[1]);
    edge[2].store(to[2]);
}

// A block that is not to be shaded. False, for testEarly().
bool hide(const CoveredBlock& covered, Counts& counts)
{
    counts.hidden += static_cast<unsigned>(countBits(covered.coverage));
    return false;
}

// All blocks of a triangle, the first ones in a row. Returns where the next triangle's begin.
const CoveredBlock* hideTriangle(const CoveredBlock* next, const CoveredBlock* end, Counts& counts)
{
    for (const int triangle = next->triangle; next != end && next->triangle == triangle; ++next) hide(*next, counts);
    return next;
}

// A block that is to be shaded. `whole`: live lanes that are worth a branch: all, as they are in the next block, too,
// or in small triangles none. To compare with these is foreseen in both cases.
void setBlock(ShadedBlock& block, const CoveredBlock& covered, int index, unsigned live, unsigned whole, Counts& counts)
{
    block.live = live;
    block.index = index;
    block.covered = covered;
    if (live == whole) {
        block.quads = kAllLanes;
        ++counts.whole;
        return;
    }
    block.quads = wholeQuads(leavesOut::hidden ? live : covered.coverage);
    counts.quadPixels += static_cast<unsigned>(countBits(block.quads));
    counts.pixels += static_cast<unsigned>(countBits(live));
    counts.hidden += static_cast<unsigned>(countBits(covered.coverage & ~live));
}

// Before the program runs: which pixels pass the depth test. Their depth is written here, too, unless the program may
// throw them away afterwards. Returns whether there is anything to shade.
template <class State>
bool testEarly(const State& state, const TriangleInTile<false>& triangle, const CoveredBlock& covered,
               const SampleCoverage* /* the one sample's is the block's */, unsigned whole, ShadedBlock& block,
               Tile& tile, Counts& counts)
{
    const TriangleWeights& weights = triangle.weights;
    const int x = covered.x, y = covered.y, index = tile.blockAt(x, y);
    const unsigned coverage = covered.coverage;
    DepthBounds& bounds = tile.bounds(index);
    if (isBehind(state, weights, bounds)) return hide(covered, counts);
    unsigned live = coverage;
    if (state.usesDepth || state.usesStencil || state.readsEdges) {
        Float edge[3];
        triangle.edges.at(x, y, edge);
        if (state.testsLate) {
            // and all pixels are shaded
        } else if (state.usesStencil) {
            live = testStencilAndDepth(state, triangle.isFront, live, weights.depth(edge[1], edge[2]),
                                       depthsOf(weights), index, index, tile, counts);
            if (leavesOut::hidden && live == 0) return hide(covered, counts);
        } else if (state.usesDepth) {
            float* const stored = tile.depth(index);
            const Float depth = triangle.plane.stored(edge[1], edge[2]);
            if (replacesDepths(state, weights, coverage == whole, bounds)) {
                depth.store(stored);
                bounds = depthsOf(weights);
            } else {
                const Float old = Float::load(stored);
                live &= compareBy(state.depthTest, depth, old).bits();
                if (leavesOut::hidden && live == 0) return hide(covered, counts);
                if (!state.decides)
                    writeDepth(state, depthsOf(weights), coverage == kAllLanes, live, depth, old, stored, bounds);
            }
        }
        if (state.readsEdges) storeEdges(edge, block.edge);
        if (state.readsCentroids) storeEdges(edge, block.centroid);
    }
    setBlock(block, covered, index, live, whole, counts);
    return true;
}

// The same where a pixel has several samples, each with a depth of its own.
template <class State>
bool testEarly(const State& state, const TriangleInTile<true>& triangle, const CoveredBlock& covered,
               const SampleCoverage* samples, unsigned whole, ShadedBlock& block, Tile& tile, Counts& counts)
{
    const TriangleWeights& weights = triangle.weights;
    const int x = covered.x, y = covered.y, index = tile.blockAt(x, y);
    DepthBounds& bounds = tile.bounds(index);
    if (isBehind(state, weights, bounds)) return hide(covered, counts);
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
        const Float depth = weights.depth(edge[1], edge[2]);
        const int sample = tile.sampleOf(index, s);
        if (state.testsLate) {
            // and all samples are shaded
        } else if (!state.decides) {
            lanes = testStencilAndDepth(state, triangle.isFront, lanes, depth, depthsOf(weights), index, sample, tile,
                                        counts);
        } else if (state.usesDepth) {
            lanes &= compareBy(state.depthTest, depth, Float::load(tile.depth(sample))).bits();
        }
        block.liveSamples[static_cast<std::size_t>(s)] = static_cast<std::uint16_t>(lanes);
        live |= lanes;
    }
    if (leavesOut::hidden && live == 0) return hide(covered, counts);
    if (everywhere == kAllLanes && state.depthWrite && !state.decides && !state.usesStencil)
        updateBounds(state.depthTest, weights.nearest, weights.farthest, true, bounds);
    setBlock(block, covered, index, live, whole, counts);
    block.covered.coverage = static_cast<std::uint16_t>(inside);
    return true;
}

// Which of these lanes the program has left, and whose alpha is enough for a sample: the first one takes the least, and
// each one after it more. A program without a first colour has no alpha.
unsigned keptLanes(const Draw& draw, const ShadedBlock& block, unsigned lanes, int sample, int count)
{
    if (draw.programs->discards) lanes &= ~block.discarded;
    if (draw.programs->outputs.coverage) lanes &= ((Int::load(block.more->coverage) & (1 << sample)) != 0).bits();
    if (!draw.state.alphaToCoverage || (draw.programs->outputs.targets & 1u) == 0) return lanes;
    const float least = (static_cast<float>(sample) + 0.5f) / static_cast<float>(count);
    return lanes & (Float::load(block.color[3]) >= least).bits();
}

// After the program: the tests that waited for it, or the depth of what is left. Returns the lanes that are drawn.
template <class State>
unsigned testLate(const State& state, bool isFront, const TriangleWeights& weights, const TriangleEdges& edges,
                  const ShadedBlock& block, unsigned lanes, int sample, Tile& tile, Counts& counts)
{
    if (!state.usesDepth && !state.testsLate) return lanes;
    Float edge[3];
    edges.at(block.covered.x, block.covered.y, edge);
    Float depth = weights.depth(edge[1], edge[2]);
    DepthBounds between = depthsOf(weights);
    if (state.outputs.depth) {
        depth = saturate(Float::load(block.more->depth));
        between = {0.0f, 1.0f};
    }
    if (state.testsLate)
        return testStencilAndDepth(state, isFront, lanes, depth, between, block.index, sample, tile, counts);
    float* const stored = tile.depth(sample);
    writeDepth(state, between, false, lanes, depth, Float::load(stored), stored, tile.bounds(block.index));
    return lanes;
}
template <class State>
void testLate(const State& state, const Draw& draw, const TriangleInTile<false>& triangle, ShadedBlock& block,
              Tile& tile, Counts& counts)
{
    const unsigned lanes = keptLanes(draw, block, block.live, 0, 1);
    block.live =
        testLate(state, triangle.isFront, triangle.weights, triangle.edges, block, lanes, block.index, tile, counts);
}
template <class State>
void testLate(const State& state, const Draw& draw, const TriangleInTile<true>& triangle, ShadedBlock& block,
              Tile& tile, Counts& counts)
{
    block.live = 0;
    for (int s = 0; s < tile.samples().count; ++s) {
        const auto number = static_cast<std::size_t>(s);
        const unsigned kept = keptLanes(draw, block, block.liveSamples[number], s, tile.samples().count);
        const unsigned lanes = testLate(state, triangle.isFront, triangle.weights, triangle.sampleEdges[number], block,
                                        kept, tile.sampleOf(block.index, s), tile, counts);
        block.liveSamples[number] = static_cast<std::uint16_t>(lanes);
        block.live |= lanes;
    }
}

// Calls merge(words, live lanes) for each sample of a block; `plane` are the target's words.
template <Format format, bool severalSamples, class Merge>
void forSamples(const Tile& tile, std::int32_t* plane, const ShadedBlock& block, const Merge& merge)
{
    const auto wordsOf = [plane](int sample) {
        return plane + static_cast<std::ptrdiff_t>(sample) * (kLanes * wordsPerPixel(format));
    };
    if constexpr (severalSamples) {
        for (int s = 0; s < tile.samples().count; ++s)
            merge(wordsOf(tile.sampleOf(block.index, s)), block.liveSamples[static_cast<std::size_t>(s)]);
    } else {
        merge(wordsOf(block.index), block.live);
    }
}

// Returns how many pixels had a NaN or an infinity. By itself, so that its numbers stay in registers.
template <Format format, bool severalSamples>
[[gnu::noinline, gnu::flatten]] unsigned mergeBlocks(std::span<const ShadedBlock> blocks, int target, Blend blend,
                                                     bool isLarge, Tile& tile)
{
    std::int32_t* const plane = tile.color<format>(target, 0);
    unsigned allInvalid = 0;
    const auto forEach = [&](const auto& merge) {
        if (target == 0) {
            for (const ShadedBlock& block : blocks) allInvalid += static_cast<unsigned>(merge(block, block.color));
        } else {
            for (const ShadedBlock& block : blocks)
                allInvalid += static_cast<unsigned>(merge(block, block.more->color[target - 1]));
        }
    };
    if (blend == Blend::off) {
        ColorWriter<format> writer(isLarge);
        forEach([&](const ShadedBlock& block, const Channels& color) {
            const int invalid = writer.set(color, block.live);
            forSamples<format, severalSamples>(tile, plane, block,
                                               [&](std::int32_t* words, unsigned live) { writer.store(words, live); });
            return invalid;
        });
    } else {
        forEach([&](const ShadedBlock& block, const Channels& channels) {
            float4 color = loadChannels(channels);
            const int invalid = sanitizeColor(color, Mask::fromBits(block.live));
            forSamples<format, severalSamples>(tile, plane, block, [&](std::int32_t* words, unsigned live) {
                blendInto<format>(words, blend, color, Mask::fromBits(live));
            });
            return invalid;
        });
    }
    return allInvalid;
}

// Runs the program on a group's blocks, those with few live quads in shared ones. Each goes where it leaves the least
// room. Returns how often the program ran.
[[gnu::noinline]] unsigned shadeTogether(const Draw& draw, std::span<ShadedBlock> blocks, const TriangleBatch& batch,
                                         const TriangleCorners* corners)
{
    constexpr std::size_t none = kBlocksPerGroup;
    std::array<SharedBlock, kBlocksPerGroup> shared;
    std::size_t count = 0;
    std::array<std::size_t, kQuads> roomy;           // of those with room for so many quads, the newest
    std::array<std::size_t, kBlocksPerGroup> older;  // the one before it
    roomy.fill(none);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const auto quads = static_cast<std::size_t>(countBits(blocks[i].quads) / 4);
        std::size_t room = quads;
        while (room < kQuads && roomy[room] == none) ++room;
        std::size_t to = count;
        if (room < kQuads) {
            to = std::exchange(roomy[room], older[roomy[room]]);
        } else {
            shared[count++].count = 0;
        }
        shared[to].parts[shared[to].count++] = static_cast<std::uint8_t>(i);
        if (room > quads) older[to] = std::exchange(roomy[room - quads], to);
    }
    const void* const program = draw.fragmentProgram.get();
    if (count == blocks.size()) {
        draw.programs->shadeBlocks(program, blocks, batch, corners);
    } else {
        draw.programs->shadeShared(program, {shared.data(), count}, blocks.data(), batch, corners);
    }
    return static_cast<unsigned>(count);
}

TriangleCorners cornersOf(const Draw& draw, const TriangleChunk& chunk, const Triangle& triangle, bool isFront)
{
    return {
        {componentsOf(draw.geometry, chunk, triangle.vertex[0]), componentsOf(draw.geometry, chunk, triangle.vertex[1]),
         componentsOf(draw.geometry, chunk, triangle.vertex[2])},
        isFront};
}

template <class State>
Counts shadeBlocksIn(const State& state, const Draw& draw, std::span<const CoveredBlock> blocks,
                     const SampleCoverage* samples, const TriangleBatch& batch, const TriangleChunk* const* chunkOf,
                     Tile& tile)
{
    Counts counts;
    constexpr bool severalSamples = State::severalSamples;
    const unsigned targets = draw.state.colorWrite ? state.outputs.targets & tile.colors() : 0;
    const bool runsProgram = !leavesOut::colors || targets != 0 || state.decides;
    const bool mayShare = leavesOut::emptyQuads && draw.programs->shadeShared != nullptr && !state.decides;
    const bool isLarge = static_cast<int>(blocks.size()) >= kBlocksOfLargeTriangle * countBits(batch.visible);
    const unsigned whole = isLarge ? kAllLanes : ~0u;
    const DepthBounds inTile = tile.wholeBounds();
    std::array<ShadedBlock, kBlocksPerGroup> group;
    std::array<MoreOutputs, State::hasOneTarget ? 0 : kBlocksPerGroup> more;
    if constexpr (!State::hasOneTarget) {
        for (std::size_t i = 0; i < kBlocksPerGroup; ++i) group[i].more = &more[i];
    }
    std::array<TriangleCorners, kLanes> corners;
    TriangleInTile<severalSamples> triangle;
    const CoveredBlock* const last = blocks.data() + blocks.size();
    for (const CoveredBlock* next = blocks.data(); next != last;) {
        const bool isNew = mayShare && tile.seen.draw != &draw;
        const std::size_t groupSize = state.decides ? 1 : isNew ? kFirstGroup : kBlocksPerGroup;
        ShadedBlock* free = group.data();
        ShadedBlock* const full = free + groupSize;
        while (next != last && free != full) {
            const CoveredBlock* const end = next + std::min(last - next, full - free);  // there is room for these
            for (; next != end; ++next) {
                if (next->triangle != triangle.lane) {
                    triangle.set(draw, batch, next->triangle);
                    if (isLarge && isBehind(state, triangle.weights, inTile)) {
                        next = hideTriangle(next, last, counts);
                        break;
                    }
                    corners[next->triangle] =
                        cornersOf(draw, *chunkOf[triangle.lane], *batch.triangle[triangle.lane], triangle.isFront);
                    for (const float* const components : corners[next->triangle].components)
                        __builtin_prefetch(components);  // the program asks for them soon
                }
                const SampleCoverage* of = severalSamples ? samples + (next - blocks.data()) : nullptr;
                if (testEarly(state, triangle, *next, of, whole, *free, tile, counts)) ++free;
            }
        }
        const std::span<ShadedBlock> shaded(group.data(), free);
        if (!runsProgram || shaded.empty()) continue;
        // A program that samples no texture is done before its blocks would be put together.
        const std::uint64_t sampled = isNew ? shading.fetches.samples() : 0;
        if (mayShare && !isNew && tile.seen.samples) {
            counts.blocks += shadeTogether(draw, shaded, batch, corners.data());
        } else {
            counts.blocks += static_cast<unsigned>(shaded.size());
            draw.programs->shadeBlocks(draw.fragmentProgram.get(), shaded, batch, corners.data());
        }
        if (isNew) tile.seen = {&draw, shading.fetches.samples() != sampled};
        if (state.decides) testLate(state, draw, triangle, group[0], tile, counts);
        const auto merge = [&](int target) {
            withFormat(tile.colorFormat(target), [&]<Format format>() {
                counts.invalid += mergeBlocks<format, severalSamples>(shaded, target, draw.state.blend, isLarge, tile);
            });
        };
        if constexpr (State::hasOneTarget) {
            if (targets != 0) merge(0);
        } else {
            for (unsigned rest = targets; rest != 0; rest &= rest - 1) merge(std::countr_zero(rest));
        }
    }
    counts.pixels += counts.whole * kLanes;
    counts.quadPixels += counts.whole * kLanes;
    if (!runsProgram) counts.colorless = counts.pixels;
    if (state.depthWrite) {
        updateBounds(state.depthTest, 0.0f, 1.0f, false, tile.wholeBounds());  // whatever was written
        if (isLarge) tile.refreshWholeBounds();
    }
    return counts;
}

// By itself, so that the usual ways below have the registers.
[[gnu::noinline, gnu::flatten]] Counts shadeSamples(const Draw& draw, std::span<const CoveredBlock> blocks,
                                                    const SampleCoverage* samples, const TriangleBatch& batch,
                                                    const TriangleChunk* const* chunkOf, Tile& tile)
{
    return shadeBlocksIn(AnyState<true>(draw, tile), draw, blocks, samples, batch, chunkOf, tile);
}

}  // namespace

[[gnu::flatten]] void shadeBlocks(const Draw& draw, std::span<const CoveredBlock> blocks, const SampleCoverage* samples,
                                  const TriangleBatch& batch, const TriangleChunk* const* chunkOf, Tile& tile,
                                  Statistics& statistics)
{
    Counts counts;
    const AnyState<false> state(draw, tile);
    if (tile.samples().isMultiple()) {
        counts = shadeSamples(draw, blocks, samples, batch, chunkOf, tile);
    } else if (state.isUsual() && state.readsEdges) {
        counts = shadeBlocksIn(UsualState<true>(), draw, blocks, nullptr, batch, chunkOf, tile);
    } else if (state.isUsual()) {
        counts = shadeBlocksIn(UsualState<false>(), draw, blocks, nullptr, batch, chunkOf, tile);
    } else {
        counts = shadeBlocksIn(state, draw, blocks, nullptr, batch, chunkOf, tile);
    }
    shading.activeLanes = kAllLanes;
    statistics.blocksShaded += counts.blocks;
    statistics.quadsShaded += counts.quadPixels / 4;
    statistics.pixelsShaded += counts.pixels;
    statistics.pixelsColorless += counts.colorless;
    statistics.stencilPassed += counts.stencilPassed;
    statistics.stencilFailed += counts.stencilTested - counts.stencilPassed;
    statistics.pixelsHidden += counts.hidden;
    statistics.invalidColors += counts.invalid;
}

}  // namespace relief::inline RELIEF_WIDTH

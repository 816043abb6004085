#include "relief/pipeline/instruments.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "relief/lanes/environment.h"
#include "relief/leave_out.h"
#include "relief/pipeline/frame_storage.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

Expected<const Draw*> drawOf(const Frame& frame, int draw)
{
    const std::vector<Draw>& draws = frame.internals().draws;
    if (draw < 0 || static_cast<std::size_t>(draw) >= draws.size()) {
        return fail("draw " + std::to_string(draw) + ": the frame has " + std::to_string(draws.size()) +
                    " draws, counted from 0");
    }
    return &draws[static_cast<std::size_t>(draw)];
}

// One block of a bin, which stands for the bin: the middle one of its first triangle.
struct Sample
{
    CoveredBlock block;
    const Triangle* triangle;
    const TriangleChunk* chunk;
};

std::vector<Sample> samplesOf(const Frame::Storage& s)
{
    std::vector<Sample> samples;
    std::vector<CoveredBlock> covered(s.coveredBlocks());
    for (std::size_t c = 0; c < s.usedChunks; ++c) {
        if (!s.chunks[c].isReady) continue;  // of a part before the last one
        for (int tile = 0; tile < s.grid.count(); ++tile) {
            const TriangleChunk& chunk = s.chunks[c];
            const std::uint32_t first = chunk.binStart[static_cast<std::size_t>(tile)];
            if (first == chunk.binStart[static_cast<std::size_t>(tile) + 1]) continue;
            const Triangle& triangle = chunk.triangles[chunk.sorted[first]];
            const Rectangle pixels = intersect(s.tilePixels(tile), s.draws[triangle.drawIndex()].geometry.bounds);
            const Triangle* const one[] = {&triangle};
            TriangleBatch batch;
            batch.set(one, pixels);
            const CoveredBlock* end = rasterise(batch, pixels, covered.data());
            if (end == covered.data()) continue;
            samples.push_back({covered[static_cast<std::size_t>(end - covered.data()) / 2], &triangle, &chunk});
        }
    }
    return samples;
}

float shadeSample(const Draw& draw, const Sample& sample, std::uint64_t times)
{
    TriangleBatch batch;
    batch.set({&sample.triangle, 1}, draw.geometry.bounds);
    TriangleEdges edges;
    edges.set(batch, 0);
    TriangleCorners corners;
    corners.isFront = isFront(draw.geometry, *sample.triangle);
    for (int k = 0; k < 3; ++k)
        corners.components[k] = componentsOf(draw.geometry, *sample.chunk, sample.triangle->vertex[k]);
    ShadedBlock block;
    block.covered = sample.block;
    block.quads = wholeQuads(sample.block.coverage);
    Float edge[3];
    edges.at(sample.block.x, sample.block.y, edge);
    for (int k = 0; k < 3; ++k) {
        edge[k].store(block.edge[k]);
        edge[k].store(block.centroid[k]);
    }
    std::array<ShadedBlock, 16> group;
    group.fill(block);
    std::array<MoreOutputs, 16> more;
    for (std::size_t i = 0; i < group.size(); ++i) group[i].more = &more[i];
    float sum = 0.0f;
    for (std::uint64_t rest = times; rest > 0;) {
        const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(rest, group.size()));
        draw.programs->shadeBlocks(draw.fragmentProgram.get(), {group.data(), n}, batch, &corners);
        for (const float(&channel)[kLanes] : group[n - 1].color) sum += channel[0];
        rest -= n;
    }
    shading.activeLanes = kAllLanes;
    return sum;
}

}  // namespace

Expected<int> componentCount(const Frame& frame, int draw)
{
    return drawOf(frame, draw).map([](const Draw* d) { return d->programs->components; });
}

Expected<std::string> outputSignature(const Frame& frame, int draw)
{
    return drawOf(frame, draw).map([](const Draw* d) { return signatureOf(d->programs->interpolators); });
}

Expected<bool> dependsOn(Frame& frame, int draw, int component)
{
    const Expected<int> components = componentCount(frame, draw);
    if (!components) return tl::unexpected(components.error());
    if (component < 0 || component >= *components) {
        return fail("component " + std::to_string(component) + ": draw " + std::to_string(draw) + " interpolates " +
                    std::to_string(*components) + ", counted from 0");
    }
    Frame::Storage& s = frame.internals();
    const Framebuffer before = s.target;
    s.run();
    const Framebuffer asItIs = s.target;
    s.target = before;
    s.poison = {draw, component};
    s.run();
    s.poison = {};
    const bool same = s.target.samePixels(asItIs);
    s.target = before;
    return !same;
}

Expected<DrawFacts> factsOf(const Frame& frame, int draw)
{
    const Framebuffer& target = frame.internals().target;
    return drawOf(frame, draw).map([&target](const Draw* d) {
        const RenderState& state = d->state;
        const Outputs& outputs = d->programs->outputs;
        DrawFacts facts = {d->mesh, 0, false, false, false, false};
        for (int n = 0; n < kMaxColors; ++n) {
            if (state.colorWrite && target.colorIndex(n) >= 0) facts.colors |= outputs.targets & 1u << n;
        }
        facts.depth = target.depthIndex() >= 0 && state.depthWrite;
        facts.testsStencil = target.stencilIndex() >= 0 && state.stencil.isUsed();
        const auto keeps = [](const StencilFace& face) {
            return face.fail == StencilOp::keep && face.depthFail == StencilOp::keep && face.pass == StencilOp::keep;
        };
        facts.stencil = facts.testsStencil && state.stencil.writeMask != 0 &&
                        !(keeps(state.stencil.front) && keeps(state.stencil.back));
        facts.program = !leavesOut::colors || facts.colors != 0 || decidesCoverage(*d);
        return facts;
    });
}

Expected<Statistics> statisticsOf(Frame& frame, int draw)
{
    const Expected<const Draw*> asked = drawOf(frame, draw);
    if (!asked) return tl::unexpected(asked.error());
    Frame::Storage& s = frame.internals();
    const Framebuffer before = s.target;
    std::vector<Draw> rest;
    const auto runFirst = [&](int count) {
        const auto from = s.draws.begin() + count;
        rest.insert(rest.begin(), std::make_move_iterator(from), std::make_move_iterator(s.draws.end()));
        s.draws.erase(from, s.draws.end());
        const Statistics statistics = s.run();
        s.target = before;
        return statistics;
    };
    Statistics its = runFirst(draw + 1);
    its -= runFirst(draw);
    s.draws.insert(s.draws.end(), std::make_move_iterator(rest.begin()), std::make_move_iterator(rest.end()));
    return its;
}

float shadeAlone(const Frame& frame, std::uint64_t blocks)
{
    const DefaultFloatingPoint environment;
    const Frame::Storage& s = frame.internals();
    const std::vector<Sample> samples = samplesOf(s);
    float sum = 0.0f;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        // Shares that add up to `blocks`.
        const std::uint64_t times = blocks * (i + 1) / samples.size() - blocks * i / samples.size();
        sum += shadeSample(s.draws[samples[i].triangle->drawIndex()], samples[i], times);
    }
    return sum;
}

}  // namespace relief::inline RELIEF_WIDTH

#include "relief/trace/pixel_trace.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "relief/bits.h"
#include "relief/lanes/environment.h"
#include "relief/pipeline/edge_function.h"
#include "relief/pipeline/exchange.h"
#include "relief/pipeline/line.h"
#include "relief/pipeline/output_merger.h"
#include "relief/pipeline/setup.h"
#include "relief/pipeline/views.h"

namespace relief::inline RELIEF_WIDTH::trace {

namespace {

using Words = std::array<std::uint32_t, 4>;

// The pixel that is followed, and where it lies in its tile.
struct Place
{
    int x, y;
    int blockX, blockY;  // of its block's upper left pixel
    int lane, quad;      // of its block; the quad's first lane

    Place(int atX, int atY)
        : x(atX),
          y(atY),
          blockX(atX & -kBlockWidth),
          blockY(atY & -kBlockHeight),
          lane(laneAt(atX - blockX, atY - blockY)),
          quad(lane & ~3)
    {
    }
    unsigned bit() const { return 1u << lane; }
    unsigned quadBits() const { return 0xfu << quad; }
};

// --- coverage ---

std::int64_t edgeAt(const EdgeFunction& edge, const Place& at, SamplePattern::Position sample = {0, 0})
{
    return edge.at(sample) + kSubpixels * (std::int64_t{edge.stepX} * at.x + std::int64_t{edge.stepY} * at.y);
}

bool isInside(const Triangle& t, const Place& at, SamplePattern::Position sample)
{
    for (int k = 0; k < 3; ++k) {
        if (edgeOf(t, k).coverage(at.x, at.y, sample) < 0) return false;
    }
    return true;
}

bool contains(const Rectangle& r, const Place& at)
{
    return at.x >= r.x0 && at.x < r.x1 && at.y >= r.y0 && at.y < r.y1;
}

// The samples that a triangle covers, a bit each.
unsigned coveredSamples(const Triangle& t, const Place& at, const Rectangle& bounds, const SamplePattern& samples)
{
    unsigned covered = 0;
    for (int s = 0; s < samples.count && contains(bounds, at); ++s) {
        if (isInside(t, at, samples.position[static_cast<std::size_t>(s)])) covered |= 1u << s;
    }
    return covered;
}

// From a pixel's centre to the nearest point of a triangle, in pixels.
double distanceTo(const Triangle& t, const Place& at)
{
    const double px = at.x * kSubpixels + kSubpixels / 2.0, py = at.y * kSubpixels + kSubpixels / 2.0;
    bool inside = true;
    double nearest = 1e30;
    for (int k = 0; k < 3; ++k) {
        inside = inside && edgeAt(edgeOf(t, k), at) >= 0;
        const int a = k, b = (k + 1) % 3;
        const double dx = t.x[b] - t.x[a], dy = t.y[b] - t.y[a], square = dx * dx + dy * dy;
        const double along = square > 0 ? ((px - t.x[a]) * dx + (py - t.y[a]) * dy) / square : 0.0;
        const double part = std::clamp(along, 0.0, 1.0);
        const double ex = px - (t.x[a] + part * dx), ey = py - (t.y[a] + part * dy);
        nearest = std::min(nearest, std::sqrt(ex * ex + ey * ey));
    }
    return inside ? 0.0 : nearest / kSubpixels;
}

// --- a pixel's words in a tile ---

struct PixelWords
{
    struct Sample
    {
        float depth = 0.0f;
        std::uint8_t stencil = 0;
        std::array<Words, kMaxColors> color{};

        bool operator==(const Sample&) const = default;
    };
    std::vector<Sample> samples;

    bool operator==(const PixelWords&) const = default;
};

PixelWords wordsOf(Tile& tile, const Place& at)
{
    PixelWords words;
    const int block = tile.blockAt(at.x, at.y);
    for (int s = 0; s < tile.samples().count; ++s) {
        const int sample = tile.sampleOf(block, s);
        PixelWords::Sample& its = words.samples.emplace_back();
        if (tile.hasDepth()) its.depth = tile.depth(sample)[at.lane];
        if (tile.hasStencil()) its.stencil = static_cast<std::uint8_t>(tile.stencil(sample)[at.lane]);
        for (unsigned rest = tile.colors(); rest != 0; rest &= rest - 1) {
            const int target = std::countr_zero(rest);
            withFormat(tile.colorFormat(target), [&]<Format format>() {
                const std::int32_t* const from = tile.color<format>(target, sample);
                for (int w = 0; w < wordsPerPixel(format); ++w)
                    its.color[static_cast<std::size_t>(target)][static_cast<std::size_t>(w)] =
                        static_cast<std::uint32_t>(from[w * kLanes + at.lane]);
            });
        }
    }
    return words;
}

template <Format format>
StoredColor<format> storedIn(const Words& words)
{
    StoredColor<format> stored;
    for (std::size_t w = 0; w < stored.words.size(); ++w) stored.words[w] = Int(static_cast<std::int32_t>(words[w]));
    return stored;
}

std::array<float, 4> linearOf(Format format, const Words& words)
{
    return withFormat(format, [&]<Format f>() {
        const float4 color = decodeColor<f>(storedIn<f>(words).words);
        return std::array<float, 4>{color.x[0], color.y[0], color.z[0], color.w[0]};
    });
}

// What the merger makes of a colour and the words that are there.
Words mergedWords(Format format, Blend blend, const std::array<float, 4>& color, const Words& before)
{
    return withFormat(format, [&]<Format f>() {
        const float4 source = {color[0], color[1], color[2], color[3]};
        alignas(Float) std::int32_t words[4 * kLanes] = {};
        const StoredColor<f> old = storedIn<f>(before);
        old.store(words, Mask(true), old);
        if (blend == Blend::off) {
            StoredColor<f>{encodeColor<f>(source)}.store(words, Mask(true), old);
        } else {
            blendInto<f>(words, blend, source, Mask(true));
        }
        Words merged{};
        for (std::size_t w = 0; w < old.words.size(); ++w)
            merged[w] = static_cast<std::uint32_t>(words[w * static_cast<std::size_t>(kLanes)]);
        return merged;
    });
}

// --- following ---

// A triangle that covers the pixel, as the frame came to it.
struct Followed
{
    std::uint32_t draw;
    Triangle triangle;
    FragmentTrace fragment;
    bool isTaken = false;
};

class PixelFollower final : public Frame::Storage::Follower
{
public:
    PixelFollower(Frame::Storage& its, int x, int y) : at(x, y), frame(its)
    {
        tile = y / its.grid.tileSize * its.grid.width + x / its.grid.tileSize;
    }

    // --- a triangle ---

    void begin(const Draw& draw, const Triangle& triangle, Tile& itsTile) override
    {
        current = nullptr;
        const Rectangle clip = intersect(frame.tilePixels(tile), draw.geometry.bounds);
        covered = coveredSamples(triangle, at, clip, itsTile.samples());
        if (covered == 0) return;
        before = wordsOf(itsTile, at);
        const Triangle* const only = &triangle;
        batch.set({&only, 1}, clip, itsTile.samples(), draw.state.depthBias);
        weights.set(batch, 0);
        followed.push_back({draw.geometry.drawIndex, triangle, {}, false});
        current = &followed.back().fragment;
        setWeights();
    }

    void shaded(const OwnProgram& own, const ShadedBlock& block, const TriangleBatch& its,
                const TriangleCorners* corners)
    {
        if (current == nullptr || block.covered.x != at.blockX || block.covered.y != at.blockY) return;
        if ((block.quads & at.bit()) == 0) return;  // it runs for other quads of the block
        current->ran = true;
        setInterpolators(*own.programs, block, corners[block.covered.triangle]);

        ShadedBlock copy = block;
        MoreOutputs more;
        copy.more = &more;
        copy.quads = at.quadBits();
        const FetchCounters fetches = std::exchange(shading.fetches, {});
        {
            Recorder recorder(at.lane);
            own.shadeBlocks({&copy, 1}, its, corners);
            current->events = std::move(recorder.events);
            current->textures = std::move(recorder.textures);
            expect(recorder.agrees, "a texture's sample");
        }
        shading.fetches = fetches;

        const Outputs& outputs = own.programs->outputs;
        const auto lane = static_cast<std::size_t>(at.lane);
        if (own.programs->discards) {
            current->discarded = (copy.discarded & at.bit()) != 0;
            expect(((copy.discarded ^ block.discarded) & at.bit()) == 0, "what it discards");
        }
        if ((outputs.targets & 1u) != 0) {
            const Float color[4] = {Float::load(copy.color[0]), Float::load(copy.color[1]), Float::load(copy.color[2]),
                                    Float::load(copy.color[3])};
            current->color = quadOf({ValueKind::number, 4, 1, color}, at.quad);
            // What is thrown away has no colour: this quad may be done before the frame's block was.
            for (const auto& c : {0, 1, 2, 3})
                expect(current->discarded || sameBits(copy.color[c][lane], block.color[c][lane]), "its colour");
        }
        if (outputs.depth) current->depthOut = more.depth[lane];
        if (outputs.coverage) current->coverageOut = static_cast<std::uint32_t>(more.coverage[lane]);
        if (outputs.more()) moreColors = more;
    }

    void end(const Draw& draw, const Triangle&, Tile& itsTile) override
    {
        if (current == nullptr) return;
        const PixelWords after = wordsOf(itsTile, at);
        PixelWords expected = before;
        const bool usesStencil = itsTile.hasStencil() && draw.state.stencil.isUsed();
        const Outputs& outputs = draw.programs->outputs;
        const unsigned targets = draw.state.colorWrite ? outputs.targets & itsTile.colors() : 0;
        for (int s = 0; s < itsTile.samples().count; ++s) testSample(draw, itsTile, s, usesStencil, expected);
        for (unsigned rest = targets; rest != 0; rest &= rest - 1)
            merge(draw, itsTile, std::countr_zero(rest), expected);
        expect(after == expected, "what is stored");
    }

    const Place at;
    std::vector<Followed> followed;
    std::string problem;  // what the trace and the frame disagree about

private:
    // A NaN is a NaN: its bits are the processor's.
    static bool sameBits(float a, float b)
    {
        return bitCast<std::uint32_t>(a) == bitCast<std::uint32_t>(b) || (std::isnan(a) && std::isnan(b));
    }
    void expect(bool isSo, const char* what)
    {
        if (!isSo && problem.empty()) problem = what;
    }

    void edgesAt(SamplePattern::Position sample, Float (&edge)[3]) const
    {
        TriangleEdges edges;
        edges.set(batch, 0, sample);
        edges.at(at.blockX, at.blockY, edge);
    }

    void setWeights()
    {
        Float edge[3];
        edgesAt({0, 0}, edge);
        const BlockWeights w = weights.of(edge, 0);
        const float linear[2] = {w.linear1[at.lane], w.linear2[at.lane]};
        const float perspective[2] = {w.perspective1[at.lane], w.perspective2[at.lane]};
        current->linear = {edge[0][at.lane] * batch.inverseArea[0], linear[0], linear[1]};
        current->perspective = {1.0f - perspective[0] - perspective[1], perspective[0], perspective[1]};
        current->clipW = weights.clipW(w)[at.lane];
    }

    void setInterpolators(const Programs& programs, const ShadedBlock& block, const TriangleCorners& corners)
    {
        Float edge[3];
        edgesAt({0, 0}, edge);
        const BlockWeights atCenter = weights.of(edge, block.covered.coverage);
        BlockWeights atCentroid = atCenter;
        const auto isCentroid = [](const Field& f) { return f.interpolation == Interpolation::centroid; };
        if (std::any_of(programs.interpolators.begin(), programs.interpolators.end(), isCentroid)) {
            for (int k = 0; k < 3; ++k) edge[k] = Float::load(block.centroid[k]);
            atCentroid = weights.of(edge, block.covered.coverage);
        }
        int slot = 0;
        for (const Field& field : programs.interpolators) {
            if (!isInterpolated(field.systemValue)) continue;
            InterpolatorTrace trace{semanticOf(field), field.interpolation, field.isInteger, {}, {}};
            Float here[4];
            for (int c = 0; c < field.components; ++c, ++slot) {
                const float* const* const from = corners.components;
                here[c] = interpolated(field.interpolation, from[0][slot], from[1][slot], from[2][slot],
                                       isCentroid(field) ? atCentroid : atCenter);
                for (std::size_t k = 0; k < 3; ++k)
                    trace.corners[k][static_cast<std::size_t>(c)] = bitCast<std::uint32_t>(from[k][slot]);
            }
            trace.here =
                quadOf({field.isInteger ? ValueKind::integer : ValueKind::number, field.components, 1, here}, at.quad);
            current->interpolators.push_back(std::move(trace));
        }
    }

    bool isKept(const Draw& draw, int sample, int count) const
    {
        if (!current->ran) return true;
        if (current->discarded) return false;
        if (current->coverageOut && (*current->coverageOut >> sample & 1u) == 0) return false;
        if (!draw.state.alphaToCoverage) return true;
        const float least = (static_cast<float>(sample) + 0.5f) / static_cast<float>(count);
        return current->color.number(at.lane & 3, 3) >= least;
    }

    // Stencil and depth of one sample, as draw.cpp works them out for a block.
    void testSample(const Draw& draw, Tile& itsTile, int s, bool usesStencil, PixelWords& expected)
    {
        using Verdict = SampleOutcome::Verdict;
        const SamplePattern::Position position = itsTile.samples().position[static_cast<std::size_t>(s)];
        const Triangle& triangle = followed.back().triangle;
        SampleOutcome outcome;
        for (int k = 0; k < 3; ++k)
            outcome.edges[static_cast<std::size_t>(k)] = edgeAt(edgeOf(triangle, k), at, position);
        PixelWords::Sample& words = expected.samples[static_cast<std::size_t>(s)];
        Float edge[3];
        edgesAt(position, edge);
        outcome.depth = weights.depth(edge[1], edge[2])[at.lane];
        if (current->depthOut) outcome.depth = saturate(Float(*current->depthOut))[0];
        outcome.depthBefore = words.depth;
        outcome.stencilBefore = words.stencil;

        const StencilFace& face = isFront(draw.geometry, triangle) ? draw.state.stencil.front : draw.state.stencil.back;
        const Int stencil(words.stencil);
        const Compare depthTest = itsTile.hasDepth() ? draw.state.depthTest : Compare::always;
        const bool passesStencil = !usesStencil || any(testStencil(draw.state.stencil, face, stencil));
        const bool passesDepth = any(compareBy(depthTest, Float(outcome.depth), Float(words.depth)));
        const bool kept = isKept(draw, s, itsTile.samples().count);
        const bool testsLate = draw.programs->outputs.depth || (usesStencil && decidesCoverage(draw));
        const bool isCovered = (covered >> s & 1u) != 0;
        if (!isCovered) {
            outcome.verdict = Verdict::missed;
        } else if (testsLate && !kept) {
            outcome.verdict = Verdict::discarded;
        } else if (!passesStencil) {
            outcome.verdict = Verdict::failsStencil;
        } else if (!passesDepth) {
            outcome.verdict = Verdict::failsDepth;
        } else {
            outcome.verdict = kept ? Verdict::drawn : Verdict::discarded;
        }
        const bool isDrawn = outcome.verdict == Verdict::drawn;
        if (usesStencil && isCovered && (kept || !testsLate)) {
            words.stencil = static_cast<std::uint8_t>(
                stencilAfter(draw.state.stencil, face, stencil, true, Mask(passesStencil), Mask(isDrawn))[0]);
        }
        if (isDrawn && itsTile.hasDepth() && draw.state.depthWrite) words.depth = outcome.depth;
        outcome.depthAfter = words.depth;
        outcome.stencilAfter = words.stencil;
        current->samples.push_back(outcome);
    }

    void merge(const Draw& draw, const Tile& itsTile, int target, PixelWords& expected)
    {
        TargetOutcome outcome;
        outcome.target = target;
        outcome.format = itsTile.colorFormat(target);
        const auto number = static_cast<std::size_t>(target);
        constexpr float largest = std::numeric_limits<float>::max();
        for (int c = 0; c < 4 && current->ran; ++c) {
            const float given = target == 0 ? current->color.number(at.lane & 3, c)
                                            : moreColors.color[number - 1][c][static_cast<std::size_t>(at.lane)];
            outcome.wasInvalid |= !std::isfinite(given);
            outcome.returned[static_cast<std::size_t>(c)] =
                std::isnan(given) ? 0.0f : std::clamp(given, -largest, largest);
        }
        for (std::size_t s = 0; s < expected.samples.size(); ++s) {
            TargetOutcome::Sample sample;
            Words& words = expected.samples[s].color[number];
            sample.wordsBefore = words;
            if (current->samples[s].verdict == SampleOutcome::Verdict::drawn)
                words = mergedWords(outcome.format, draw.state.blend, outcome.returned, words);
            sample.wordsAfter = words;
            sample.before = linearOf(outcome.format, sample.wordsBefore);
            sample.after = linearOf(outcome.format, sample.wordsAfter);
            outcome.samples.push_back(sample);
        }
        current->targets.push_back(std::move(outcome));
    }

    Frame::Storage& frame;
    FragmentTrace* current = nullptr;
    unsigned covered = 0;  // samples of the current triangle
    PixelWords before;
    TriangleBatch batch;
    TriangleWeights weights;
    MoreOutputs moreColors;
};

// What stands in the place of a draw's fragment program.
struct FollowedProgram
{
    OwnProgram own;
    PixelFollower* follower;
};

void shadeFollowed(const void* program, std::span<ShadedBlock> blocks, const TriangleBatch& batch,
                   const TriangleCorners* corners)
{
    const auto& its = *static_cast<const FollowedProgram*>(program);
    its.own.shadeBlocks(blocks, batch, corners);
    for (const ShadedBlock& block : blocks) its.follower->shaded(its.own, block, batch, corners);
}

// --- triangles ---

std::vector<std::string> planesOf(unsigned codes)
{
    static constexpr std::pair<unsigned, const char*> kPlanes[] = {{vertex_code::outsideNear, "the near plane"},
                                                                   {vertex_code::outsideFar, "the far plane"},
                                                                   {vertex_code::beyondGuardBand, "the guard band"},
                                                                   {vertex_code::smallW, "w = 0"},
                                                                   {vertex_code::beyondOwnPlane, "SV_ClipDistance"}};
    std::vector<std::string> names;
    for (const auto& [code, name] : kPlanes) {
        if ((codes & code) != 0) names.emplace_back(name);
    }
    return names;
}

// A primitive's pieces as the front end makes them, whichever way they face.
std::vector<Triangle> piecesOf(const DrawGeometry& draw, std::uint32_t primitive)
{
    DrawGeometry anyFacing = draw;
    anyFacing.cull = Cull::none;
    TriangleChunk chunk;
    Statistics statistics;
    (draw.primitive == Primitive::lines ? setUpLines : setUpTriangles)(anyFacing, primitive, 1, chunk, statistics);
    return chunk.triangles;
}

std::int64_t doubledAreaOf(const std::int32_t (&x)[3], const std::int32_t (&y)[3])
{
    return std::int64_t{x[1] - x[0]} * (y[2] - y[0]) - std::int64_t{x[2] - x[0]} * (y[1] - y[0]);
}

// The triangle of three vertices that need no clipping, turned clockwise as the front end does it.
Triangle triangleOf(const DrawGeometry& draw, const std::uint32_t* corners)
{
    Triangle t{};
    for (int k = 0; k < 3; ++k) {
        const ScreenVertex& v = draw.screen[corners[k]];
        t.x[k] = v.x;
        t.y[k] = v.y;
        t.z[k] = v.z;
        t.invW[k] = v.invW;
        t.vertex[k] = corners[k];
    }
    t.drawWord = draw.drawIndex;
    if (doubledAreaOf(t.x, t.y) < 0) {
        std::swap(t.x[1], t.x[2]);
        std::swap(t.y[1], t.y[2]);
        std::swap(t.z[1], t.z[2]);
        std::swap(t.invW[1], t.invW[2]);
        std::swap(t.vertex[1], t.vertex[2]);
        t.drawWord |= kWasCounterClockwise;
    }
    return t;
}

bool sameTriangle(const Triangle& a, const Triangle& b)
{
    return std::equal(a.x, a.x + 3, b.x) && std::equal(a.y, a.y + 3, b.y) && std::equal(a.z, a.z + 3, b.z) &&
           std::equal(a.invW, a.invW + 3, b.invW);
}

class PrimitiveScan
{
public:
    PrimitiveScan(const DrawGeometry& draw, const SamplePattern& pattern, PixelFollower& its)
        : g(draw), samples(pattern), follower(its), at(its.at)
    {
    }

    // Those that cover the pixel, or miss it by less than a pixel.
    std::vector<PrimitiveTrace> run()
    {
        std::vector<PrimitiveTrace> near;
        for (std::uint32_t p = 0; p < g.primitiveCount; ++p) {
            if (std::optional<PrimitiveTrace> trace = primitive(p)) near.push_back(std::move(*trace));
        }
        return near;
    }

private:
    std::optional<PrimitiveTrace> primitive(std::uint32_t p)
    {
        const std::uint32_t count = g.primitive == Primitive::lines ? 2 : 3;
        std::uint32_t room[3];
        const std::uint32_t* const corners = cornersOf(g, p, 1, count, room);
        unsigned some = 0, all = vertex_code::anyOutside;
        for (std::uint32_t k = 0; k < count; ++k) {
            if (corners[k] >= g.vertexCount) return {};
            some |= g.codes[corners[k]];
            all &= g.codes[corners[k]];
        }
        if ((some & (vertex_code::nan | vertex_code::infinite)) != 0 || all != 0) return {};
        const bool isClipped = (some & vertex_code::mustClip) != 0;
        if (!isClipped && isFar(corners, count)) return {};

        PrimitiveTrace trace;
        trace.number = p % g.primitivesPerInstance;
        trace.instance = p / g.primitivesPerInstance;
        for (std::uint32_t k = 0; k < count; ++k)
            trace.vertices[k] = corners[k] % g.verticesPerInstance + g.firstVertex;
        if (isClipped) trace.clippedBy = planesOf(some);
        const bool isWhole = !isClipped && g.primitive == Primitive::triangles;
        bool isNear = false;
        for (const Triangle& t : isWhole ? std::vector{triangleOf(g, corners)} : piecesOf(g, p))
            isNear |= piece(t, trace);
        if (!isNear) return {};
        return trace;
    }

    bool isFar(const std::uint32_t* corners, std::uint32_t count) const
    {
        const std::int32_t margin = (1 + g.lineWidth) * kSubpixels;
        const std::int32_t px = at.x * kSubpixels + kSubpixels / 2, py = at.y * kSubpixels + kSubpixels / 2;
        std::int32_t low[2] = {INT32_MAX, INT32_MAX}, high[2] = {INT32_MIN, INT32_MIN};
        for (std::uint32_t k = 0; k < count; ++k) {
            const ScreenVertex& v = g.screen[corners[k]];
            const std::int32_t position[2] = {v.x, v.y};
            for (int axis = 0; axis < 2; ++axis) {
                low[axis] = std::min(low[axis], position[axis]);
                high[axis] = std::max(high[axis], position[axis]);
            }
        }
        return px < low[0] - margin || px > high[0] + margin || py < low[1] - margin || py > high[1] + margin;
    }

    // Adds a piece; returns whether it is near.
    bool piece(const Triangle& t, PrimitiveTrace& trace)
    {
        PieceTrace its;
        std::copy(t.x, t.x + 3, its.x.begin());
        std::copy(t.y, t.y + 3, its.y.begin());
        std::copy(t.z, t.z + 3, its.z.begin());
        std::copy(t.invW, t.invW + 3, its.invW.begin());
        its.doubledArea = doubledAreaOf(t.x, t.y);
        its.wasTurned = (t.drawWord & kWasCounterClockwise) != 0;
        for (int k = 0; k < 3; ++k) {
            const EdgeFunction edge = edgeOf(t, k);
            its.edges[static_cast<std::size_t>(k)] = {edgeAt(edge, at), edge.isTopLeft(),
                                                      edge.coverage(at.x, at.y) >= 0};
        }
        its.distance = distanceTo(t, at);
        const bool facesAway = its.doubledArea == 0 || (g.primitive == Primitive::triangles && g.cull != Cull::none &&
                                                        its.wasTurned == (g.cull == Cull::back));
        const Rectangle pixels = sampleBounds(t, g.bounds, g.sampleReach);
        using Verdict = PrimitiveTrace::Verdict;
        const bool covers = !facesAway && coveredSamples(t, at, g.bounds, samples) != 0;
        if (covers) {
            trace.verdict = Verdict::covers;
            take(t, its);
        } else if (trace.verdict != Verdict::covers) {
            trace.verdict = facesAway                                          ? Verdict::facesAway
                            : pixels.x0 >= pixels.x1 || pixels.y0 >= pixels.y1 ? Verdict::hasNoSample
                                                                               : Verdict::misses;
        }
        const bool isNear = covers || its.distance < 1.0;
        trace.pieces.push_back(std::move(its));
        return isNear;
    }

    // What the frame did with it.
    void take(const Triangle& t, PieceTrace& its)
    {
        for (Followed& followed : follower.followed) {
            if (followed.isTaken || followed.draw != g.drawIndex || !sameTriangle(followed.triangle, t)) continue;
            followed.isTaken = true;
            its.fragment = std::move(followed.fragment);
            return;
        }
        if (follower.problem.empty()) follower.problem = "a triangle that covers it";
    }

    const DrawGeometry& g;
    const SamplePattern& samples;
    PixelFollower& follower;
    const Place& at;
};

std::vector<DrawTrace> drawsOf(Frame::Storage& frame, PixelFollower& follower)
{
    std::vector<DrawTrace> draws;
    for (const Draw& draw : frame.draws) {
        DrawTrace& trace = draws.emplace_back();
        trace.number = static_cast<int>(draw.geometry.drawIndex);
        trace.mesh = draw.mesh;
        trace.state = draw.state;
        trace.primitiveCount = draw.geometry.primitiveCount;
        trace.isOutside = draw.geometry.primitiveCount == 0 || !contains(draw.geometry.bounds, follower.at);
        if (!trace.isOutside) trace.primitives = PrimitiveScan(draw.geometry, frame.target.samples(), follower).run();
    }
    for (const Followed& followed : follower.followed) {
        if (!followed.isTaken && follower.problem.empty()) follower.problem = "which triangles cover it";
    }
    return draws;
}

}  // namespace

Expected<PixelTrace> tracePixel(Frame& frame, int x, int y)
{
    Frame::Storage& storage = frame.internals();
    Framebuffer& target = storage.target;
    if (x < 0 || y < 0 || x >= target.width() || y >= target.height()) {
        return fail("there is no pixel " + std::to_string(x) + "," + std::to_string(y) + "; the picture is " +
                    std::to_string(target.width()) + "x" + std::to_string(target.height()) +
                    ", its upper left pixel 0,0");
    }
    const DefaultFloatingPoint environment;  // the tile is drawn on this thread
    storage.prepare();
    PixelFollower follower(storage, x, y);
    {
        const ExchangedPrograms<FollowedProgram> exchanged(
            storage,
            [&](const Draw&, const OwnProgram& own) {
                return FollowedProgram{own, &follower};
            },
            shadeFollowed);
        storage.follower = &follower;
        storage.run();
        storage.follower = nullptr;
    }

    PixelTrace trace;
    trace.x = x;
    trace.y = y;
    trace.width = target.width();
    trace.height = target.height();
    trace.sampleCount = target.samples().count;
    trace.tileSize = storage.tileSize;
    const Rectangle pixels = storage.tilePixels(follower.tile);
    trace.tileX = pixels.x0;
    trace.tileY = pixels.y0;
    trace.cleared = storage.clear.color;
    const int color = target.colorIndex();
    if (color >= 0 && !target.words(color).empty()) {
        trace.format = target.attachments()[static_cast<std::size_t>(color)].format;
        const auto count = static_cast<std::size_t>(wordsPerPixel(trace.format));
        const std::size_t pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(target.width()) + static_cast<std::size_t>(x);
        const std::span<const std::uint32_t> words = target.words(color).subspan(pixel * count, count);
        trace.storedWords.assign(words.begin(), words.end());
        for (std::size_t i = 0; i < 4; ++i) trace.stored[i] = static_cast<std::uint8_t>(words[0] >> (8 * i));
    }
    // The last triangle that took part left the words that are stored.
    if (!follower.followed.empty() && trace.sampleCount == 1 && !trace.storedWords.empty()) {
        for (const TargetOutcome& outcome : follower.followed.back().fragment.targets) {
            if (outcome.target != 0) continue;
            const Words& last = outcome.samples[0].wordsAfter;
            if (!std::equal(trace.storedWords.begin(), trace.storedWords.end(), last.begin()) &&
                follower.problem.empty())
                follower.problem = "what the picture has";
        }
    }
    trace.draws = drawsOf(storage, follower);
    if (!follower.problem.empty()) {
        return fail("the trace of pixel " + std::to_string(x) + "," + std::to_string(y) +
                    " is not what the frame did: they differ in " + follower.problem +
                    "; this is a defect of Relief, please report it");
    }
    return trace;
}

}  // namespace relief::inline RELIEF_WIDTH::trace

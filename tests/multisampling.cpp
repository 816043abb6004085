// Several samples a pixel: coverage is exact at each of them, and a multisampled picture is, bit for bit, the mean of
// the pictures that have one sample a pixel there.
#include <doctest/doctest.h>

#include "pipeline_fixture.h"
#include "relief/pipeline/edge_function.h"
#include "relief/pipeline/instruments.h"

using namespace fixture;

namespace {

// Hits of each sample of each pixel.
class SampleRaster
{
public:
    SampleRaster(int side, const SamplePattern& samplePattern)
        : size(side),
          pattern(samplePattern),
          counts(static_cast<std::size_t>(pattern.count), std::vector<int>(static_cast<std::size_t>(side * side))),
          blocks(static_cast<std::size_t>(side * side + 64)),
          samples(blocks.size())
    {
    }

    void add(const Corners& c)
    {
        const std::int64_t area = (std::int64_t{c[1].x} - c[0].x) * (std::int64_t{c[2].y} - c[0].y) -
                                  (std::int64_t{c[2].x} - c[0].x) * (std::int64_t{c[1].y} - c[0].y);
        if (area == 0) return;
        Triangle t = {};
        const std::size_t order[3] = {0, area < 0 ? 2u : 1u, area < 0 ? 1u : 2u};
        for (int k = 0; k < 3; ++k) {
            t.x[k] = c[order[k]].x;
            t.y[k] = c[order[k]].y;
        }
        const Triangle* const one[] = {&t};
        const Rectangle clip = {0, 0, size, size};
        TriangleBatch batch;
        batch.set(one, clip, pattern);
        const CoveredBlock* const end = rasterise(batch, clip, blocks.data(), samples.data());
        for (const CoveredBlock* b = blocks.data(); b != end; ++b)
            add(*b, samples[static_cast<std::size_t>(b - blocks.data())]);
    }

    // Whether each sample was hit as often as a centre in its place is.
    bool isExact(const std::vector<Corners>& triangles) const
    {
        for (std::size_t s = 0; s < counts.size(); ++s) {
            std::vector<int> expected(counts[s].size());
            for (const Corners& c : triangles) addExactCoverage(moved(c, pattern.position[s]), size, size, expected);
            if (counts[s] != expected) return false;
        }
        return true;
    }

    int size;
    const SamplePattern& pattern;
    std::vector<std::vector<int>> counts;
    int broken = 0;

private:
    void add(const CoveredBlock& block, const SampleCoverage& covered)
    {
        unsigned any = 0;
        for (std::size_t s = 0; s < counts.size(); ++s) {
            any |= covered[s];
            for (int lane = 0; lane < kLanes; ++lane) {
                if ((covered[s] >> lane & 1u) == 0) continue;
                const int x = block.x + laneX(lane), y = block.y + laneY(lane);
                if (x >= size || y >= size) {
                    ++broken;
                } else {
                    ++counts[s][static_cast<std::size_t>(y * size + x)];
                }
            }
        }
        broken += any == 0 || any != block.coverage;
    }

    std::vector<CoveredBlock> blocks;
    std::vector<SampleCoverage> samples;
};

constexpr RenderState kUsual = {Compare::less, true, true, Cull::none, Blend::off};

// The fixture's programs with the value interpolated in another way.
template <class Field>
struct Varying
{
    SV_POSITION position;
    Field value;
};
template <class Field>
struct VaryingFromPixels : FromPixels
{
    using FromPixels::FromPixels;
    Varying<Field> operator()(const TestVertexData& v) const
    {
        const Interpolated i = FromPixels::operator()(v);
        return {i.position, i.value};
    }
};
template <class Field>
struct VaryingValue
{
    float4 operator()(const Varying<Field>& i) const { return i.value; }
};
using Flat = nointerpolation<TEXCOORD<0, float4>>;
using Centroid = centroid<TEXCOORD<0, float4>>;

Framebuffer multisampled(int width, int height, int samples, Format format = Format::rgba32f,
                         Store depth = Store::discard)
{
    Expected<Framebuffer> target = Framebuffer::create(width, height, format, depth, samples);
    REQUIRE(target.has_value());
    return std::move(*target);
}

Mesh randomMesh(Random& random, int triangles, int width, int height)
{
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const Corners c = randomTriangle(random, width, height, 2000);
        const glm::vec4 color = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
        TestVertex corner[3];
        for (std::size_t k = 0; k < 3; ++k) corner[k] = {pixelPosition(c[k], random.real(0, 1)), color};
        addTriangle(mesh, corner[0], corner[1], corner[2]);
    }
    return mesh;
}

// Without a clear in between, several draws after each other; the vertices moved by (x, y) sub-pixels.
Framebuffer drawMoved(const Mesh& mesh, int width, int height, int samples, SamplePattern::Position by,
                      const RenderState& state, const FrameOptions& options = {1, 32})
{
    Framebuffer target = multisampled(width, height, samples, Format::rgba32f, Store::keep);
    Mesh copy = mesh;
    for (glm::vec3& p : copy.positions) {
        p.x -= static_cast<float>(by.x) / 256.0f;
        p.y -= static_cast<float>(by.y) / 256.0f;
    }
    Frame frame(target, options);
    const Viewport viewport = exactViewport(width, height);
    frame.clear({0.25f, 0.5f, 0.75f, 1.0f}, state.depthTest == Compare::greater ? 0.0f : 1.0f);
    frame.setViewport(viewport);
    REQUIRE(frame.draw(copy, VaryingFromPixels<Flat>(viewport), VaryingValue<Flat>{}, state));
    checkInvariants(target, frame.run());
    return target;
}

}  // namespace

TEST_CASE("multisampling: the patterns are Direct3D's (A-12)")
{
    CHECK(samplePattern(3) == nullptr);
    CHECK(samplePattern(16) == nullptr);
    const SamplePattern& four = *samplePattern(4);
    CHECK(four.reach == 96);
    CHECK((four.position[0].x == -32 && four.position[0].y == -96));  // (0.375, 0.125) of the pixel
    const SamplePattern& eight = *samplePattern(8);
    CHECK((128 + eight.position[7].x == 240 && 128 + eight.position[7].y == 16));  // (0.9375, 0.0625)
    for (const SamplePattern& pattern : kSamplePatterns) {
        int x = 0, y = 0;
        for (const SamplePattern::Position& p : pattern.position) {
            x += p.x;
            y += p.y;
        }
        CHECK((x == 0 && y == 0));
    }
    const Expected<Framebuffer> three = Framebuffer::create(4, 4, Format::rgba8, Store::discard, 3);
    REQUIRE(!three.has_value());
    CHECK(three.error().message == "a target with 3 samples a pixel is not possible: choose 1, 2, 4 or 8");
}

TEST_CASE("multisampling: coverage of 100000 random triangles equals exact arithmetic at every sample")
{
    Random random(51);
    int wrong = 0, broken = 0;
    for (int trial = 0; trial < trials(10000); ++trial) {
        const SamplePattern& pattern = kSamplePatterns[1 + trial % 3];
        SampleRaster raster(trial % 50 == 0 ? 130 : 34, pattern);
        std::vector<Corners> triangles;
        for (int i = 0; i < 10; ++i) {
            triangles.push_back(randomTriangle(random, raster.size, raster.size, kGuardBand));
            raster.add(triangles.back());
        }
        wrong += !raster.isExact(triangles);
        broken += raster.broken;
    }
    measured("groups of ten triangles with a wrong sample", wrong, 0);
    CHECK(broken == 0);
}

TEST_CASE("multisampling: a shared edge is hit once per sample (S-316)")
{
    Random random(52);
    int wrong = 0;
    for (int trial = 0; trial < trials(3000); ++trial) {
        const int side = 34, n = random.between(2, 12);
        SampleRaster raster(side, kSamplePatterns[1 + trial % 3]);
        const Grid grid(n, side, [&](Point p, int cell) { return jitter(random, p, cell); });
        grid.triangulate([&] { return random.chance(2); }, [&](const Corners& c) { raster.add(c); });
        wrong += raster.broken;
        for (const std::vector<int>& hits : raster.counts)
            wrong += std::any_of(hits.begin(), hits.end(), [](int number) { return number != 1; });
    }
    measured("samples not covered once", wrong, 0);
}

TEST_CASE("multisampling: a picture is the mean of those with one sample in each place, bit for bit")
{
    Random random(53);
    for (const RenderState& state : {kUsual, RenderState{Compare::lessEqual, true, true, Cull::back, Blend::off},
                                     RenderState{Compare::greater, true, true, Cull::none, Blend::off},
                                     RenderState{Compare::always, false, true, Cull::none, Blend::additive},
                                     RenderState{Compare::less, false, true, Cull::none, Blend::alpha}}) {
        for (const SamplePattern& pattern : kSamplePatterns) {
            const int width = random.between(20, 90), height = random.between(20, 90);
            const Mesh mesh = randomMesh(random, 200, width, height);
            const Framebuffer together = drawMoved(mesh, width, height, pattern.count, {0, 0}, state);
            std::vector<glm::vec4> mean(together.color32f().size(), glm::vec4(0.0f)), first;
            std::vector<bool> areEqual(mean.size(), true);
            for (int s = 0; s < pattern.count; ++s) {
                const Framebuffer alone =
                    drawMoved(mesh, width, height, 1, pattern.position[static_cast<std::size_t>(s)], state);
                if (s == 0) first.assign(alone.color32f().begin(), alone.color32f().end());
                for (std::size_t i = 0; i < mean.size(); ++i) {
                    mean[i] += alone.color32f()[i] * (1.0f / static_cast<float>(pattern.count));
                    areEqual[i] = areEqual[i] && alone.color32f()[i] == first[i];
                }
                if (s == 0) CHECK(std::ranges::equal(alone.depth(), together.depth()));
            }
            int wrong = 0;
            for (std::size_t i = 0; i < mean.size(); ++i)
                wrong += (areEqual[i] ? first[i] : mean[i]) != together.color32f()[i];
            CAPTURE(pattern.count);
            measured("pixels not the mean", wrong, 0);
        }
    }
}

TEST_CASE("multisampling: the same bits with any tiles, threads and parts")
{
    Random random(54);
    const Mesh mesh = randomMesh(random, 3000, 150, 70);
    for (const int samples : {2, 4, 8}) {
        for (const RenderState& state : {kUsual, RenderState{Compare::less, true, true, Cull::none, Blend::alpha}}) {
            const Framebuffer reference = drawMoved(mesh, 150, 70, samples, {0, 0}, state);
            for (const FrameOptions& options : {FrameOptions{3, 16}, FrameOptions{2, 64}, FrameOptions{1, 128},
                                                FrameOptions{2, 16, 1000}, FrameOptions{1, 64, 1}}) {
                CHECK(sameBits(drawMoved(mesh, 150, 70, samples, {0, 0}, state, options), reference));
            }
        }
    }
}

TEST_CASE("multisampling: a picture that is not cleared stays what it is")
{
    Random random(55);
    const Mesh mesh = randomMesh(random, 50, 40, 40);
    for (const Format format : {Format::rgba8, Format::rgba8Srgb, Format::rgba16f, Format::r32f, Format::rgba32f}) {
        Framebuffer target = multisampled(40, 40, 4, format, Store::keep);
        drawPixels<kDepthTested>(target, mesh, Value{});
        const Framebuffer before = target;
        Frame frame(target, {1, 16});
        const Viewport viewport = exactViewport(40, 40);
        frame.setViewport(viewport);
        REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, {.depthTest = Compare::never}));
        frame.run();
        CHECK(sameBits(target, before));
    }
}

TEST_CASE("multisampling: the mean of equal samples is that sample, whatever a sum of them rounds to")
{
    Mesh corner;
    addTriangle(corner, Corners{{{0, 0}, {500, 0}, {0, 500}}}, glm::vec4(1.0f));
    for (const float color : {0.3f, 0x1p-149f, 0x1.1b1d6cp-126f, -0.0f, 1e30f}) {
        CAPTURE(color);
        for (const int samples : {2, 4, 8}) {
            for (const int tile : {16, 64}) {  // a tile that nothing touches is not averaged
                Framebuffer target = multisampled(64, 64, samples, Format::r32f, Store::keep);
                Frame frame(target, {1, tile});
                const Viewport viewport = exactViewport(64, 64);
                frame.clear(glm::vec4(color));
                frame.setViewport(viewport);
                REQUIRE(frame.draw(corner, FromPixels(viewport), Value{}, {.cull = Cull::none}));
                frame.run();
                for (const int at : {15, 40}) {
                    const float its = target.colorR32f()[static_cast<std::size_t>(at * 64 + at)];
                    CHECK(std::bit_cast<std::uint32_t>(its) == std::bit_cast<std::uint32_t>(color));
                }
            }
        }
    }
}

TEST_CASE("multisampling: samples are averaged in linear light")
{
    Framebuffer target = multisampled(1, 1, 4, Format::rgba8Srgb);
    Frame frame(target, {1, 16});
    const Viewport viewport = exactViewport(1, 1);
    frame.clear({0, 0, 0, 1});
    frame.setViewport(viewport);
    Mesh left;  // of the pixel's centre: two of the four samples
    addTriangle(left, Corners{{{128, -256}, {128, 512}, {-4096, 128}}}, glm::vec4(1.0f));
    REQUIRE(frame.draw(left, FromPixels(viewport), Value{}, {.cull = Cull::none}));
    frame.run();
    CHECK(target.color8()[0] == 0xffbcbcbcu);  // half of white is sRGB code 188
}

namespace {

template <class VertexProgram, class FragmentProgram>
Framebuffer drawValues(const Mesh& mesh, int samples)
{
    Framebuffer target = multisampled(32, 32, samples);
    Frame frame(target, {1, 16});
    const Viewport viewport = exactViewport(32, 32);
    frame.clear(glm::vec4(0.0f));
    frame.setViewport(viewport);
    REQUIRE(frame.draw(mesh, VertexProgram(viewport), FragmentProgram{}, kPaint));
    frame.run();
    return target;
}

float least(const Framebuffer& target)
{
    float low = 1.0f;
    for (const glm::vec4& c : target.color32f()) low = std::min(low, c.x);
    return low;
}

}  // namespace

TEST_CASE("multisampling: at the centroid no value leaves the triangle's range (S-410, A-13)")
{
    Random random(56);
    for (int trial = 0; trial < 50; ++trial) {
        Mesh mesh;
        const Corners c = randomTriangle(random, 32, 32, 100);
        TestVertex corner[3];
        const glm::vec4 values[3] = {glm::vec4(0.0f), glm::vec4(1.0f), glm::vec4(0.0f)};
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = {pixelPosition(c[k]), values[k]};
            corner[k].position.w = random.chance(2) ? 1.0f : 4.0f;
        }
        addTriangle(mesh, corner[0], corner[1], corner[2]);
        for (const int samples : {2, 4, 8}) {
            const Framebuffer target = drawValues<VaryingFromPixels<Centroid>, VaryingValue<Centroid>>(mesh, samples);
            CHECK(least(target) >= 0.0f);
        }
        CHECK(sameBits(drawValues<VaryingFromPixels<Centroid>, VaryingValue<Centroid>>(mesh, 1),
                       drawValues<FromPixels, Value>(mesh, 1)));
    }
    // At the centre it does: an edge from (0, 0) whose value falls off to the left.
    Mesh edge;
    addTriangle(edge, {{4.6f, 0, 0.5f, 1}, glm::vec4(0.0f)}, {{9.6f, 0, 0.5f, 1}, glm::vec4(1.0f)},
                {{4.6f, 20, 0.5f, 1}, glm::vec4(0.0f)});
    CHECK(least(drawValues<FromPixels, Value>(edge, 8)) < 0.0f);
    CHECK(least(drawValues<VaryingFromPixels<Centroid>, VaryingValue<Centroid>>(edge, 8)) >= 0.0f);
}

namespace {

// Throws every second column away.
struct Comb
{
    float4 operator()(const Interpolated& i, Discard& discard) const
    {
        discard(fmod(floor(i.position.x), 2.0f) == 0.0f);
        return i.value;
    }
};

}  // namespace

TEST_CASE("multisampling: a pixel that is thrown away keeps all of its samples, and their depths")
{
    Random random(57);
    for (const int samples : {1, 2, 4, 8}) {
        const Mesh mesh = randomMesh(random, 60, 32, 32);
        Framebuffer all = multisampled(32, 32, samples, Format::rgba32f, Store::keep), comb = all;
        drawPixels<kDepthTested>(all, mesh, Value{});
        drawPixels<kDepthTested>(comb, mesh, Comb{});
        int wrong = 0;
        for (std::size_t i = 0; i < all.depth().size(); ++i) {
            const bool thrown = i % 32 % 2 == 0;
            wrong += comb.color32f()[i] != (thrown ? glm::vec4(0.0f) : all.color32f()[i]);
            wrong += comb.depth()[i] != (thrown ? 1.0f : all.depth()[i]);
        }
        CAPTURE(samples);
        measured("pixels not as they should be", wrong, 0);
    }
}

TEST_CASE("multisampling: alpha to coverage draws alpha's share of the samples")
{
    for (const int samples : {1, 2, 4, 8}) {
        for (int step = 0; step <= 32; ++step) {
            const float alpha = static_cast<float>(step) / 32.0f;
            Mesh mesh;
            addTriangle(mesh, Corners{{{-100, -100}, {9000, -100}, {-100, 9000}}}, glm::vec4(1, 1, 1, alpha));
            Framebuffer target = multisampled(4, 4, samples, Format::rgba32f, Store::keep);
            Frame frame(target, {1, 16});
            const Viewport viewport = exactViewport(4, 4);
            frame.clear(glm::vec4(0.0f));
            frame.setViewport(viewport);
            REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, {.cull = Cull::none, .alphaToCoverage = true}));
            const Statistics statistics = frame.run();
            const float share = std::floor(alpha * static_cast<float>(samples) + 0.5f) / static_cast<float>(samples);
            CHECK(pixel(target, 2, 2).x == share);
            CHECK(target.depth()[0] == (share > 0.0f ? 0.5f : 1.0f));
            CHECK(statistics.pixelsShaded == 16);
        }
    }
}

TEST_CASE("multisampling: alpha to coverage leaves a program alone that gives no first colour")
{
    struct Second
    {
        SV_Target<1> color;
    };
    struct OnlySecond
    {
        Second operator()(const Interpolated&) const { return {float4(1.0f)}; }
    };
    Mesh mesh;
    addTriangle(mesh, Corners{{{-100, -100}, {9000, -100}, {-100, 9000}}}, glm::vec4(1, 1, 1, 0));
    Framebuffer target =
        *Framebuffer::create(8, 8, {{Format::rgba32f, Store::keep}, {Format::rgba32f, Store::keep}}, 4);
    Frame frame(target, {1, 16});
    const Viewport viewport = exactViewport(8, 8);
    frame.clear(glm::vec4(0.0f));
    frame.setViewport(viewport);
    const RenderState state = {.cull = Cull::none, .alphaToCoverage = true};
    REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, state));  // leaves an alpha of 0 behind
    REQUIRE(frame.draw(mesh, FromPixels(viewport), OnlySecond{}, state));
    frame.run();
    int drawn = 0;
    for (const std::uint32_t word : target.words(1)) drawn += word == std::bit_cast<std::uint32_t>(1.0f);
    CHECK(drawn == 64 * 4);
}

TEST_CASE("multisampling: a program alone gets the same values at centroids as at centres, where there is one sample")
{
    Mesh mesh;
    addTriangle(mesh, {{-40, -40, 0.5f, 1}, glm::vec4(0.1f)}, {{90, -40, 0.5f, 2}, glm::vec4(0.7f)},
                {{-40, 90, 0.5f, 4}, glm::vec4(0.4f)});
    const Viewport viewport = exactViewport(32, 32);
    const auto sum = [&](const auto& vertexProgram, const auto& fragmentProgram) {
        Framebuffer target = multisampled(32, 32, 1);
        Frame frame(target, {1, 16});
        frame.clear(glm::vec4(0.0f));
        frame.setViewport(viewport);
        REQUIRE(frame.draw(mesh, vertexProgram, fragmentProgram, kPaint));
        frame.run();
        return shadeAlone(frame, 100);
    };
    const float plain = sum(FromPixels(viewport), Value{});
    CHECK(plain > 0.0f);
    CHECK(sum(VaryingFromPixels<Centroid>(viewport), VaryingValue<Centroid>{}) == plain);
}

// Frames under stress: thrown away before they run, targets of another size and freed in between, sizes that cannot be
// had, and scenes of nothing but subnormal numbers (stability cases S-1006, S-1012, S-1013).
#include <chrono>
#include <memory>

#include "pipeline_fixture.h"
#include "relief/pipeline/frame_storage.h"
#include "relief/pipeline/instruments.h"

using namespace fixture;

namespace {

constexpr RenderState kOver = {Compare::lessEqual, true, true, Cull::none, Blend::alpha};

Mesh randomMesh(std::uint64_t seed, int triangles, int width, int height)
{
    Random random(seed);
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const Corners c = randomTriangle(random, width, height, 1000);
        const glm::vec4 value = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
        addTriangle(mesh, c, value, random.real(0, 1));
    }
    return mesh;
}

void record(Frame& frame, const Mesh& mesh, const Framebuffer& target)
{
    const Viewport viewport = exactViewport(target.width(), target.height());
    frame.clear(glm::vec4(0.25f));
    frame.setViewport(viewport);
    frame.draw(mesh, FromPixels(viewport), Value{}, kOver);
}

}  // namespace

TEST_CASE("frame life: S-1006 a target that cannot be had is an error, and the next frame is the same as ever")
{
    const Mesh mesh = randomMesh(1006, 200, 90, 60);
    Framebuffer target = makeTarget(90, 60, Format::rgba32f, Store::keep);
    Frame frame(target, {3, 16});
    record(frame, mesh, target);
    frame.run();
    const std::uint64_t first = hashOf(target);
    int other = 0, accepted = 0;
    for (const auto& [width, height] :
         {std::pair{0, 10}, {10, 0}, {-1, 10}, {16385, 1}, {1, 16385}, {2147483647, 2147483647}}) {
        accepted += Framebuffer::create(width, height).has_value();
        frame.run();
        other += hashOf(target) != first;
    }
    measured("impossible targets made", accepted, 0);
    measured("other hashes", other, 0);
}

TEST_CASE("frame life: S-1013 frames thrown away and targets of other sizes in between leave no trace")
{
    const Mesh mesh = randomMesh(1013, 300, 120, 90);
    Framebuffer target = makeTarget(120, 90, Format::rgba8Srgb, Store::keep);
    Frame kept(target, {3, 32});
    record(kept, mesh, target);
    kept.run();
    const std::uint64_t first = hashOf(target);
    Random random(1013);
    int other = 0;
    for (int i = 0; i < trials(100); ++i) {
        // Another frame, larger or smaller, run or only recorded, gone with its target and its mesh.
        auto otherTarget = std::make_unique<Framebuffer>(makeTarget(random.between(1, 300), random.between(1, 200)));
        auto otherMesh = std::make_unique<Mesh>(randomMesh(random.next(), random.between(0, 50), 120, 90));
        auto otherFrame =
            std::make_unique<Frame>(*otherTarget, FrameOptions{random.between(1, 4), 16 << random.between(0, 3)});
        record(*otherFrame, *otherMesh, *otherTarget);
        if (random.chance(2)) otherFrame->run();
        if (random.chance(3)) {
            otherFrame->reset();
            otherMesh.reset();
            otherFrame->run();
        }
        otherFrame.reset();
        otherTarget.reset();
        if (random.chance(3)) kept.reset();
        kept.reset();
        record(kept, mesh, target);
        kept.run();
        other += hashOf(target) != first;
        // A second frame on the same target sees what the first one left.
        Frame second(target, {2, 64});
        second.run();
        other += hashOf(target) != first;
    }
    measured("other hashes", other, 0);
}

TEST_CASE("frame life: S-1012 a scene of subnormal numbers has the right bits, and takes as long as it takes")
{
    // The same triangles with attributes of 1 and of 1e-40; the program multiplies and adds them.
    struct Busy
    {
        float4 operator()(const Interpolated& i) const
        {
            float4 sum = i.value;
            for (int k = 0; k < 32; ++k) sum = sum * 0.5f + i.value * 0.5f;
            return sum;
        }
    };
    Framebuffer target = makeTarget(128, 128);
    const auto seconds = [&](float value) {
        Mesh mesh;
        for (int i = 0; i < 8; ++i)
            addTriangle(mesh, Corners{{{0, 0}, {256 * 256, 0}, {0, 256 * 256}}}, glm::vec4(value));
        double best = 1e30;
        for (int round = 0; round < 3; ++round) {
            const auto begin = std::chrono::steady_clock::now();
            checkInvariants(target, drawPixels<kPaint>(target, mesh, Busy{}));
            best = std::fmin(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
        return best;
    };
    const double ordinary = seconds(1.0f);
    CHECK(pixelsNotEqualTo(target, 1.0f) == 0);
    // 2^-135: halves of it and their sums are exact.
    const double subnormal = seconds(0x1p-135f);
    measured("pixels with other bits", pixelsNotEqualTo(target, 0x1p-135f), 0);
    stability::noted("times the ordinary scene's time", subnormal / ordinary);
    CHECK(subnormal < 10.0);  // seconds: it ends
}

TEST_CASE("frame life: a target of another format or size takes the place of the one that was recorded for")
{
    const Mesh mesh = randomMesh(12, 200, 90, 60);
    for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f}) {
        for (const auto& [width, height] : {std::pair{90, 60}, {200, 130}, {17, 5}}) {
            Framebuffer expected = makeTarget(width, height, format, Store::keep);
            Frame fresh(expected, {2, 16});
            const Viewport viewport = exactViewport(90, 60);
            const auto recordFor = [&](Frame& frame) {
                frame.clear(glm::vec4(0.25f));
                frame.setViewport(viewport);
                frame.setScissor({0, 0, 90, 60});
                REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, kOver).has_value());
            };
            recordFor(fresh);
            fresh.run();

            Framebuffer target = makeTarget(90, 60, Format::rgba8Srgb, Store::discard);
            Frame frame(target, {2, 16});
            recordFor(frame);
            frame.run();
            target = makeTarget(width, height, format, Store::keep);
            frame.run();
            CHECK(sameBits(target, expected));
        }
    }
}

TEST_CASE("frame life: a small target in between leaves no trace in a large one")
{
    const Mesh mesh = randomMesh(14, 200, 90, 60);
    for (const int smallWidth : {17, 1}) {  // of the second no draw's window has anything
        Framebuffer target = makeTarget(90, 60, Format::rgba32f, Store::keep);
        Frame frame(target, {2, 16});
        const Viewport viewport = exactViewport(90, 60);
        frame.clear(glm::vec4(0.25f));
        frame.setViewport(viewport);
        frame.setScissor({2, 0, 90, 60});
        REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, kOver).has_value());
        const Statistics first = frame.run();
        const Framebuffer expected = target;
        target = makeTarget(smallWidth, 5, Format::rgba32f, Store::keep);
        CHECK(frame.run().verticesShaded == (smallWidth > 2 ? first.verticesShaded : 0));
        target = makeTarget(90, 60, Format::rgba32f, Store::keep);
        CHECK(frame.run().verticesShaded == first.verticesShaded);
        CHECK(sameBits(target, expected));
    }
}

TEST_CASE("frame life: a frame with more triangles than it may keep runs in parts, with the same bits")
{
    const Mesh mesh = randomMesh(16, 3000, 90, 60);
    for (const Store depth : {Store::keep, Store::discard}) {
        for (const Format format : {Format::rgba8Srgb, Format::rgba32f}) {
            std::uint64_t first = 0;
            Statistics whole;
            for (const std::uint32_t limit : {kMaxBinned, 10000u, 1000u, 1u}) {
                for (const int threads : {1, 3}) {
                    CAPTURE(limit);
                    Framebuffer target = makeTarget(90, 60, format, depth);
                    Frame frame(target, {threads, 16, limit});
                    record(frame, mesh, target);
                    record(frame, mesh, target);  // a second draw
                    const Statistics statistics = frame.run();
                    if (first == 0) first = hashOf(target), whole = statistics;
                    CHECK(hashOf(target) == first);
                    CHECK(statistics.trianglesBinned == whole.trianglesBinned);
                    CHECK(statistics.pixelsShaded == whole.pixelsShaded);
                    CHECK(statistics.tilesTouched == whole.tilesTouched);
                    frame.run();
                    CHECK(hashOf(target) == first);
                }
            }
            CHECK(whole.trianglesBinned > 20000);
        }
    }
}

TEST_CASE("frame life: the pairs of a triangle and a tile that a frame keeps have a bound, whatever it draws")
{
    Mesh mesh;
    const glm::vec4 one(1.0f);
    addTriangle(mesh, {{-1, -1, 0.5f, 1}, one}, {{-1, 3, 0.5f, 1}, one}, {{3, -1, 0.5f, 1}, one});
    constexpr std::uint32_t triangles = 30000, tiles = 6 * 4, limit = 1000;
    for (const std::uint32_t threads : {1u, 3u}) {
        Framebuffer target = makeTarget(96, 64);
        Frame frame(target, {static_cast<int>(threads), 16, limit});
        frame.clear(glm::vec4(0.0f));
        REQUIRE(frame.draw(mesh, FromClip{}, Value{}, kDepthTested, {.instances = triangles}).has_value());
        CHECK(frame.run().trianglesBinned == triangles * tiles);
        std::size_t kept = 0;
        for (const auto& chunk : frame.internals().chunks) kept += chunk.entries.capacity();
        // A thread notices after kPrimitivesPerCount triangles that there is no room left; a vector doubles.
        CHECK(kept <= 2 * (limit + threads * kPrimitivesPerCount * tiles));
        CHECK(shadeAlone(frame, 10) > 0.0f);  // of the last part, which is still there
    }
}

TEST_CASE("frame life: more threads than a machine gives, and targets beyond its memory, are no end of the program")
{
    Framebuffer target = makeTarget(20, 20);
    Frame frame(target, {200000, 16});
    frame.clear(glm::vec4(0.5f));
    frame.run();
    CHECK(pixelsNotEqualTo(target, 0.5f) == 0);
}

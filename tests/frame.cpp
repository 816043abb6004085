// Whole frames: coverage through all of the pipeline, viewports and scissors, and the promise that threads, tiles and
// repetition never show in the result.
#include "relief/pipeline/frame.h"

#include <algorithm>
#include <cfenv>
#include <chrono>
#include <limits>
#include <memory>

#include "pipeline_fixture.h"
#include "relief/trace/pixel_trace.h"

using namespace fixture;

namespace {

constexpr RenderState kOver = {Compare::always, false, true, Cull::none, Blend::alpha};
constexpr RenderState kOverTested = {Compare::less, true, true, Cull::none, Blend::alpha};

const int kTileSizes[] = {16, 32, 64, 128};
const int kThreadCounts[] = {1, 2, 3, 8};

// Something of everything: depth, blending, discard, derivatives, clipping, perspective, small and large triangles.
struct Wavy
{
    Float amount;
    float4 operator()(const Interpolated& i) const
    {
        const Float slope = abs(ddx(i.value.x)) + abs(ddy(i.value.y));
        const Float stripes = frac(i.value.x * 7.0f + i.position.x * 0.125f);
        return float4(i.value.x * amount, i.value.y + stripes, slope / (1.0f + slope),
                      0.25f + 0.5f * frac(i.position.w));
    }
};
struct WavyWithHoles
{
    float4 operator()(const Interpolated& i, Discard& discard) const
    {
        discard(frac(i.value.x * 5.0f + i.value.y * 3.0f) < 0.3f);
        return float4(i.value.y, i.value.x, i.position.z, 0.75f);
    }
};

struct Scene
{
    Mesh flat, spatial, holes;

    explicit Scene(std::uint64_t seed, int scale = 1)
    {
        Random random(seed);
        const auto value = [&] { return glm::vec4{random.real(0, 1), random.real(0, 1), 0, 1}; };
        for (int i = 0; i < 150 * scale; ++i) {
            const Corners c = randomTriangle(random, 150, 100, 3000);
            const auto vertex = [&](Point p) -> TestVertex {
                const float z = random.real(0, 1), w = random.real(0.5f, 4);
                return {pixelPosition(p, z, w), value()};
            };
            Mesh& mesh = random.chance(2) ? flat : holes;
            addTriangle(mesh, {vertex(c[0]), vertex(c[1]), vertex(c[2])});
        }
        for (int i = 0; i < 60 * scale; ++i) {
            const auto vertex = [&]() -> TestVertex {
                const float w = random.real(-0.5f, 2);
                return {{random.real(-3, 3), random.real(-3, 3), random.real(-0.2f, 1.2f), w}, value()};
            };
            addTriangle(spatial, {vertex(), vertex(), vertex()});
        }
    }

    // All meshes, several draws that change state in between.
    void record(Frame& frame, int width, int height) const
    {
        const Viewport viewport = exactViewport(width, height);
        frame.clear({0.1f, 0.2f, 0.3f, 1.0f});
        frame.setViewport(viewport);
        frame.draw(flat, FromPixels(viewport), Wavy{1.0f}, kDepthTested);
        frame.draw(holes, FromPixels(viewport), WavyWithHoles{}, kDepthTested);
        frame.setViewport({-10, 5, width + 7, height - 9});
        frame.draw(spatial, FromClip{}, Wavy{0.5f}, kDepthTested);
        frame.setScissor({11, 7, width - 3, height - 20});
        frame.draw(spatial, FromClip{}, Wavy{1.5f}, kOverTested);
        frame.draw(flat, FromClip{}, WavyWithHoles{}, kOver);
        frame.setViewport(viewport);
        frame.draw(holes, FromPixels(viewport), Wavy{0.125f}, kCount);
    }
};

bool sameCounters(const Statistics& a, const Statistics& b)
{
    return a.draws == b.draws && a.verticesShaded == b.verticesShaded && a.trianglesSubmitted == b.trianglesSubmitted &&
           a.culledFacing == b.culledFacing && a.culledNoSample == b.culledNoSample && a.outside == b.outside &&
           a.rasterised == b.rasterised && a.trianglesClipped == b.trianglesClipped && a.quadsShaded == b.quadsShaded &&
           a.pixelsShaded == b.pixelsShaded && a.pixelsColorless == b.pixelsColorless &&
           a.pixelsHidden == b.pixelsHidden && a.stencilPassed == b.stencilPassed &&
           a.stencilFailed == b.stencilFailed && a.invalidColors == b.invalidColors;
}

}  // namespace

TEST_CASE("frame: coverage of random triangles through the whole pipeline equals exact arithmetic (S-305, S-315)")
{
    Random random(80);
    const struct
    {
        int width, height;
    } sizes[] = {{64, 64}, {130, 70}, {33, 97}, {1, 64}, {64, 1}, {3, 3}};
    int wrong = 0;
    bool sums = true;
    for (int batch = 0; batch < trials(60); ++batch) {
        const auto [width, height] = sizes[batch % 6];
        std::vector<Corners> triangles;
        std::vector<int> expected(static_cast<std::size_t>(width * height));
        for (int i = 0; i < 500; ++i) {
            triangles.push_back(randomTriangle(random, width, height));
            addExactCoverage(triangles.back(), width, height, expected);
        }
        Framebuffer target = makeTarget(width, height);
        const Statistics statistics =
            drawPixels(target, meshOf(triangles), One{}, {1, kTileSizes[random.between(0, 3)]});
        wrong += wrongCounts(target, expected);
        sums = sums && addsUp(statistics) && statistics.trianglesClipped == 0;
        std::uint64_t pixels = 0;
        for (const int n : expected) pixels += static_cast<std::uint64_t>(n);
        wrong += statistics.pixelsShaded != pixels;
    }
    measured("pixels whose count is not exact", wrong, 0);
    CHECK(sums);
}

TEST_CASE("frame: DRTK#9, two triangles of 21 and 15 pixels (S-319)")
{
    const float low = 0.49993896484375f, high = 6.50006103515625f;
    const TestVertex a = {{0.5f, low, 0.5f, 1}}, b = {{0.5f, 6.5f, 0.5f, 1}}, c = {{high, low, 0.5f, 1}},
                     d = {{high, 6.5f, 0.5f, 1}};
    for (const bool swapped : {false, true}) {
        Framebuffer target = makeTarget(16, 16);
        Mesh first, second, both;
        swapped ? addTriangle(first, a, c, b) : addTriangle(first, a, b, c);
        swapped ? addTriangle(second, b, c, d) : addTriangle(second, b, d, c);
        addTriangle(both, a, b, c);
        addTriangle(both, b, c, d);
        CHECK(drawPixels(target, first).pixelsShaded == 21);
        CHECK(drawPixels(target, second).pixelsShaded == 15);
        CHECK(drawPixels(target, both).pixelsShaded == 36);
        for (const glm::vec4& pixel : target.color32f()) CHECK(pixel.x <= 1.0f);
    }
}

TEST_CASE("frame: culling by winding, front is clockwise on screen (S-309)")
{
    const Corners clockwise = {{{256, 256}, {3840, 512}, {512, 3840}}};
    const Corners counter = {clockwise[0], clockwise[2], clockwise[1]};
    const auto covered = [](const Corners& c, auto state) {
        Framebuffer target = makeTarget(16, 16);
        return drawPixels<decltype(state)::value>(target, meshOf({c})).pixelsShaded;
    };
    constexpr RenderState kNone = {Compare::always, false, true, Cull::none};
    constexpr RenderState kBack = {Compare::always, false, true, Cull::back};
    constexpr RenderState kFront = {Compare::always, false, true, Cull::front};
    const auto pixels = static_cast<std::uint64_t>(exactCount(clockwise, {0, 0, 16, 16}));
    CHECK(covered(clockwise, std::integral_constant<RenderState, kNone>{}) == pixels);
    CHECK(covered(counter, std::integral_constant<RenderState, kNone>{}) == pixels);
    CHECK(covered(clockwise, std::integral_constant<RenderState, kBack>{}) == pixels);
    CHECK(covered(counter, std::integral_constant<RenderState, kBack>{}) == 0);
    CHECK(covered(clockwise, std::integral_constant<RenderState, kFront>{}) == 0);
    CHECK(covered(counter, std::integral_constant<RenderState, kFront>{}) == pixels);
}

TEST_CASE("frame: a mirrored scene gives the mirrored picture, but for centres on edges (S-309)")
{
    Random random(81);
    constexpr int kSide = 64;
    int wrong = 0, compared = 0;
    for (int trial = 0; trial < trials(200); ++trial) {
        std::vector<Corners> triangles, upsideDown, leftRight;
        while (triangles.size() < 20) {
            const Corners c = randomTriangle(random, kSide, kSide, 500);
            const ExactTriangle exact(c);
            bool onEdge = false;
            for (int y = 0; y < kSide; ++y) {
                for (int x = 0; x < kSide; ++x) {
                    for (const ExactEdge& e : exact.edges) onEdge = onEdge || e.at({x * 256 + 128, y * 256 + 128}) == 0;
                }
            }
            if (onEdge) continue;
            triangles.push_back(c);
            Corners u = c, l = c;
            for (Point& p : u) p.y = kSide * 256 - p.y;
            for (Point& p : l) p.x = kSide * 256 - p.x;
            upsideDown.push_back(u);
            leftRight.push_back(l);
        }
        Framebuffer a = makeTarget(kSide, kSide), b = makeTarget(kSide, kSide), c = makeTarget(kSide, kSide);
        drawPixels(a, meshOf(triangles));
        drawPixels(b, meshOf(upsideDown));
        drawPixels(c, meshOf(leftRight));
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                wrong += pixel(a, x, y) != pixel(b, x, kSide - 1 - y) || pixel(a, x, y) != pixel(c, kSide - 1 - x, y);
                compared += pixel(a, x, y).x != 0.0f;
            }
        }
    }
    measured("pixels that differ from the mirrored", wrong, 0);
    CHECK(compared > 1000);
}

TEST_CASE("frame: zero areas and slivers leave no trace (S-303, S-304)")
{
    Framebuffer target = makeTarget(16, 16);
    Mesh mesh = meshOf({{{{256, 256}, {1280, 1280}, {3072, 3072}}}, {{{896, 896}, {896, 896}, {896, 896}}}});
    // Area only before snapping.
    addTriangle(mesh, {{3.5f, 3.5f, 0.5f, 1}}, {{9.5f, 3.5f, 0.5f, 1}}, {{6.5f, 3.5005f, 0.5f, 1}});
    const Statistics statistics = drawPixels(target, mesh);
    CHECK(statistics.culledFacing == 3);
    measured("pixels drawn", pixelsNotEqualTo(target, 0.0f), 0);
    checkInvariants(target, statistics);

    // Half a 1/65536 px^2 around a centre, with values and w that differ as much as they can: finite.
    Mesh smallest;
    addTriangle(smallest, {pixelPosition({1920, 1920}, 0, 1), {0, 1e6f, 0, 1}},
                {pixelPosition({1921, 1920}, 1, 1e4f), {1, -1e6f, 0, 1}},
                {pixelPosition({1920, 1921}, 0.5f, 1e-4f), {1, 0, 1e6f, 1}});
    const Statistics one = drawPixels<kPaint>(target, smallest, Wavy{1.0f});
    CHECK(one.pixelsShaded == 1);
    measured("colours NaN or infinite", one.invalidColors, 0);
    checkInvariants(target, one);
}

TEST_CASE("frame: a million triangles of 0.3 px (S-306)")
{
    const int n = trials(707 * 707) < 707 * 707 ? 223 : 707;
    Mesh mesh;
    Random random(82);
    const int cell = 77;  // 0.3 px in 24.8
    const int side = n * cell / 256;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            Point p = {i * cell, j * cell};
            if (i > 0 && i < n) p.x += random.between(-15, 15);
            if (j > 0 && j < n) p.y += random.between(-15, 15);
            mesh.positions.emplace_back(pixelPosition(p));
        }
    }
    mesh.normals.assign(mesh.positions.size(), glm::vec3(1, 0, 0));
    mesh.tangents.assign(mesh.positions.size(), glm::vec4(1.0f));
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const auto at = [&](int x, int y) { return static_cast<std::uint32_t>((j + y) * (n + 1) + i + x); };
            const bool turn = random.chance(2);
            for (const std::uint32_t k : {at(0, 0), at(1, 0), turn ? at(1, 1) : at(0, 1)}) mesh.indices.push_back(k);
            for (const std::uint32_t k : {at(0, 1), turn ? at(0, 0) : at(1, 0), at(1, 1)}) mesh.indices.push_back(k);
        }
    }
    Framebuffer target = makeTarget(side, side);
    const Statistics statistics = drawPixels(target, mesh, One{}, {2, 64});
    CHECK(statistics.trianglesSubmitted == static_cast<std::uint64_t>(2 * n) * static_cast<std::uint64_t>(n));
    measured("pixels not covered once", pixelsNotEqualTo(target, 1.0f), 0);
    CHECK(statistics.pixelsShaded == static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side));
    checkInvariants(target, statistics);
}

TEST_CASE("frame: triangulations across tile borders, every pixel once (S-301, S-311, S-312)")
{
    Random random(83);
    int wrong = 0;
    for (int trial = 0; trial < trials(400); ++trial) {
        const int width = random.between(100, 200), height = random.between(60, 140), n = random.between(2, 16);
        std::vector<Corners> triangles;
        std::vector<Point> points;
        // Lines of points on x = 64 k and through centres x = 64 k - 1/2, and jittered ones.
        const int alignment = random.between(0, 2);
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                Point p = {i * width * 256 / n, j * height * 256 / n};
                const bool inX = i > 0 && i<n, inY = j> 0 && j < n;
                if (inX) p.x += random.between(-width * 50 / n, width * 50 / n);
                if (inY) p.y += random.between(-height * 50 / n, height * 50 / n);
                if (alignment > 0 && n < 4 && inX)
                    p.x = (p.x + 32 * 256) / (64 * 256) * (64 * 256) - (alignment - 1) * 128;
                if (alignment > 0 && n < 4 && inY)
                    p.y = (p.y + 32 * 256) / (64 * 256) * (64 * 256) - (alignment - 1) * 128;
                points.push_back(p);
            }
        }
        bool valid = true;  // points that were rounded together make no triangulation
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                const Point p = points[static_cast<std::size_t>(j * (n + 1) + i)];
                if (i < n) valid = valid && p.x < points[static_cast<std::size_t>(j * (n + 1) + i + 1)].x;
                if (j < n) valid = valid && p.y < points[static_cast<std::size_t>((j + 1) * (n + 1) + i)].y;
            }
        }
        if (!valid) continue;
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const auto at = [&](int x, int y) {
                    return points[static_cast<std::size_t>((j + y) * (n + 1) + i + x)];
                };
                // A diagonal that lies within the quad: one of the two does.
                const Point a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                const auto side = [](Point p, Point q, Point r) {
                    return (std::int64_t{q.x} - p.x) * (std::int64_t{r.y} - p.y) -
                           (std::int64_t{q.y} - p.y) * (std::int64_t{r.x} - p.x);
                };
                const bool first = side(a, c, b) < 0 && side(a, c, d) > 0,
                           second = side(b, d, a) > 0 && side(b, d, c) < 0;
                if (first && (!second || random.chance(2))) {
                    triangles.push_back({a, b, c});
                    triangles.push_back({c, a, d});
                } else {
                    triangles.push_back({b, d, a});
                    triangles.push_back({b, c, d});
                }
            }
        }
        Framebuffer target = makeTarget(width, height);
        drawPixels(target, meshOf(triangles), One{}, {1, kTileSizes[trial % 4]});
        wrong += pixelsNotEqualTo(target, 1.0f) != 0;
    }
    measured("pixels not covered once", wrong, 0);
}

TEST_CASE("frame: fans around a pixel centre on a tile's border (S-302)")
{
    Random random(84);
    int wrong = 0;
    for (int n = 3; n <= 64; ++n) {
        const Point hub = {63 * 256 + 128 + 256 * random.between(0, 1), 63 * 256 + 128 + 256 * random.between(0, 1)};
        std::vector<Corners> fan;
        std::vector<Point> rim;
        for (int i = 0; i < n; ++i) {
            // Around a square, clockwise.
            const int s = (8 * i + random.between(0, 7)) * 40000 / (8 * n), side = s / 10000, t = s % 10000 - 5000;
            const Point offset[4] = {{t, -5000}, {5000, t}, {-t, 5000}, {-5000, -t}};
            rim.push_back({hub.x + offset[side].x, hub.y + offset[side].y});
        }
        for (std::size_t i = 0; i < rim.size(); ++i) fan.push_back({hub, rim[i], rim[(i + 1) % rim.size()]});
        if (n == 3)
            fan = {{hub, {hub.x - 5000, hub.y - 5000}, {hub.x + 5000, hub.y - 5000}},
                   {hub, {hub.x + 5000, hub.y - 5000}, {hub.x, hub.y + 5000}},
                   {hub, {hub.x, hub.y + 5000}, {hub.x - 5000, hub.y - 5000}}};
        Framebuffer target = makeTarget(128, 128);
        drawPixels(target, meshOf(fan), One{}, {1, 64});
        wrong += pixel(target, hub.x >> 8, hub.y >> 8) != glm::vec4(1.0f);
        for (const glm::vec4& c : target.color32f()) wrong += c.x > 1.0f;
    }
    measured("pixels not covered once", wrong, 0);
}

TEST_CASE("frame: one picture for every number of threads and every tile size (S-311, S-1001, S-1007)")
{
    for (const Format format : {Format::rgba32f, Format::rgba8Srgb, Format::rgba8}) {
        for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(trials(10, 20)); ++seed) {
            const Scene scene(seed);
            Framebuffer reference = makeTarget(150, 100, format, Store::keep);
            Statistics expected;
            for (const int tileSize : kTileSizes) {
                for (const int threads : kThreadCounts) {
                    Framebuffer target = makeTarget(150, 100, format, Store::keep);
                    Frame frame(target, {threads, tileSize});
                    scene.record(frame, 150, 100);
                    const Statistics statistics = frame.run();
                    checkInvariants(target, statistics);
                    if (tileSize == 16 && threads == 1) {
                        reference = target;
                        expected = statistics;
                    }
                    CHECK(sameBits(target, reference));
                    CHECK(sameCounters(statistics, expected));
                }
            }
        }
    }
}

TEST_CASE("frame: a hundred repetitions, one hash (S-1003)")
{
    const Scene scene(100, 3);
    Framebuffer target = makeTarget(150, 100, Format::rgba32f, Store::keep);
    Frame frame(target, {3, 16});
    scene.record(frame, 150, 100);
    frame.run();
    const std::uint64_t first = hashOf(target);
    int wrong = 0;
    for (int i = 0; i < trials(100); ++i) {
        frame.run();
        wrong += hashOf(target) != first;
    }
    measured("other hashes", wrong, 0);
}

TEST_CASE("frame: 1000 blended triangles, in order whatever the threads, and as one frame each (S-1002, S-320)")
{
    Random random(85);
    std::vector<Mesh> single(static_cast<std::size_t>(trials(1000, 3000)));
    Mesh all;
    for (Mesh& one : single) {
        const Corners c = randomTriangle(random, 90, 70, 300);
        const glm::vec4 color = {random.real(0, 1), random.real(0, 1), random.real(0, 1), 0.5f};
        addTriangle(one, c, color);
        addTriangle(all, c, color);
    }
    for (const Format format : {Format::rgba32f, Format::rgba8, Format::rgba8Srgb}) {
        Framebuffer together = makeTarget(90, 70, format), alone = makeTarget(90, 70, format);
        drawPixels<kOver>(together, all, Value{}, {1, 64});
        for (const int tileSize : {16, 128}) {
            Framebuffer threaded = makeTarget(90, 70, format);
            drawPixels<kOver>(threaded, all, Value{}, {3, tileSize});
            CHECK(sameBits(threaded, together));
        }
        // A frame for each, onto what is there.
        const Viewport viewport = exactViewport(90, 70);
        Frame frame(alone, {1, 32});
        frame.clear(glm::vec4(0.0f));
        frame.run();
        for (const Mesh& one : single) {
            frame.reset();
            frame.setViewport(viewport);
            frame.draw(one, FromPixels(viewport), Value{}, kOver);
            frame.run();
        }
        CHECK(sameBits(alone, together));
        // And a draw for each in one frame: the chunks of triangles span draws.
        Framebuffer draws = makeTarget(90, 70, format);
        Frame many(draws, {2, 32});
        many.clear(glm::vec4(0.0f));
        many.setViewport(viewport);
        for (const Mesh& one : single) many.draw(one, FromPixels(viewport), Value{}, kOver);
        const Statistics statistics = many.run();
        CHECK(statistics.draws == single.size());
        CHECK(sameBits(draws, together));
        checkInvariants(draws, statistics);
    }
}

TEST_CASE("frame: 10000 triangles on one pixel (S-320, S-1004)")
{
    const Corners c = {{{20 * 256, 20 * 256}, {21 * 256, 20 * 256}, {20 * 256, 21 * 256 + 200}}};
    const auto count = static_cast<std::size_t>(trials(10000, 10000));
    const Mesh mesh = meshOf(std::vector<Corners>(count, c));
    Framebuffer target = makeTarget(64, 64);
    const Statistics statistics = drawPixels(target, mesh, One{}, {3, 16});
    CHECK(pixel(target, 20, 20) == glm::vec4(static_cast<float>(count)));
    CHECK(statistics.trianglesBinned == count);
    checkInvariants(target, statistics);

    // As many over all tiles.
    const Mesh large = meshOf(std::vector<Corners>(count / 10, {{{-256, -256}, {64000, -256}, {-256, 64000}}}));
    drawPixels(target, large, One{}, {3, 16});
    CHECK(pixelsNotEqualTo(target, static_cast<float>(count / 10)) == 0);
}

TEST_CASE("frame: scissors empty, inverted, outside and of one pixel (S-317)")
{
    const Mesh mesh = meshOf({{{{-25600, -25600}, {256000, -25600}, {-25600, 256000}}}});
    struct Case
    {
        Rectangle scissor, expected;
    };
    const int big = std::numeric_limits<int>::max(), small = std::numeric_limits<int>::min();
    const Case cases[] = {{{0, 0, 0, 0}, {}},
                          {{10, 10, 5, 5}, {}},
                          {{10, 10, 20, 5}, {}},
                          {{100, 100, 200, 200}, {}},
                          {{-20, -20, 0, 0}, {}},
                          {{7, 9, 8, 10}, {7, 9, 8, 10}},
                          {{-5, -5, 3, 2}, {0, 0, 3, 2}},
                          {{30, 30, 1000, 1000}, {30, 30, 40, 35}},
                          {{small, small, big, big}, {0, 0, 40, 35}},
                          {{big, big, small, small}, {}},
                          {{1, 1, 39, 34}, {1, 1, 39, 34}},
                          {{17, 3, 18, 35}, {17, 3, 18, 35}}};
    for (const Case& c : cases) {
        for (const int tileSize : kTileSizes) {
            Framebuffer target = makeTarget(40, 35);
            Frame frame(target, {1, tileSize});
            frame.clear(glm::vec4(0.0f));
            frame.setViewport(exactViewport(40, 35));
            frame.setScissor(c.scissor);
            frame.draw(mesh, FromPixels(exactViewport(40, 35)), One{}, kCount);
            const Statistics statistics = frame.run();
            int wrong = 0;
            for (int y = 0; y < 35; ++y) {
                for (int x = 0; x < 40; ++x) {
                    const Rectangle& r = c.expected;
                    wrong += pixel(target, x, y).x != (x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1 ? 1.0f : 0.0f);
                }
            }
            CHECK(wrong == 0);
            checkInvariants(target, statistics);
        }
    }
}

TEST_CASE("frame: odd viewports, inside, outside and larger than the target (S-113)")
{
    Random random(86);
    Mesh mesh;
    std::vector<std::array<glm::vec4, 3>> triangles;
    for (int i = 0; i < 12; ++i) {
        std::array<glm::vec4, 3> t;
        for (glm::vec4& p : t) p = {random.real(-1.2f, 1.2f), random.real(-1.2f, 1.2f), 0.5f, 1};
        addTriangle(mesh, {t[0]}, {t[1]}, {t[2]});
        triangles.push_back(t);
    }
    const Viewport viewports[] = {{0, 0, 0, 0},           {0, 0, 1, 1},
                                  {5, 3, 1, 16384},       {3, 5, 16384, 1},
                                  {-7, -9, 33, 51},       {21, 13, 17, 29},
                                  {-100, -100, 50, 50},   {-8000, -8000, 16384, 16384},
                                  {60, 40, 500, 500},     {1, 1, -5, 10},
                                  {-16384, 0, 16384, 47}, {20, 20, 64, 64},
                                  {2147483647, 0, 5, 5},  {0, -2147483647, 2147483647, 2147483647}};
    const int width = 61, height = 47;
    for (const Viewport& v : viewports) {
        CAPTURE(v.x);
        CAPTURE(v.y);
        CAPTURE(v.width);
        CAPTURE(v.height);
        Framebuffer target = makeTarget(width, height);
        Frame frame(target, {1, 32});
        frame.clear(glm::vec4(0.0f));
        frame.setViewport(v);
        frame.draw(mesh, FromClip{}, One{}, kCount);
        const Statistics statistics = frame.run();
        checkInvariants(target, statistics);
        checkRunsAgain(frame, target);
        if (v.x > 20000 || v.y < -20000) continue;  // limited: no promise but this one
        // Against the double reference, off the edges; nothing outside of the viewport.
        int wrong = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                int least = 0, most = 0;
                const bool within = x >= v.x && x < v.x + v.width && y >= v.y && y < v.y + v.height;
                for (const auto& t : triangles) {
                    if (!within || v.width <= 0 || v.height <= 0) break;
                    const double margin = HomogeneousTriangle(t[0], t[1], t[2], v).margin(x + 0.5, y + 0.5);
                    least += margin > 1.0 / 256;
                    most += margin > -1.0 / 256;
                }
                const float hits = pixel(target, x, y).x;
                wrong += hits < static_cast<float>(least) || hits > static_cast<float>(most);
            }
        }
        measured("pixels wrong", wrong, 0);
    }
}

TEST_CASE("frame: the one column or row that is seen of the largest viewport at the last pixel (S-113)")
{
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, 0.5f, 1}}, {{-1, 1, 0.5f, 1}}, {{1, 1, 0.5f, 1}});
    addTriangle(mesh, {{-1, -1, 0.5f, 1}}, {{1, 1, 0.5f, 1}}, {{1, -1, 0.5f, 1}});
    for (const bool isColumn : {true, false}) {
        const int last = kMaxTargetSize - 1;
        Framebuffer target = isColumn ? makeTarget(kMaxTargetSize, 2) : makeTarget(2, kMaxTargetSize);
        Frame frame(target, {1, 64});
        frame.clear(glm::vec4(0.0f));
        frame.setViewport(isColumn ? Viewport{last, 0, kMaxTargetSize, 2} : Viewport{0, last, 2, kMaxTargetSize});
        frame.draw(mesh, FromClip{}, One{}, kCount);
        const Statistics statistics = frame.run();
        CHECK(statistics.pixelsShaded == 2);
        CHECK(statistics.trianglesClipped == 0);
        CHECK(pixel(target, isColumn ? last : 0, isColumn ? 0 : last) == glm::vec4(1.0f));
        CHECK(pixel(target, isColumn ? last : 1, isColumn ? 1 : last) == glm::vec4(1.0f));
    }
}

TEST_CASE("frame: a viewport inside a larger target gives the same pixels (S-113)")
{
    Random random(87);
    Mesh mesh;
    for (int i = 0; i < 100; ++i) {
        const auto vertex = [&]() -> TestVertex {
            const float w = random.real(0.5f, 2);
            return {{random.real(-1, 1) * w, random.real(-1, 1) * w, random.real(0, 1) * w, w},
                    {random.real(0, 1), random.real(0, 1), 0, 1}};
        };
        addTriangle(mesh, {vertex(), vertex(), vertex()});
    }
    Framebuffer exact = makeTarget(50, 30), larger = makeTarget(128, 128);
    for (const Viewport& v : {Viewport{0, 0, 50, 30}, Viewport{64, 64, 50, 30}, Viewport{16, 48, 50, 30}}) {
        drawClip<kDepthTested>(exact, mesh, Value{});
        Frame frame(larger, {1, 64});
        frame.clear(glm::vec4(0.0f));
        frame.setViewport(v);
        frame.draw(mesh, FromClip{}, Value{}, kDepthTested);
        frame.run();
        int wrong = 0, outside = 0, inside = 0;
        for (int y = 0; y < 128; ++y) {
            for (int x = 0; x < 128; ++x) {
                const bool within = x >= v.x && x < v.x + 50 && y >= v.y && y < v.y + 30;
                if (!within) {
                    outside += pixel(larger, x, y) != glm::vec4(0.0f);
                } else {
                    // With another origin the last bit of a float may snap a corner to the next 1/256.
                    const glm::vec4 a = pixel(larger, x, y), b = pixel(exact, x - v.x, y - v.y);
                    wrong += a != b;
                    ++inside;
                }
            }
        }
        CHECK(outside == 0);
        if (v.x == 0) CHECK(wrong == 0);
        CHECK(wrong <= inside / 20);
    }
}

TEST_CASE("frame: targets of one row, one column and 3x3 (S-318)")
{
    const int sizes[][2] = {{1, 1}, {1, 2}, {1, 200}, {200, 1}, {3, 3}, {2, 5}, {17, 15}, {129, 3}};
    for (const auto& size : sizes) {
        for (const Format format : {Format::rgba32f, Format::rgba8}) {
            for (const int tileSize : kTileSizes) {
                const Scene scene(7);
                Framebuffer target = makeTarget(size[0], size[1], format, Store::keep);
                Frame frame(target, {2, tileSize});
                scene.record(frame, size[0], size[1]);
                checkInvariants(target, frame.run());
                checkRunsAgain(frame, target);
            }
        }
        Framebuffer target = makeTarget(size[0], size[1]);
        drawPixels(target, meshOf({{{{-256, -256}, {256000, -256}, {-256, 256000}}}}));
        measured("pixels not covered once", pixelsNotEqualTo(target, 1.0f), 0);
    }
}

TEST_CASE("frame: no draws, no triangles, no pixels, more threads than tiles (S-112, S-1005)")
{
    const auto begin = std::chrono::steady_clock::now();
    Framebuffer target = makeTarget(9, 9);
    for (const int threads : {1, 2, 64}) {
        Frame frame(target, {threads, 64});
        CHECK(frame.run().tiles == 1);
        CHECK(pixelsNotEqualTo(target, 0.0f) == 0);
        frame.clear(glm::vec4(0.5f));
        const Statistics cleared = frame.run();
        CHECK(cleared.tilesTouched == 0);
        CHECK(pixelsNotEqualTo(target, 0.5f) == 0);

        const Mesh nothing;
        Mesh noTriangles = meshOf({{{{0, 0}, {1, 0}, {0, 1}}}});
        noTriangles.indices.resize(2);
        Mesh badIndices = meshOf({{{{0, 0}, {2560, 0}, {0, 2560}}}});
        badIndices.indices = {0, 1, 3, 0, 0, 1, 4294967295u, 1, 2, 0, 1, 2};
        frame.setViewport({0, 0, 16, 16});
        frame.draw(nothing, FromPixels({0, 0, 16, 16}), One{}, kPaint);
        frame.draw(noTriangles, FromPixels({0, 0, 16, 16}), One{}, kPaint);
        frame.draw(badIndices, FromPixels({0, 0, 16, 16}), One{}, kPaint);
        const Statistics statistics = frame.run();
        CHECK(statistics.draws == 3);
        CHECK(statistics.droppedIndex == 2);
        CHECK(statistics.culledFacing == 1);
        CHECK(statistics.rasterised == 1);
        CHECK(statistics.pixelsShaded == 45);
        checkInvariants(target, statistics);

        frame.reset();
        CHECK(frame.run().draws == 0);
        frame.clear(glm::vec4(0.0f));
        frame.run();
        CHECK(pixelsNotEqualTo(target, 0.0f) == 0);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    measured("seconds", seconds.count(), 1.0);
}

TEST_CASE("frame: without a clear a frame draws onto what is there, depth included if it is kept")
{
    const Mesh behind = [] {
        Mesh mesh;
        addTriangle(mesh, Corners{{{0, 0}, {32 * 256, 0}, {0, 32 * 256}}}, glm::vec4(1.0f), 0.75f);
        return mesh;
    }();
    const Mesh front = [] {
        Mesh mesh;
        addTriangle(mesh, Corners{{{0, 0}, {16 * 256, 0}, {0, 16 * 256}}}, glm::vec4(2.0f), 0.25f);
        return mesh;
    }();
    const Viewport viewport = {0, 0, 32, 32};
    for (const Format format : {Format::rgba32f, Format::rgba8, Format::rgba8Srgb}) {
        for (const Store storage : {Store::keep, Store::discard}) {
            // Near first, then far: with kept depth the far one is hidden.
            Framebuffer two = makeTarget(32, 32, format, storage), one = makeTarget(32, 32, format, storage);
            Frame first(two, {1, 16});
            first.clear({0.25f, 0.5f, 0.75f, 1.0f});
            first.setViewport(viewport);
            first.draw(front, FromPixels(viewport), Value{}, kDepthTested);
            first.run();
            Frame second(two, {2, 32});  // another tile size, another pool
            second.setViewport(viewport);
            second.draw(behind, FromPixels(viewport), Value{}, kDepthTested);
            checkInvariants(two, second.run());

            Frame both(one, {1, 64});
            both.clear({0.25f, 0.5f, 0.75f, 1.0f});
            both.setViewport(viewport);
            if (storage == Store::keep) {
                both.draw(front, FromPixels(viewport), Value{}, kDepthTested);
                both.draw(behind, FromPixels(viewport), Value{}, kDepthTested);
            } else {
                both.draw(front, FromPixels(viewport), Value{}, kPaint);
                both.draw(behind, FromPixels(viewport), Value{}, kPaint);
            }
            both.run();
            CHECK(sameBits(one, two));
        }
    }
}

TEST_CASE("frame: reset forgets the draws, the clear and its depth, the viewport and the scissor")
{
    const Viewport viewport = {0, 0, 16, 16};
    Mesh mesh;
    addTriangle(mesh, Corners{{{-256, -256}, {12800, -256}, {-256, 12800}}}, glm::vec4(1.0f), 0.5f);
    Framebuffer target = makeTarget(16, 16);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(3.0f), 0.0f);
    frame.setViewport({0, 0, 2, 2});
    frame.setScissor({0, 0, 1, 1});
    frame.draw(mesh, FromPixels(viewport), One{}, kPaint);
    frame.run();
    frame.reset();
    frame.draw(mesh, FromPixels(viewport), One{}, kDepthTested);
    const Statistics statistics = frame.run();
    CHECK(statistics.draws == 1);
    CHECK(statistics.pixelsShaded == 256);
    CHECK(pixelsNotEqualTo(target, 1.0f) == 0);
}

TEST_CASE("frame: reversed depth")
{
    constexpr RenderState kReversed = {Compare::greater, true, true, Cull::none, Blend::off};
    const Viewport viewport = {0, 0, 32, 32};
    Mesh far, near;
    addTriangle(far, Corners{{{0, 0}, {32 * 256, 0}, {0, 32 * 256}}}, glm::vec4(1.0f), 0.25f);
    addTriangle(near, Corners{{{0, 0}, {16 * 256, 0}, {0, 16 * 256}}}, glm::vec4(2.0f), 0.75f);
    for (const bool nearFirst : {false, true}) {
        Framebuffer target = makeTarget(32, 32, Format::rgba32f, Store::keep);
        Frame frame(target, {1, 16});
        frame.clear(glm::vec4(0.0f), 0.0f);
        frame.setViewport(viewport);
        frame.draw(nearFirst ? near : far, FromPixels(viewport), Value{}, kReversed);
        frame.draw(nearFirst ? far : near, FromPixels(viewport), Value{}, kReversed);
        const Statistics statistics = frame.run();
        checkInvariants(target, statistics);
        CHECK(pixel(target, 3, 3) == glm::vec4(2.0f));
        CHECK(pixel(target, 20, 3) == glm::vec4(1.0f));
        CHECK(pixel(target, 31, 31) == glm::vec4(0.0f));
        CHECK(target.depth()[3 * 32 + 3] == 0.75f);
        CHECK(target.depth()[31 * 32 + 31] == 0.0f);
        if (nearFirst) CHECK(statistics.pixelsHidden == 120);
    }
}

TEST_CASE("frame: the caller's rounding mode and flushing of subnormals change nothing (S-1008)")
{
    const Scene scene(42);
    Mesh tiny;
    addTriangle(tiny, Corners{{{0, 0}, {128 * 256, 0}, {0, 128 * 256}}}, glm::vec4(3e-39f, 1e-40f, 5e-39f, 1.0f));
    const Viewport viewport = exactViewport(150, 100);
    const auto record = [&](Frame& frame) {
        scene.record(frame, 150, 100);
        frame.draw(tiny, FromPixels(viewport), Value{}, kOver);
    };
    for (const Format format : {Format::rgba32f, Format::rgba8Srgb}) {
        Framebuffer expected = makeTarget(150, 100, format, Store::keep);
        {
            Frame frame(expected, {1, 64});
            record(frame);
            frame.run();
        }
        for (const int threads : {1, 3}) {
            for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
                Framebuffer target = makeTarget(150, 100, format, Store::keep);
                REQUIRE(std::fesetround(mode) == 0);
#if defined(__SSE2__)
                _mm_setcsr(_mm_getcsr() | 0x8040u);
#endif
                Frame frame(target, {threads, 64});
                record(frame);
                frame.run();
                const bool traced = trace::tracePixel(frame, 20, 20).has_value();  // draws a tile on this thread
                const int after = std::fegetround();
#if defined(__SSE2__)
                _mm_setcsr(0x1f80u);
#endif
                std::fesetround(FE_TONEAREST);
                CHECK(traced);
                CHECK(after == mode);
                CHECK(sameBits(target, expected));
            }
        }
    }
}

TEST_CASE("frame: the clear colour and depth, also when they are no numbers")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    Framebuffer target = makeTarget(40, 40, Format::rgba32f, Store::keep);
    const Mesh mesh = meshOf({{{{0, 0}, {2560, 0}, {0, 2560}}}});  // some tiles touched, some not
    for (const auto& [depth, cleared] :
         {std::pair{0.25f, 0.25f}, {2.0f, 1.0f}, {-0.5f, 0.0f}, {nan, 0.0f}, {infinity, 1.0f}, {-infinity, 0.0f}}) {
        Frame frame(target, {1, 16});
        frame.clear({nan, infinity, -infinity, 0.5f}, depth);
        frame.setViewport(exactViewport(40, 40));
        frame.draw(mesh, FromPixels(exactViewport(40, 40)), One{}, kDepthTested);
        checkInvariants(target, frame.run());
        const float largest = std::numeric_limits<float>::max();
        CHECK(pixel(target, 39, 39) == glm::vec4(0, largest, -largest, 0.5f));
        CHECK(pixel(target, 12, 12) == glm::vec4(0, largest, -largest, 0.5f));
        CHECK(target.depth()[39 * 40 + 39] == cleared);
        frame.clearDepth(depth);
        checkInvariants(target, frame.run());
        CHECK(target.depth()[39 * 40 + 39] == cleared);
    }
}

TEST_CASE("frame: options out of range are brought into it")
{
    const Mesh mesh = meshOf({{{{-256, -256}, {256000, -256}, {-256, 256000}}}});
    for (const int tileSize : {-5, 0, 1, 15, 16, 17, 100, 128, 1000, 2147483647}) {
        for (const int threads : {-1, 0, 1}) {
            Framebuffer target = makeTarget(40, 30);
            const Statistics statistics = drawPixels(target, mesh, One{}, {threads, tileSize});
            CHECK(pixelsNotEqualTo(target, 1.0f) == 0);
            checkInvariants(target, statistics);
        }
    }
}

TEST_CASE("frame: what is counted")
{
    Framebuffer target = makeTarget(64, 64);
    std::vector<Corners> triangles = {
        {{{0, 0}, {2560, 0}, {0, 2560}}},              // 45 pixels, in tile 0
        {{{0, 0}, {0, 2560}, {2560, 0}}},              // again, the other way round: hidden
        {{{-5000, 0}, {-3000, 0}, {-5000, 2000}}},     // outside
        {{{2569, 2569}, {2580, 2569}, {2569, 2580}}},  // between the centres
        {{{256, 256}, {512, 512}, {768, 768}}},        // no area
    };
    const Statistics s = drawPixels<kDepthTested>(target, meshOf(triangles), One{}, {1, 16});
    CHECK(s.draws == 1);
    CHECK(s.verticesShaded == 15);
    CHECK(s.trianglesSubmitted == 5);
    CHECK(s.rasterised == 2);
    CHECK(s.outside == 1);
    CHECK(s.culledNoSample == 1);
    CHECK(s.culledFacing == 1);
    CHECK(s.trianglesClipped == 0);
    CHECK(s.trianglesBinned == 2);
    CHECK(s.tiles == 16);
    CHECK(s.tilesTouched == 1);
    CHECK(s.pixelsShaded == 45);
    CHECK(s.pixelsHidden == 45);
    CHECK(s.quadsShaded == 15);  // quads with a pixel above the diagonal: 5 + 4 + 3 + 2 + 1
    CHECK(s.invalidColors == 0);
}

TEST_CASE("frame: the same bits in every build, on any processor (S-1009, S-1010, S-1011)")
{
    // One number for every compiler, optimisation level, instruction set and number of lanes. It changes only when the
    // arithmetic of the pipeline is changed on purpose.
    const Scene scene(2024, 2);
    std::uint64_t hash = 0;
    for (const Format format : {Format::rgba32f, Format::rgba8Srgb}) {
        Framebuffer target = makeTarget(150, 100, format, Store::keep);
        Frame frame(target, {2, 64});
        scene.record(frame, 150, 100);
        frame.run();
        const std::span<const std::uint32_t> color = target.words(0), depth = target.words(1);
        hash = hash * 31 + hashBytes(depth.data(), depth.size_bytes(), hashBytes(color.data(), color.size_bytes()));
    }
    CHECK(hash == 0xad0e5f6744e51deu);
}

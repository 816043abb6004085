// Lines against their own definition in exact integers, clipped lines against whole ones, and lines in a picture.
#include "relief/pipeline/line.h"

#include <cstdlib>
#include <limits>
#include <map>

#include "pipeline_fixture.h"

using namespace fixture;

namespace {

template <int width>
constexpr RenderState lineState(RenderState state)
{
    state.primitive = Primitive::lines;
    state.lineWidth = width;
    return state;
}

void addLine(Mesh& mesh, const TestVertex& a, const TestVertex& b)
{
    for (const TestVertex& v : {a, b}) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.emplace_back(v.position);
        mesh.normals.emplace_back(v.position.w, 0.0f, 0.0f);
        mesh.tangents.push_back(v.value);
    }
}

struct Segment
{
    Point a, b;
};

Mesh meshOf(const Segment& s)
{
    Mesh mesh;
    addLine(mesh, {pixelPosition(s.a)}, {pixelPosition(s.b)});
    return mesh;
}

// Where a pixel centre lies: strictly inside what the line sweeps, outside, or on its border, where the fill rule
// decides. In integers: everything is multiplied by twice the major extent.
enum class Place
{
    inside,
    border,
    outside
};

Place place(const Segment& s, int x, int y, int width)
{
    const std::int64_t px = x * 256 + 128, py = y * 256 + 128;
    const std::int64_t dx = std::int64_t{s.b.x} - s.a.x, dy = std::int64_t{s.b.y} - s.a.y;
    const bool xMajor = std::abs(dx) >= std::abs(dy);
    const std::int64_t along = xMajor ? px - s.a.x : py - s.a.y, extent = xMajor ? dx : dy;
    const std::int64_t across = xMajor ? py - s.a.y : px - s.a.x, rise = xMajor ? dy : dx;
    if (extent == 0) return Place::outside;
    const std::int64_t sign = extent < 0 ? -1 : 1;
    const std::int64_t part = along * sign, whole = extent * sign;
    const std::int64_t offset = std::abs(2 * (across * whole - rise * sign * along * sign * sign));
    const std::int64_t reach = whole * width * 256;
    if (part < 0 || part > whole || offset > reach) return Place::outside;
    return part == 0 || part == whole || offset == reach ? Place::border : Place::inside;
}

template <int width>
void checkAgainstDefinition(const Segment& s, Framebuffer& target)
{
    drawPixels<lineState<width>(kCount)>(target, meshOf(s));
    const bool xMajor = std::abs(s.b.x - s.a.x) >= std::abs(s.b.y - s.a.y);
    std::map<int, int> perStep;
    int wrong = 0, twice = 0;
    for (int y = 0; y < target.height(); ++y) {
        for (int x = 0; x < target.width(); ++x) {
            const float hits = target.color32f()[static_cast<std::size_t>(y * target.width() + x)].x;
            const Place expected = place(s, x, y, width);
            wrong += (expected == Place::inside && hits != 1.0f) || (expected == Place::outside && hits != 0.0f);
            twice += hits > 1.0f;
            perStep[xMajor ? x : y] += static_cast<int>(hits);
        }
    }
    CHECK(wrong == 0);
    CHECK(twice == 0);
    // Every column (row) between the ends has exactly the line's width, if the picture does not cut it off.
    const std::int32_t low = std::min(xMajor ? s.a.x : s.a.y, xMajor ? s.b.x : s.b.y);
    const std::int32_t high = std::max(xMajor ? s.a.x : s.a.y, xMajor ? s.b.x : s.b.y);
    for (const auto& [step, pixels] : perStep) {
        const int centre = step * 256 + 128;
        if (centre > low && centre < high) CHECK(pixels == width);
        if (centre < low || centre > high) CHECK(pixels == 0);
    }
}

}  // namespace

TEST_CASE("line: covers exactly what its definition says, and every column or row has its width")
{
    Random random(20);
    Framebuffer target = makeTarget(48, 40);
    for (int i = 0; i < trials(2000); ++i) {
        const int step = random.chance(4) ? 128 : 1;  // centres and borders hit exactly, too
        const auto point = [&] {
            const int x = random.between(3 * 256, 45 * 256) / step * step;
            return Point{x, random.between(3 * 256, 37 * 256) / step * step};
        };
        const Segment s = {point(), point()};
        CAPTURE(s.a.x);
        CAPTURE(s.a.y);
        CAPTURE(s.b.x);
        CAPTURE(s.b.y);
        checkAgainstDefinition<1>(s, target);
        checkAgainstDefinition<2>(s, target);
    }
}

TEST_CASE("line: both directions cover the same pixels")
{
    Random random(21);
    Framebuffer one = makeTarget(48, 40), other = makeTarget(48, 40);
    for (int i = 0; i < trials(500); ++i) {
        const auto point = [&] {
            const int x = random.between(-20 * 256, 70 * 256);
            return Point{x, random.between(-20 * 256, 60 * 256)};
        };
        const Segment s = {point(), point()};
        drawPixels<lineState<1>(kCount)>(one, meshOf(s));
        drawPixels<lineState<1>(kCount)>(other, meshOf(Segment{s.b, s.a}));
        CHECK(one.samePixels(other));
    }
}

TEST_CASE("line: values and depth change evenly from end to end")
{
    Mesh mesh;
    addLine(mesh, {{0.0f, 4.5f, 0.25f, 1.0f}, glm::vec4(0.0f)}, {{64.0f, 4.5f, 0.75f, 1.0f}, glm::vec4(1.0f)});
    Framebuffer target = makeTarget(64, 8);
    drawPixels<lineState<1>(kPaint)>(target, mesh, Value{});
    for (int x = 0; x < 64; ++x) {
        const float expected = (static_cast<float>(x) + 0.5f) / 64.0f;
        CHECK(target.color32f()[static_cast<std::size_t>(4 * 64 + x)].x == doctest::Approx(expected).epsilon(1e-6));
    }
    drawPixels<lineState<1>(kPaint)>(target, mesh, Position{});
    for (int x = 0; x < 64; ++x) {
        const float expected = 0.25f + 0.5f * (static_cast<float>(x) + 0.5f) / 64.0f;
        CHECK(target.color32f()[static_cast<std::size_t>(4 * 64 + x)].z == doctest::Approx(expected).epsilon(1e-6));
    }
}

TEST_CASE("line: what is behind a surface is hidden, what is in front is seen")
{
    Mesh wall, line;
    addTriangle(wall, Corners{{{0, 0}, {200 * 256, 0}, {0, 200 * 256}}}, glm::vec4(0.5f), 0.5f);
    addLine(line, {{0.0f, 8.5f, 0.0f, 1.0f}, glm::vec4(1.0f)}, {{32.0f, 8.5f, 1.0f, 1.0f}, glm::vec4(1.0f)});
    Framebuffer target = makeTarget(32, 16);
    const Viewport viewport = exactViewport(32, 16);
    Frame frame(target, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    frame.setViewport(viewport);
    frame.draw(wall, FromPixels(viewport), Value{}, kDepthTested);
    frame.draw(line, FromPixels(viewport), Value{}, lineState<1>(kDepthTested));
    frame.run();
    for (int x = 0; x < 32; ++x) {
        CHECK(target.color32f()[static_cast<std::size_t>(8 * 32 + x)].x == (x < 16 ? 1.0f : 0.5f));
    }
}

TEST_CASE("line: a depth bias does not move it")
{
    Mesh line;
    addLine(line, {{0.0f, 4.5f, 0.25f, 1.0f}}, {{64.0f, 4.5f, 0.75f, 1.0f}});
    Framebuffer plain = makeTarget(64, 8), biased = makeTarget(64, 8);
    static constexpr RenderState kState = lineState<1>(kPaint);
    static constexpr RenderState kBiased = [] {
        RenderState state = kState;
        state.depthBias = {1000.0f, 4.0f, 0.0f};
        return state;
    }();
    drawPixels<kState>(plain, line, Position{});
    drawPixels<kBiased>(biased, line, Position{});
    CHECK(biased.samePixels(plain));
}

TEST_CASE("line: through the eye, beyond the guard band, NaN, infinite, without length")
{
    Framebuffer target = makeTarget(64, 64);
    const auto statisticsOf = [&](const glm::vec4& a, const glm::vec4& b) {
        Mesh mesh;
        addLine(mesh, {a}, {b});
        return drawClip<lineState<1>(kCount)>(target, mesh);
    };
    const auto lit = [&] {
        int count = 0;
        for (const glm::vec4& c : target.color32f()) count += c.x == 1.0f;
        return count;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();

    // From the middle of the picture to a point behind the eye: cut at the near plane, and on to the border.
    CHECK(statisticsOf({0.0f, 0.01f, 0.5f, 1.0f}, {2.0f, 0.0f, -0.5f, -1.0f}).trianglesClipped == 1);
    CHECK(lit() > 0);
    // A horizontal line a million pixels long: every column once.
    statisticsOf({-30000.0f, 0.01f, 0.5f, 1.0f}, {30000.0f, 0.01f, 0.5f, 1.0f});
    CHECK(lit() == 64);
    CHECK(statisticsOf({0.0f, 0.0f, 0.5f, -1.0f}, {0.5f, 0.0f, 0.5f, -1.0f}).rasterised == 0);
    CHECK(statisticsOf({nan, 0.0f, 0.5f, 1.0f}, {0.5f, 0.0f, 0.5f, 1.0f}).droppedNan == 1);
    CHECK(statisticsOf({infinite, 0.0f, 0.5f, 1.0f}, {0.5f, 0.0f, 0.5f, 1.0f}).droppedInfinite == 1);
    CHECK(statisticsOf({0.1f, 0.1f, 0.5f, 1.0f}, {0.1f, 0.1f, 0.5f, 1.0f}).culledNoSample == 1);
    CHECK(lit() == 0);

    Mesh broken;
    addLine(broken, {{0.0f, 0.0f, 0.5f, 1.0f}}, {{0.5f, 0.0f, 0.5f, 1.0f}});
    broken.indices[1] = 7;
    CHECK(drawClip<lineState<1>(kCount)>(target, broken).droppedIndex == 1);
}

TEST_CASE("line: threads and tiles never show")
{
    Random random(22);
    Mesh mesh;
    for (int i = 0; i < 300; ++i) {
        const auto vertex = [&]() -> TestVertex {
            const float x = random.real(-2, 2), y = random.real(-2, 2), z = random.real(-0.2f, 1.2f);
            return {{x, y, z, random.real(-0.2f, 2)}, glm::vec4(random.real(0, 1))};
        };
        const TestVertex a = vertex();
        addLine(mesh, a, vertex());
    }
    Framebuffer expected = makeTarget(100, 70), target = makeTarget(100, 70);
    drawClip<lineState<2>(kDepthTested)>(expected, mesh, Value{});
    for (const int threads : {1, 2, 3}) {
        for (const int tileSize : {16, 32, 64, 128}) {
            drawClip<lineState<2>(kDepthTested)>(target, mesh, Value{}, {threads, tileSize});
            CHECK(target.samePixels(expected));
        }
    }
}

// Triangle setup: culling by the snapped orientation, what is dropped and counted as what, and the order of what is
// left.
#include "relief/pipeline/setup.h"

#include "numbers.h"
#include "pipeline_fixture.h"

using namespace fixture;

namespace {

std::int64_t doubledArea(const Corners& c)  // positive: clockwise, y down
{
    return (std::int64_t{c[1].x} - c[0].x) * (std::int64_t{c[2].y} - c[0].y) -
           (std::int64_t{c[2].x} - c[0].x) * (std::int64_t{c[1].y} - c[0].y);
}

bool hasCentre(const Corners& c, const Rectangle& bounds)  // in its bounding box
{
    const auto has = [](int a, int b, int d, int first, int end) {
        const int low = std::min({a, b, d}), high = std::max({a, b, d});
        for (int i = first; i < end; ++i) {
            if (i * 256 + 128 >= low && i * 256 + 128 <= high) return true;
        }
        return false;
    };
    return has(c[0].x, c[1].x, c[2].x, bounds.x0, bounds.x1) && has(c[0].y, c[1].y, c[2].y, bounds.y0, bounds.y1);
}

}  // namespace

TEST_CASE("setup: what is kept is clockwise, has a sample, and keeps its corners and its order (S-303)")
{
    Random random(20);
    const Viewport viewport = {0, 0, 64, 32};
    for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
        CAPTURE(static_cast<int>(cull));
        std::vector<Corners> triangles;
        std::vector<glm::vec4> positions;
        std::vector<std::uint32_t> indices;
        for (int i = 0; i < trials(20000); ++i) {
            triangles.push_back(randomTriangle(random, 64, 32));
            for (const Point& p : triangles.back()) {
                indices.push_back(static_cast<std::uint32_t>(positions.size()));
                positions.push_back(clipPosition(p, viewport));
            }
        }
        FrontEnd frontEnd(positions, indices, viewport);
        frontEnd.draw.cull = cull;
        frontEnd.draw.bounds = {3, 1, 60, 32};
        frontEnd.project();
        TriangleChunk chunk;
        Statistics statistics;
        // In two parts that do not end with a full block of lanes.
        const std::uint32_t part = frontEnd.draw.primitiveCount / 2 + 1;
        setUpTriangles(frontEnd.draw, 0, part, chunk, statistics);
        setUpTriangles(frontEnd.draw, part, frontEnd.draw.primitiveCount - part, chunk, statistics);

        std::size_t next = 0;
        std::uint64_t facingAway = 0, withoutSample = 0, outside = 0;
        int wrong = 0;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const Corners& c = triangles[i];
            const auto allBeyond = [&](auto test) { return test(c[0]) && test(c[1]) && test(c[2]); };
            if (allBeyond([](Point p) { return p.x < 0; }) || allBeyond([](Point p) { return p.x > 64 * 256; }) ||
                allBeyond([](Point p) { return p.y < 0; }) || allBeyond([](Point p) { return p.y > 32 * 256; })) {
                ++outside;
                continue;
            }
            const std::int64_t area = doubledArea(c);
            if (area == 0 || (cull == Cull::back && area < 0) || (cull == Cull::front && area > 0)) {
                ++facingAway;
                continue;
            }
            if (!hasCentre(c, frontEnd.draw.bounds)) {
                ++withoutSample;
                continue;
            }
            if (next == chunk.triangles.size()) {
                ++wrong;
                break;
            }
            const Triangle& t = chunk.triangles[next++];
            Corners kept;
            for (std::size_t k = 0; k < 3; ++k) {
                kept[k] = {t.x[k], t.y[k]};
                wrong += kept[k] != c[t.vertex[k] - 3 * i];
            }
            wrong += doubledArea(kept) <= 0 || t.vertex[0] != 3 * i;
        }
        measured("triangles wrong", wrong, 0);
        CHECK(next == chunk.triangles.size());
        CHECK(statistics.culledFacing == facingAway);
        CHECK(statistics.culledNoSample == withoutSample);
        CHECK(statistics.outside == outside);
        CHECK(statistics.rasterised == chunk.triangles.size());
        CHECK(statistics.trianglesClipped == 0);
        CHECK(addsUp(statistics));
    }
}

TEST_CASE("setup: orientation is that of the snapped corners (S-307)")
{
    Random random(21);
    const Viewport viewport = {0, 0, 16, 16};
    int wrong = 0, flips = 0;
    for (int trial = 0; trial < trials(20000); ++trial) {
        // Corners between the grid's points, a few sub-pixels apart, around a centre.
        std::vector<glm::vec4> positions;
        Corners snapped;
        double x[3], y[3];
        for (std::size_t k = 0; k < 3; ++k) {
            x[k] = 8.5 + random.between(-64, 64) / 8192.0;
            y[k] = 8.5 + random.between(-64, 64) / 8192.0;
            snapped[k] = {static_cast<int>(std::nearbyint(x[k] * 256)), static_cast<int>(std::nearbyint(y[k] * 256))};
            positions.emplace_back(static_cast<float>(x[k] / 8 - 1), static_cast<float>(1 - y[k] / 8), 0.5f, 1.0f);
        }
        const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        flips += area < 0 && doubledArea(snapped) > 0;
        for (const Cull cull : {Cull::back, Cull::front}) {
            FrontEnd frontEnd(positions, {0, 1, 2}, viewport);
            frontEnd.draw.cull = cull;
            frontEnd.project();
            TriangleChunk chunk;
            Statistics statistics;
            setUpTriangles(frontEnd.draw, 0, 1, chunk, statistics);
            const std::int64_t seen = cull == Cull::back ? doubledArea(snapped) : -doubledArea(snapped);
            wrong += chunk.triangles.size() != (seen > 0 && hasCentre(snapped, frontEnd.draw.bounds) ? 1u : 0u);
            wrong += statistics.culledFacing != (seen <= 0 ? 1u : 0u);
        }
    }
    measured("triangles whose facing is wrong", wrong, 0);
    CHECK(flips > 0);  // the case was met
}

TEST_CASE("setup: each reason to drop a triangle is counted as itself (S-101, S-102, S-104, S-106, S-112)")
{
    const std::vector<glm::vec4> positions = {
        {-1, -1, 0.5f, 1},        // 0: the corners of a triangle that is seen, clockwise on screen
        {0, 1, 0.5f, 1},          // 1
        {1, -1, 0.5f, 1},         // 2
        {kNan, 0, 0, 1},          // 3
        {0, 0, kNan, 1},          // 4
        {0, kInfinity, 0, 1},     // 5
        {0, 0, 0, -kInfinity},    // 6
        {3, 0, 0.5f, 1},          // 7: right of everything
        {0, 0, 0.5f, 0},          // 8: w = 0
        {0, 0, 0.5f, 1e-40f},     // 9: w subnormal
        {kNan, kInfinity, 0, 1},  // 10: both
        {0, 0, -3, 1},            // 11: before the near plane
    };
    struct Case
    {
        std::vector<std::uint32_t> indices;
        std::uint64_t Statistics::*counter;
    };
    const Case cases[] = {
        {{0, 1, 2}, &Statistics::rasterised},      {{0, 2, 1}, &Statistics::culledFacing},
        {{0, 0, 1}, &Statistics::culledFacing},    {{1, 1, 1}, &Statistics::culledFacing},
        {{3, 1, 2}, &Statistics::droppedNan},      {{0, 4, 2}, &Statistics::droppedNan},
        {{0, 1, 5}, &Statistics::droppedInfinite}, {{6, 1, 2}, &Statistics::droppedInfinite},
        {{10, 1, 2}, &Statistics::droppedNan},     {{0, 5, 3}, &Statistics::droppedNan},
        {{7, 7, 7}, &Statistics::outside},         {{11, 11, 11}, &Statistics::outside},
        {{8, 8, 8}, &Statistics::outside},         {{9, 9, 9}, &Statistics::outside},
        {{0, 1, 12}, &Statistics::droppedIndex},   {{0xffffffffu, 1, 2}, &Statistics::droppedIndex},
        {{12, 3, 5}, &Statistics::droppedIndex},
    };
    // Each alone, and all in one call in both orders.
    std::vector<std::uint32_t> all;
    for (const Case& c : cases) all.insert(all.end(), c.indices.begin(), c.indices.end());
    Statistics expected;
    for (const Case& c : cases) {
        CAPTURE(c.indices[0]);
        CAPTURE(c.indices[1]);
        CAPTURE(c.indices[2]);
        FrontEnd frontEnd(positions, c.indices, {0, 0, 32, 32});
        frontEnd.draw.cull = Cull::back;
        frontEnd.project();
        TriangleChunk chunk;
        Statistics statistics;
        setUpTriangles(frontEnd.draw, 0, 1, chunk, statistics);
        CHECK(statistics.*c.counter == 1);
        CHECK(addsUp(statistics));
        CHECK(chunk.triangles.size() == statistics.rasterised);
        ++(expected.*c.counter);
    }
    FrontEnd frontEnd(positions, all, {0, 0, 32, 32});
    frontEnd.draw.cull = Cull::back;
    frontEnd.project();
    TriangleChunk chunk;
    Statistics statistics;
    setUpTriangles(frontEnd.draw, 0, frontEnd.draw.primitiveCount, chunk, statistics);
    for (const Case& c : cases) CHECK(statistics.*c.counter == expected.*c.counter);
    CHECK(addsUp(statistics));
}

TEST_CASE("setup: clipped and unclipped triangles stay in submission order")
{
    Random random(22);
    std::vector<glm::vec4> positions;
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < 300; ++i) {
        const bool crossesNear = random.chance(3);
        for (int k = 0; k < 3; ++k) {
            indices.push_back(static_cast<std::uint32_t>(positions.size()));
            // The first corner is inside in both cases, and is the first of its fan.
            positions.emplace_back(k == 1   ? 0.0f
                                   : k == 0 ? -0.9f
                                            : 0.9f,
                                   k == 1 ? 0.9f : -0.9f, crossesNear && k == 2 ? -0.5f : 0.5f, 1.0f);
        }
    }
    FrontEnd frontEnd(positions, indices, {0, 0, 64, 64});
    frontEnd.project();
    TriangleChunk chunk;
    Statistics statistics;
    setUpTriangles(frontEnd.draw, 0, 300, chunk, statistics);
    CHECK(statistics.rasterised == 300);
    CHECK(statistics.trianglesClipped > 50);
    CHECK(chunk.triangles.size() == 300 + statistics.trianglesClipped);  // each cut makes a quad
    int unordered = 0;
    for (std::size_t i = 1; i < chunk.triangles.size(); ++i) {
        unordered += chunk.triangles[i].vertex[0] < chunk.triangles[i - 1].vertex[0];
    }
    CHECK(unordered == 0);
}

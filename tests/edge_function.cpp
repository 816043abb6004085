// Edge functions: every value, sign and bound against plain exact arithmetic.
#include "relief/pipeline/edge_function.h"

#include "pipeline_fixture.h"

using namespace fixture;

namespace {

constexpr int kLimit = kGuardBand * kSubpixels;

Point randomPoint(Random& random)
{
    const int reach = random.chance(3) ? kLimit : random.chance(2) ? 40 * 256 : 300;
    return {random.between(-reach, reach), random.between(-reach, reach)};
}

Triangle clockwise(const Corners& c)
{
    Triangle t{};
    for (int k = 0; k < 3; ++k) {
        t.x[k] = c[static_cast<std::size_t>(k)].x;
        t.y[k] = c[static_cast<std::size_t>(k)].y;
    }
    return t;
}

}  // namespace

TEST_CASE("edge function: E is twice the signed area of edge and pixel centre, exactly")
{
    Random random(1);
    int wrong = 0;
    for (int trial = 0; trial < trials(200000); ++trial) {
        const Point a = randomPoint(random), b = randomPoint(random);
        const int x = random.between(0, kMaxTargetSize - 1), y = random.between(0, kMaxTargetSize - 1);
        const EdgeFunction edge(a.x, a.y, b.x, b.y);
        const std::int64_t px = x * 256 + 128, py = y * 256 + 128;
        const std::int64_t exact = (std::int64_t{b.x} - a.x) * (py - a.y) - (std::int64_t{b.y} - a.y) * (px - a.x);
        const std::int64_t value = edge.origin + 256 * (std::int64_t{edge.stepX} * x + std::int64_t{edge.stepY} * y);
        wrong += value != exact;
        // coverage() has the sign that the fill rule needs, and is E / 256 rounded down.
        wrong += (edge.coverage(x, y) >= 0) != (edge.isTopLeft() ? exact >= 0 : exact > 0);
        wrong += edge.coverage(x, y) != ((exact - (edge.isTopLeft() ? 0 : 1)) >> 8);
    }
    CHECK(wrong == 0);
}

TEST_CASE("edge function: an edge is top-left exactly in one of its two directions")
{
    Random random(2);
    int wrong = 0;
    for (int trial = 0; trial < trials(20000); ++trial) {
        const Point a = randomPoint(random),
                    b = random.chance(4) ? Point{randomPoint(random).x, a.y} : randomPoint(random);
        if (a == b) continue;
        wrong += EdgeFunction(a.x, a.y, b.x, b.y).isTopLeft() == EdgeFunction(b.x, b.y, a.x, a.y).isTopLeft();
    }
    CHECK(wrong == 0);

    // A clockwise square (y down): its top edge runs to the right, its left edge up.
    CHECK(EdgeFunction(0, 0, 256, 0).isTopLeft());
    CHECK_FALSE(EdgeFunction(256, 0, 256, 256).isTopLeft());
    CHECK_FALSE(EdgeFunction(256, 256, 0, 256).isTopLeft());
    CHECK(EdgeFunction(0, 256, 0, 0).isTopLeft());
}

TEST_CASE("edge function: the three edges of a triangle sum to its area at every pixel")
{
    Random random(3);
    int wrong = 0;
    for (int trial = 0; trial < trials(20000); ++trial) {
        const Corners c = {randomPoint(random), randomPoint(random), randomPoint(random)};
        const Triangle t = clockwise(c);
        const std::int64_t area = (std::int64_t{c[1].x} - c[0].x) * (std::int64_t{c[2].y} - c[0].y) -
                                  (std::int64_t{c[2].x} - c[0].x) * (std::int64_t{c[1].y} - c[0].y);
        std::int64_t sum = 0, stepX = 0, stepY = 0;
        for (int k = 0; k < 3; ++k) {
            const EdgeFunction edge = edgeOf(t, k);
            sum += edge.origin;
            stepX += edge.stepX;
            stepY += edge.stepY;
        }
        wrong += sum != area || stepX != 0 || stepY != 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("edge function: sampleBounds holds every covered pixel, and no row or column without a centre in the box")
{
    Random random(4);
    const Rectangle clip = {0, 0, 70, 40};
    int outside = 0, wrong = 0;
    for (int trial = 0; trial < trials(20000); ++trial) {
        const Corners c = randomTriangle(random, 70, 40, kGuardBand);
        const Rectangle box = sampleBounds(clockwise(c), clip);
        ExactTriangle(c).forEachPixel(
            clip, [&](int x, int y) { outside += x < box.x0 || x >= box.x1 || y < box.y0 || y >= box.y1; });
        // By definition: centres x + 1/2 between the lowest and the highest corner, both included.
        const int lowX = std::min({c[0].x, c[1].x, c[2].x}), highX = std::max({c[0].x, c[1].x, c[2].x});
        const int lowY = std::min({c[0].y, c[1].y, c[2].y}), highY = std::max({c[0].y, c[1].y, c[2].y});
        for (int x = clip.x0; x < clip.x1; ++x) {
            const bool within = x * 256 + 128 >= lowX && x * 256 + 128 <= highX;
            wrong += within != (x >= box.x0 && x < box.x1);
        }
        for (int y = clip.y0; y < clip.y1; ++y) {
            const bool within = y * 256 + 128 >= lowY && y * 256 + 128 <= highY;
            wrong += within != (y >= box.y0 && y < box.y1);
        }
    }
    CHECK(outside == 0);
    CHECK(wrong == 0);
}

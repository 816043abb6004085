// Binning: every tile gets the triangles that cover a pixel of it, in submission order, and hardly any others.
#include "relief/pipeline/bin.h"

#include <algorithm>

#include "pipeline_fixture.h"
#include "relief/pipeline/edge_function.h"

using namespace fixture;

namespace {

Triangle clockwise(const Corners& c)
{
    const std::int64_t area = (std::int64_t{c[1].x} - c[0].x) * (std::int64_t{c[2].y} - c[0].y) -
                              (std::int64_t{c[2].x} - c[0].x) * (std::int64_t{c[1].y} - c[0].y);
    Triangle t{};
    const std::size_t order[3] = {0, area < 0 ? 2u : 1u, area < 0 ? 1u : 2u};
    for (int k = 0; k < 3; ++k) {
        t.x[k] = c[order[k]].x;
        t.y[k] = c[order[k]].y;
    }
    return t;
}

void bin(TriangleChunk& chunk, const TileGrid& grid, const DrawGeometry& draw)
{
    chunk.entries.clear();
    findTiles(chunk, 0, grid, draw);
    sortByTile(chunk, grid);
}

}  // namespace

TEST_CASE("bin: tiles get exactly the triangles that no edge keeps out, in order (S-311, S-1004)")
{
    Random random(12);
    constexpr int kWidth = 300, kHeight = 200;
    for (const int tileSize : {16, 32, 64, 128}) {
        CAPTURE(tileSize);
        DrawGeometry draw;
        draw.bounds = {0, 0, kWidth, kHeight};
        const TileGrid grid = {tileSize, (kWidth + tileSize - 1) / tileSize, (kHeight + tileSize - 1) / tileSize};

        TriangleChunk chunk;
        std::vector<Corners> corners;
        while (static_cast<int>(corners.size()) < trials(600)) {
            const Corners c = randomTriangle(random, kWidth, kHeight, kGuardBand);
            const Triangle t = clockwise(c);
            const Rectangle box = sampleBounds(t, draw.bounds);
            if (ExactTriangle(c).isEmpty() || box.x0 >= box.x1 || box.y0 >= box.y1) continue;  // setup drops these
            corners.push_back(c);
            chunk.triangles.push_back(t);
        }
        bin(chunk, grid, draw);
        CHECK(chunk.entries.size() == chunk.sorted.size());
        CHECK(chunk.binStart.size() == static_cast<std::size_t>(grid.count()) + 1);
        CHECK(chunk.binStart.back() == chunk.sorted.size());

        int missing = 0, needless = 0, unordered = 0;
        for (int tile = 0; tile < grid.count(); ++tile) {
            const auto first = chunk.sorted.begin() + chunk.binStart[static_cast<std::size_t>(tile)];
            const auto last = chunk.sorted.begin() + chunk.binStart[static_cast<std::size_t>(tile) + 1];
            unordered += std::adjacent_find(first, last, [](auto a, auto b) { return a >= b; }) != last;

            const int x0 = tile % grid.width * tileSize, y0 = tile / grid.width * tileSize;
            const Rectangle whole = {x0, y0, x0 + tileSize, y0 + tileSize};
            for (std::uint32_t i = 0; i < corners.size(); ++i) {
                const bool binned = std::binary_search(first, last, i);
                const ExactTriangle exact(corners[i]);
                int covered = 0;
                exact.forEachPixel(intersect(whole, draw.bounds), [&](int, int) { ++covered; });
                missing += covered != 0 && !binned;

                // Binned, although one edge has all of the tile's centres outside?
                if (!binned || covered != 0) continue;
                bool kept = true;
                for (const ExactEdge& edge : exact.edges) {
                    bool some = false;
                    for (const Point p : {Point{x0, y0}, Point{x0 + tileSize - 1, y0}, Point{x0, y0 + tileSize - 1},
                                          Point{x0 + tileSize - 1, y0 + tileSize - 1}}) {
                        some = some || edge.covers(edge.at({p.x * 256 + 128, p.y * 256 + 128}));
                    }
                    kept = kept && some;
                }
                const Rectangle box = sampleBounds(chunk.triangles[i], draw.bounds);
                const bool alone =
                    (box.x0 / tileSize == (box.x1 - 1) / tileSize) && (box.y0 / tileSize == (box.y1 - 1) / tileSize);
                needless += !kept && !alone;
            }
        }
        measured("pairs of a triangle and a tile that are missing", missing, 0);
        measured("needless pairs", needless, 0);
        measured("pairs out of order", unordered, 0);
    }
}

TEST_CASE("bin: a chunk without triangles, and one with a triangle over all tiles")
{
    DrawGeometry draw;
    draw.bounds = {0, 0, 100, 100};
    const TileGrid grid = {16, 7, 7};
    TriangleChunk chunk;
    bin(chunk, grid, draw);
    CHECK(chunk.sorted.empty());
    CHECK(chunk.binStart == std::vector<std::uint32_t>(50, 0));

    chunk.triangles.push_back(clockwise({{{-25600, -25600}, {25600 * 4, -25600}, {-25600, 25600 * 4}}}));
    bin(chunk, grid, draw);
    CHECK(chunk.sorted == std::vector<std::uint32_t>(49, 0));
    CHECK(chunk.entries.size() == 49);

    // Used again: nothing of the frame before is left.
    chunk.clear();
    chunk.triangles.push_back(clockwise({{{0, 0}, {512, 0}, {0, 512}}}));
    bin(chunk, grid, draw);
    CHECK(chunk.sorted == std::vector<std::uint32_t>(1, 0));
    CHECK(chunk.binStart[0] == 0);
    CHECK(chunk.binStart[1] == 1);
    CHECK(chunk.binStart[49] == 1);
}

TEST_CASE("bin: the scissor's and the viewport's pixels alone decide on tiles (S-317)")
{
    DrawGeometry draw;
    draw.bounds = {20, 20, 21, 21};
    TriangleChunk chunk;
    chunk.triangles.push_back(clockwise({{{0, 0}, {25600, 0}, {0, 25600}}}));
    bin(chunk, {16, 7, 7}, draw);
    REQUIRE(chunk.entries.size() == 1);
    CHECK(chunk.entries[0].tile == 8);
}

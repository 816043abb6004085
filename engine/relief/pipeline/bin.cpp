#include "relief/pipeline/bin.h"

#include <algorithm>
#include <bit>

#include "relief/pipeline/edge_function.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// What an edge's coverage() is at most in a tile's pixels: at their centres, or, with a reach, so near to them.
class LargestInTile
{
public:
    LargestInTile(const EdgeFunction& edge, int tileSize, int sampleReach)
        : stepX(std::int64_t{edge.stepX} * tileSize), stepY(std::int64_t{edge.stepY} * tileSize)
    {
        const int last = tileSize - 1;
        const SamplePattern::Position innermost = {edge.stepX < 0 ? -sampleReach : sampleReach,
                                                   edge.stepY < 0 ? -sampleReach : sampleReach};
        inFirst = edge.coverage(edge.stepX > 0 ? last : 0, edge.stepY > 0 ? last : 0, innermost);
    }

    std::int64_t at(int tileX, int tileY) const { return inFirst + stepX * tileX + stepY * tileY; }

private:
    std::int64_t stepX, stepY, inFirst;
};

// kLanes triangles of one draw, or fewer: the tiles that their pixels' bounds span.
struct TileSpans
{
    Int x0, y0, x1, y1;  // tiles, all included

    TileSpans(const Triangle* first, std::uint32_t count, const TileGrid& grid, const DrawGeometry& draw)
    {
        native::IntVector w[8];  // the corners' x and y are a triangle's first six words
        const auto addressOf = [&](int lane) {
            return reinterpret_cast<const std::byte*>(first + (static_cast<std::uint32_t>(lane) < count ? lane : 0));
        };
        native::loadTransposed<native::FourWords>(addressOf, w);
        native::loadTransposed<native::FourWords>([&](int lane) { return addressOf(lane) + 16; }, w + 4);
        const Int x[3] = {Int(w[0]), Int(w[1]), Int(w[2])}, y[3] = {Int(w[3]), Int(w[4]), Int(w[5])};
        const RectangleLanes pixels = sampleBounds(x, y, draw.bounds, draw.sampleReach);
        const int shift = std::countr_zero(static_cast<unsigned>(grid.tileSize));
        x0 = pixels.x0 >> shift;
        y0 = pixels.y0 >> shift;
        x1 = (pixels.x1 - 1) >> shift;
        y1 = (pixels.y1 - 1) >> shift;
    }
};

// A triangle over several tiles: those that no edge keeps out.
void binLarge(TriangleChunk& chunk, std::uint32_t index, const TileGrid& grid, int sampleReach, int x0, int y0, int x1,
              int y1)
{
    const Triangle& t = chunk.triangles[index];
    const auto ofEdge = [&](int k) { return LargestInTile(edgeOf(t, k), grid.tileSize, sampleReach); };
    const LargestInTile a = ofEdge(0), b = ofEdge(1), c = ofEdge(2);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            if ((a.at(x, y) | b.at(x, y) | c.at(x, y)) >= 0)  // none negative
                chunk.entries.push_back({static_cast<std::uint32_t>(y * grid.width + x), index});
        }
    }
}

}  // namespace

void findTiles(TriangleChunk& chunk, std::uint32_t begin, const TileGrid& grid, const DrawGeometry& draw)
{
    const auto total = static_cast<std::uint32_t>(chunk.triangles.size());
    for (std::uint32_t next = begin; next < total; next += kLanes) {
        const std::uint32_t count = std::min<std::uint32_t>(kLanes, total - next);
        const TileSpans span(&chunk.triangles[next], count, grid, draw);
        std::int32_t tile[kLanes];
        (span.y0 * Int(grid.width) + span.x0).store(tile);
        const unsigned several = ((span.x0 != span.x1) | (span.y0 != span.y1)).bits();
        if (several == 0) {
            const std::size_t size = chunk.entries.size();
            chunk.entries.resize(size + count);
            for (std::uint32_t i = 0; i < count; ++i)
                chunk.entries[size + i] = {static_cast<std::uint32_t>(tile[i]), next + i};
            continue;
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            const int lane = static_cast<int>(i);
            if ((several >> i & 1u) == 0) {
                chunk.entries.push_back({static_cast<std::uint32_t>(tile[i]), next + i});
            } else {
                binLarge(chunk, next + i, grid, draw.sampleReach, span.x0[lane], span.y0[lane], span.x1[lane],
                         span.y1[lane]);
            }
        }
    }
}

void sortByTile(TriangleChunk& chunk, const TileGrid& grid)
{
    // A counting sort by tile; it keeps the order of equal keys. While it runs, binStart[tile + 1] is where the tile's
    // next triangle goes; in the end that is where the tile after it starts.
    // Neighbours are often of one tile, and are counted together: a sum in memory would wait for the one before.
    chunk.binStart.assign(static_cast<std::size_t>(grid.count()) + 2, 0);
    const std::vector<TriangleChunk::BinEntry>& entries = chunk.entries;
    const auto endOfRun = [&entries](std::size_t first) {
        std::size_t end = first + 1;
        while (end < entries.size() && entries[end].tile == entries[first].tile) ++end;
        return end;
    };
    for (std::size_t i = 0, end; i < entries.size(); i = end) {
        end = endOfRun(i);
        chunk.binStart[entries[i].tile + 2] += static_cast<std::uint32_t>(end - i);
    }
    for (std::size_t tile = 2; tile < chunk.binStart.size(); ++tile) chunk.binStart[tile] += chunk.binStart[tile - 1];
    chunk.sorted.resize(entries.size());
    for (std::size_t i = 0, end; i < entries.size(); i = end) {
        end = endOfRun(i);
        std::uint32_t& start = chunk.binStart[entries[i].tile + 1];
        for (std::size_t k = i; k < end; ++k) chunk.sorted[start + (k - i)] = entries[k].triangle;
        start += static_cast<std::uint32_t>(end - i);
    }
    chunk.binStart.pop_back();
}

}  // namespace relief::inline RELIEF_WIDTH

#include "pipeline/bin.h"

#include <algorithm>

#include "pipeline/edge_function.h"

namespace relief {

namespace {

// Whether no pixel centre of the square of `size` pixels at (x, y) is inside the edge.
bool rejects(const EdgeFunction& edge, int x, int y, int size)
{
    const std::int64_t reach = size - 1;
    return edge.coverage(x, y) + reach * std::max(0, edge.stepX) + reach * std::max(0, edge.stepY) < 0;
}

void binTriangle(TriangleChunk& chunk, std::uint32_t index, const TileGrid& grid, const Rectangle& bounds)
{
    const Triangle& t = chunk.triangles[index];
    const Rectangle pixels = sampleBounds(t, bounds);
    const int shift = std::countr_zero(static_cast<unsigned>(grid.tileSize));
    const int x0 = pixels.x0 >> shift, x1 = (pixels.x1 - 1) >> shift;
    const int y0 = pixels.y0 >> shift, y1 = (pixels.y1 - 1) >> shift;
    const auto add = [&](int x, int y) {
        chunk.entries.push_back({static_cast<std::uint32_t>(y * grid.width + x), index});
    };
    if (x0 == x1 && y0 == y1) {
        add(x0, y0);
        return;
    }
    const EdgeFunction edges[3] = {edgeOf(t, 0), edgeOf(t, 1), edgeOf(t, 2)};
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const bool outside = std::any_of(edges, edges + 3, [&](const EdgeFunction& edge) {
                return rejects(edge, x << shift, y << shift, grid.tileSize);
            });
            if (!outside) add(x, y);
        }
    }
}

}  // namespace

void binTriangles(TriangleChunk& chunk, const TileGrid& grid, const DrawGeometry* const* draws, Statistics& statistics)
{
    for (std::uint32_t i = 0; i < chunk.triangles.size(); ++i) {
        binTriangle(chunk, i, grid, draws[chunk.triangles[i].drawIndex]->bounds);
    }
    statistics.trianglesBinned += chunk.entries.size();

    // A counting sort by tile; it keeps the order of equal keys.
    chunk.binStart.assign(static_cast<std::size_t>(grid.count()) + 1, 0);
    for (const TriangleChunk::BinEntry& e : chunk.entries) ++chunk.binStart[e.tile + 1];
    for (std::size_t tile = 1; tile < chunk.binStart.size(); ++tile) chunk.binStart[tile] += chunk.binStart[tile - 1];
    chunk.sorted.resize(chunk.entries.size());
    std::vector<std::uint32_t> next(chunk.binStart.begin(), chunk.binStart.end() - 1);
    for (const TriangleChunk::BinEntry& e : chunk.entries) chunk.sorted[next[e.tile]++] = e.triangle;
}

}  // namespace relief

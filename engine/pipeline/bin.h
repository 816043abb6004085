// Binning: which tiles a triangle touches. Setup fills chunks, binning sorts each chunk's triangles by tile, and a tile
// later reads its bin of every chunk in turn: submission order is kept.
#pragma once

#include "pipeline/geometry.h"
#include "pipeline/statistics.h"

namespace relief {

struct TileGrid
{
    int tileSize = kDefaultTileSize;  // pixels, a power of two
    int width = 0, height = 0;        // tiles

    int count() const { return width * height; }
};

// Bins all triangles of the chunk. `bounds[d]` are the pixels that draw d may touch.
void binTriangles(TriangleChunk& chunk, const TileGrid& grid, const DrawGeometry* const* draws, Statistics& statistics);

}  // namespace relief

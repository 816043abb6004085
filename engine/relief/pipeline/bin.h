// Binning: which tiles a triangle touches. Setup fills chunks, binning sorts each chunk's triangles by tile, and a tile
// later reads its bin of every chunk in turn: submission order is kept.
#pragma once

#include "relief/pipeline/geometry.h"

namespace relief::inline RELIEF_WIDTH {

struct TileGrid
{
    int tileSize = kDefaultTileSize;  // pixels, a power of two
    int width = 0, height = 0;        // tiles

    int count() const { return width * height; }
};

// Finds the tiles of the chunk's triangles from `first` on, all of them one draw's.
void findTiles(TriangleChunk& chunk, std::uint32_t first, const TileGrid& grid, const DrawGeometry& draw);

// Sorts what findTiles() found by tile.
void sortByTile(TriangleChunk& chunk, const TileGrid& grid);

}  // namespace relief::inline RELIEF_WIDTH

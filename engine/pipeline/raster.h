// Rasterisation: which pixels of a tile a triangle covers, block by block. Exact: integers only, no epsilon.
#pragma once

#include <cstdint>

#include "pipeline/geometry.h"

namespace relief {

// A block with at least one covered pixel.
struct CoveredBlock
{
    const Triangle* triangle;
    std::uint16_t x, y;      // of its upper left pixel, in the target
    std::uint32_t coverage;  // a bit per lane
};

// Appends the blocks of `clip` (a tile, or a part of one) in which the triangle covers a pixel to `out`, row by row,
// and returns the new end. There must be room for every block of `clip` and one more.
CoveredBlock* rasterise(const Triangle& triangle, const Rectangle& clip, CoveredBlock* out);

}  // namespace relief

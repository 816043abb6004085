// Rasterisation: which pixels of a tile a triangle covers, block by block. Exact: integers only, no epsilon.
#pragma once

#include <cstdint>

#include "pipeline/geometry.h"

namespace relief {

// A block with at least one covered pixel.
struct CoveredBlock
{
    const Triangle* triangle;
    std::uint16_t x, y;       // of its upper left pixel, in the target
    std::uint32_t coverage;   // a bit per lane
};

// Appends the covered blocks of `pixels` (a part of one tile, not empty) to `out` and returns the new end.
CoveredBlock* rasterise(const Triangle& triangle, const Rectangle& pixels, CoveredBlock* out);

}  // namespace relief

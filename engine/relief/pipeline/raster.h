// Rasterisation: which pixels of a tile a triangle covers, block by block. Exact: integers only, no epsilon.
#pragma once

#include <array>
#include <cstdint>

#include "relief/pipeline/triangle_batch.h"

namespace relief::inline RELIEF_WIDTH {

// A block with at least one covered pixel, or sample.
struct CoveredBlock
{
    // In this order the compiler puts together beforehand what a row of blocks has in common.
    std::uint16_t x;         // of its upper left pixel, in the target
    std::uint16_t coverage;  // a bit per lane: of any of its samples
    std::uint16_t y;
    std::uint16_t triangle;  // its place in the batch
};

// What of each sample, where there are several: a bit per lane.
using SampleCoverage = std::array<std::uint16_t, kMaxSamples>;

// Which blocks of `clip` (a tile, or a part of one; the batch was set up for it) the triangles of a batch cover pixels
// of: triangle by triangle, row by row, from `out` on. Returns the end. There must be room for every block of `clip`
// for every triangle, and for one more; and as much room for samples, where a pixel has several.
CoveredBlock* rasterise(const TriangleBatch& batch, const Rectangle& clip, CoveredBlock* out,
                        SampleCoverage* samples = nullptr);

}  // namespace relief::inline RELIEF_WIDTH

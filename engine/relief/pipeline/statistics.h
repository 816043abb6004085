// What a frame did, counted while it ran. Every count but `blocksShaded` is the same for any number of threads and of
// lanes, and every one but that, `tiles`, `tilesTouched` and `trianglesBinned` for any tile size.
#pragma once

#include <cstdint>

#include "relief/texture/fetch_counters.h"

namespace relief {

struct Statistics
{
    std::uint64_t draws = 0;
    std::uint64_t verticesShaded = 0;

    // submitted = culled + outside + droppedNan + droppedInfinite + droppedIndex + rasterised
    std::uint64_t trianglesSubmitted = 0;  // and lines, each counted once
    std::uint64_t culledFacing = 0;        // by orientation, or of zero area after snapping
    std::uint64_t culledNoSample = 0;      // no pixel centre inside their bounds, or outside the scissor
    std::uint64_t outside = 0;             // wholly beyond a plane of the view volume, or clipped to nothing
    std::uint64_t droppedNan = 0;          // a vertex position with a NaN
    std::uint64_t droppedInfinite = 0;     // a vertex position with an infinity
    std::uint64_t droppedIndex = 0;        // an index beyond the vertices
    std::uint64_t rasterised = 0;

    std::uint64_t trianglesClipped = 0;  // of those submitted: cut at a plane
    std::uint64_t trianglesBinned = 0;   // triangle and tile pairs

    std::uint64_t tiles = 0;
    std::uint64_t tilesTouched = 0;     // tiles that a triangle was binned into
    std::uint64_t blocksShaded = 0;     // runs of the fragment program, on a block or on one that several share
    std::uint64_t quadsShaded = 0;      // 2x2 pixels with at least one live pixel
    std::uint64_t pixelsShaded = 0;     // live pixels: lanes whose result counted
    std::uint64_t pixelsColorless = 0;  // of those: drawn without the fragment program, as no target keeps its colours
    std::uint64_t pixelsHidden = 0;     // covered, but failed the stencil or the depth test before shading
    std::uint64_t invalidColors = 0;    // pixels whose colour had a NaN or an infinity, which was replaced

    // Of draws with a stencil test into a target that has a stencil: samples that passed it and that did not.
    std::uint64_t stencilPassed = 0, stencilFailed = 0;

    FetchCounters fetches;

    Statistics& operator+=(const Statistics& other);
    Statistics& operator-=(const Statistics& other);
};

}  // namespace relief

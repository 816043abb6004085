// How far two rasterizers' pictures of one scene agree.
#pragma once

#include <cstdint>
#include <span>

#include "scenes.h"

namespace relief::benchmarks {

struct Agreement
{
    std::size_t pixels = 0;
    std::size_t coverageDiffers = 0;  // pixels that only one of the two drew to: whose alpha is 0 in one of them
    std::size_t awayFromEdges = 0;    // of these, those none of whose samples is within 1/256 of a pixel of an edge
    std::size_t close = 0;            // pixels of which every colour channel differs by 1 at most
    int largest = 0;                  // difference of a channel
};

// R, G, B, A from the lowest byte up, row 0 on top. The scene is drawn with its matrices.
Agreement agreement(const SceneData& scene, int width, int height, int samples, std::span<const std::uint32_t> ours,
                    std::span<const std::uint32_t> theirs);

}  // namespace relief::benchmarks

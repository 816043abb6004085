// Up to kLanes triangles of one draw on their way through a tile: what rasterisation and interpolation have to know of
// each, worked out for all of them at once. A lane is a triangle here, not a pixel.
#pragma once

#include <span>

#include "relief/lanes/float.h"
#include "relief/pipeline/geometry.h"
#include "relief/pipeline/sample_pattern.h"

namespace relief::inline RELIEF_WIDTH {

struct TriangleBatch
{
    // Sets up `triangles` (1 ... kLanes) for the pixels of `clip` and their samples.
    void set(std::span<const Triangle* const> triangles, const Rectangle& clip,
             const SamplePattern& samplePattern = kOneSample, const DepthBias& bias = {});

    const SamplePattern* samples;
    const Triangle* triangle[kLanes];
    unsigned visible;  // a bit per triangle: there are pixels within its bounds and `clip`
    unsigned small;    // a bit per triangle: its edge functions fit into 32 bits at every block that it touches

    Int x0, y0, x1, y1;  // those pixels (sampleBounds()); x0 and y0 moved to the block grid

    // The edge functions (edge_function.h) modulo 2^32, which is enough for small triangles.
    Int origin[3];           // at the centre of pixel (0, 0)
    Int stepX[3], stepY[3];  // from one pixel to the next
    Int sum;                 // of all three, at any pixel: twice the area
    Int coverage[3];         // at the centre of pixel (x0, y0), less 1 unless the edge is top-left: inside is >= 0

    Float doubledArea, inverseArea;  // 2 * area in 1/65536 px^2, and 1 / that
    Float invW[3];                   // 1/w times `scale`, which brings the largest near 1
    Float scale;                     // a power of two
    Float z0, dz1, dz2;              // depth at corner 0, and from it to the others
    Float nearest, farthest;         // the corners' depths, within 0 ... 1
};

}  // namespace relief::inline RELIEF_WIDTH

#include "pipeline/raster.h"

#include <algorithm>

#include "lanes/int.h"
#include "pipeline/edge_function.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// Edges whose sign varies among the pixels in question, as 32-bit values at the lanes of a block.
struct EdgeLanes
{
    Int value[3];                     // at the first block of the current row of blocks
    std::int32_t stepX[3], stepY[3];  // to the next block, to the next row of blocks
    int count = 0;

    // An edge whose value is `corner` at the upper left pixel of the first block, and changes by x and y per pixel.
    void add(std::int32_t corner, std::int32_t x, std::int32_t y)
    {
        value[count] = laneXs() * Int(x) + laneYs() * Int(y) + corner;
        stepX[count] = x * kBlockWidth;
        stepY[count] = y * kBlockHeight;
        ++count;
    }
};

// The lanes of the block at (x, y) that lie within `pixels`.
unsigned lanesWithin(const Rectangle& pixels, int x, int y)
{
    const Int px = laneXs() + x, py = laneYs() + y;
    return ((px >= pixels.x0) & (px < pixels.x1) & (py >= pixels.y0) & (py < pixels.y1)).bits();
}

bool isOnBlockGrid(const Rectangle& r)
{
    return ((r.x0 | r.x1) & (kBlockWidth - 1)) == 0 && ((r.y0 | r.y1) & (kBlockHeight - 1)) == 0;
}

// Visits the blocks of `pixels` (not empty, upper left corner on the block grid): those that all edges let through.
// `edges` is how many there are. Where `clip` is not on the block grid, its lanes are cut off too.
template <int edges>
inline CoveredBlock* coverBlocks(int triangle, const Rectangle& pixels, const Rectangle* clip, EdgeLanes& lanes,
                                 CoveredBlock* out)
{
    for (int y = pixels.y0;;) {
        Int value[3];
        for (int k = 0; k < edges; ++k) value[k] = lanes.value[k];
        for (int x = pixels.x0;;) {
            // Outside is where any edge is negative: the sign bit of them all.
            unsigned coverage = kAllLanes;
            if constexpr (edges == 1) coverage &= ~signBits(value[0]);
            if constexpr (edges == 2) coverage &= ~signBits(value[0] | value[1]);
            if constexpr (edges == 3) coverage &= ~signBits(value[0] | value[1] | value[2]);
            if (clip != nullptr) coverage &= lanesWithin(*clip, x, y);
            *out = {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(coverage), static_cast<std::uint16_t>(y),
                    static_cast<std::uint16_t>(triangle)};
            out += coverage != 0 ? 1 : 0;
            // Most small triangles end here: nothing is worked out for blocks that do not follow.
            x += kBlockWidth;
            if (x >= pixels.x1) break;
            for (int k = 0; k < edges; ++k) value[k] += lanes.stepX[k];
        }
        y += kBlockHeight;
        if (y >= pixels.y1) return out;
        for (int k = 0; k < edges; ++k) lanes.value[k] += lanes.stepY[k];
    }
}

// A triangle of at most kSmallTriangle pixels: its edge values near it fit into 32 bits, and nothing is worth sorting
// out.
inline CoveredBlock* coverSmall(const TriangleBatch& batch, int triangle, const Rectangle& pixels,
                                const Rectangle* clip, CoveredBlock* out)
{
    EdgeLanes lanes;
    for (int k = 0; k < 3; ++k)
        lanes.add(batch.coverage[k][triangle], batch.stepX[k][triangle], batch.stepY[k][triangle]);
    return coverBlocks<3>(triangle, pixels, clip, lanes, out);
}

// Any triangle, in a part of the screen of at most kCoverageSquare pixels: edges that have all of it on one side are
// sorted out first, and the others then fit into 32 bits.
CoveredBlock* coverSquare(const TriangleBatch& batch, int triangle, const Rectangle& pixels, const Rectangle* clip,
                          CoveredBlock* out)
{
    EdgeLanes lanes;
    const std::int64_t lastX = ((pixels.x1 - pixels.x0 + kBlockWidth - 1) & -kBlockWidth) - 1;
    const std::int64_t lastY = ((pixels.y1 - pixels.y0 + kBlockHeight - 1) & -kBlockHeight) - 1;
    for (int k = 0; k < 3; ++k) {
        const EdgeFunction edge = edgeOf(*batch.triangle[triangle], k);
        const std::int64_t corner = edge.coverage(pixels.x0, pixels.y0);
        const std::int64_t acrossX = edge.stepX * lastX, acrossY = edge.stepY * lastY;
        const std::int64_t zero = 0;
        if (corner + std::max(zero, acrossX) + std::max(zero, acrossY) < 0) return out;
        if (corner + std::min(zero, acrossX) + std::min(zero, acrossY) >= 0) continue;
        lanes.add(static_cast<std::int32_t>(corner), edge.stepX, edge.stepY);
    }
    switch (lanes.count) {
        case 0:
            return coverBlocks<0>(triangle, pixels, clip, lanes, out);
        case 1:
            return coverBlocks<1>(triangle, pixels, clip, lanes, out);
        case 2:
            return coverBlocks<2>(triangle, pixels, clip, lanes, out);
        default:
            return coverBlocks<3>(triangle, pixels, clip, lanes, out);
    }
}

// Any triangle, square by square.
CoveredBlock* coverLarge(const TriangleBatch& batch, int triangle, const Rectangle& pixels, const Rectangle* clip,
                         CoveredBlock* out)
{
    for (int y = pixels.y0; y < pixels.y1;) {
        const int nextY = std::min(pixels.y1, (y & -kCoverageSquare) + kCoverageSquare);
        for (int x = pixels.x0; x < pixels.x1;) {
            const int nextX = std::min(pixels.x1, (x & -kCoverageSquare) + kCoverageSquare);
            out = coverSquare(batch, triangle, {x, y, nextX, nextY}, clip, out);
            x = nextX;
        }
        y = nextY;
    }
    return out;
}

}  // namespace

[[gnu::flatten]] CoveredBlock* rasterise(const TriangleBatch& batch, const Rectangle& clip, CoveredBlock* out)
{
    const Rectangle* cut = isOnBlockGrid(clip) ? nullptr : &clip;
    for (unsigned rest = batch.visible; rest != 0; rest &= rest - 1) {
        const int t = std::countr_zero(rest);
        const Rectangle pixels = {batch.x0[t], batch.y0[t], batch.x1[t], batch.y1[t]};
        const bool small = (batch.small >> t & 1u) != 0;
        out = small ? coverSmall(batch, t, pixels, cut, out) : coverLarge(batch, t, pixels, cut, out);
    }
    return out;
}

}  // namespace relief::inline RELIEF_WIDTH

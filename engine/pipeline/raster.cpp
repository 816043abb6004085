#include "pipeline/raster.h"

#include <algorithm>

#include "lanes/int.h"
#include "pipeline/edge_function.h"

namespace relief {

namespace {

// The edges that cross a square of the screen, each as 32-bit values at the lanes of a block.
struct CrossingEdges
{
    Int value[3];  // at the first block of the current row of blocks
    std::int32_t stepX[3], stepY[3];
    int count = 0;
};

// The lanes of the block at (x, y) that lie within `pixels`.
unsigned lanesWithin(const Rectangle& pixels, int x, int y)
{
    if (x >= pixels.x0 && y >= pixels.y0 && x + kBlockWidth <= pixels.x1 && y + kBlockHeight <= pixels.y1) {
        return kAllLanes;
    }
    const Int px = laneXs() + x, py = laneYs() + y;
    return ((px >= pixels.x0) & (px < pixels.x1) & (py >= pixels.y0) & (py < pixels.y1)).bits();
}

// The edges that a square of pixels has on both sides; false where one of them has it all outside.
bool findCrossingEdges(const Triangle& triangle, int x, int y, int width, int height, CrossingEdges& crossing)
{
    for (int k = 0; k < 3; ++k) {
        const EdgeFunction edge = edgeOf(triangle, k);
        const std::int64_t corner = edge.coverage(x, y);
        const std::int64_t acrossX = static_cast<std::int64_t>(edge.stepX) * (width - 1);
        const std::int64_t acrossY = static_cast<std::int64_t>(edge.stepY) * (height - 1);
        const std::int64_t highest = corner + std::max<std::int64_t>(0, acrossX) + std::max<std::int64_t>(0, acrossY);
        const std::int64_t lowest = corner + std::min<std::int64_t>(0, acrossX) + std::min<std::int64_t>(0, acrossY);
        if (highest < 0) return false;
        if (lowest >= 0) continue;
        const int n = crossing.count++;
        crossing.stepX[n] = edge.stepX * kBlockWidth;
        crossing.stepY[n] = edge.stepY * kBlockHeight;
        crossing.value[n] = laneXs() * Int(edge.stepX) + laneYs() * Int(edge.stepY) + static_cast<std::int32_t>(corner);
    }
    return true;
}

// One square, at most kCoverageSquare wide, its origin on the block grid. `edges` is the number of crossing edges.
template <int edges>
CoveredBlock* coverSquare(const Triangle& triangle, const Rectangle& pixels, int x0, int y0, CrossingEdges& crossing,
                          CoveredBlock* out)
{
    for (int y = y0; y < pixels.y1; y += kBlockHeight) {
        Int value[3];
        for (int k = 0; k < edges; ++k) value[k] = crossing.value[k];
        for (int x = x0; x < pixels.x1; x += kBlockWidth) {
            // Outside is where any edge is negative: the sign bit of them all.
            unsigned coverage = lanesWithin(pixels, x, y);
            if constexpr (edges == 1) coverage &= ~signBits(value[0]);
            if constexpr (edges == 2) coverage &= ~signBits(value[0] | value[1]);
            if constexpr (edges == 3) coverage &= ~signBits(value[0] | value[1] | value[2]);
            *out = {&triangle, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), coverage};
            out += coverage != 0 ? 1 : 0;
            for (int k = 0; k < edges; ++k) value[k] += crossing.stepX[k];
        }
        for (int k = 0; k < edges; ++k) crossing.value[k] += crossing.stepY[k];
    }
    return out;
}

}  // namespace

CoveredBlock* rasterise(const Triangle& triangle, const Rectangle& pixels, CoveredBlock* out)
{
    for (int y = pixels.y0 & -kBlockHeight; y < pixels.y1; y = (y & -kCoverageSquare) + kCoverageSquare) {
        for (int x = pixels.x0 & -kBlockWidth; x < pixels.x1; x = (x & -kCoverageSquare) + kCoverageSquare) {
            const Rectangle square = {pixels.x0, pixels.y0, std::min(pixels.x1, (x & -kCoverageSquare) + kCoverageSquare),
                                      std::min(pixels.y1, (y & -kCoverageSquare) + kCoverageSquare)};
            const int width = ((square.x1 - x + kBlockWidth - 1) & -kBlockWidth);
            const int height = ((square.y1 - y + kBlockHeight - 1) & -kBlockHeight);
            CrossingEdges crossing;
            if (!findCrossingEdges(triangle, x, y, width, height, crossing)) continue;
            switch (crossing.count) {
                case 0: out = coverSquare<0>(triangle, square, x, y, crossing, out); break;
                case 1: out = coverSquare<1>(triangle, square, x, y, crossing, out); break;
                case 2: out = coverSquare<2>(triangle, square, x, y, crossing, out); break;
                default: out = coverSquare<3>(triangle, square, x, y, crossing, out); break;
            }
        }
    }
    return out;
}

}  // namespace relief

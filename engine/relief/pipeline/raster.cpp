#include "relief/pipeline/raster.h"

#include <algorithm>

#include "relief/lanes/int.h"
#include "relief/pipeline/edge_function.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// Edges whose sign varies among the pixels in question, as 32-bit values at the lanes of a block.
struct EdgeLanes
{
    Int value[3];                           // at the first block of the current row of blocks
    std::int32_t stepX[3], stepY[3];        // to the next block, to the next row of blocks
    std::int32_t toSample[3][kMaxSamples];  // from a pixel's centre, where it has several
    int count = 0;

    // An edge whose value is `corner` at the upper left pixel of the first block, and changes by x and y per pixel.
    void add(std::int32_t corner, std::int32_t x, std::int32_t y)
    {
        value[count] = laneXs() * Int(x) + laneYs() * Int(y) + corner;
        stepX[count] = x * kBlockWidth;
        stepY[count] = y * kBlockHeight;
        ++count;
    }

    // Of an edge: what there is to add for each sample.
    template <class ToSample>
    void addSamples(int edge, const SamplePattern& pattern, const ToSample& toOne)
    {
        for (std::size_t s = 0; s < static_cast<std::size_t>(pattern.count); ++s)
            toSample[edge][s] = toOne(pattern.position[s]);
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

// Where blocks and their samples go, and what cuts them.
struct Room
{
    const SamplePattern& pattern;
    const Rectangle* clip;  // where it is not on the block grid
    CoveredBlock* blocks;
    SampleCoverage* samples;  // null where a pixel has one
};

// The lanes inside of all edges. Outside is where any of them is negative: the sign bit of them all.
template <int edges>
unsigned insideOf(const Int (&value)[3])
{
    if constexpr (edges == 1) return kAllLanes & ~signBits(value[0]);
    if constexpr (edges == 2) return kAllLanes & ~signBits(value[0] | value[1]);
    if constexpr (edges == 3) return kAllLanes & ~signBits(value[0] | value[1] | value[2]);
    return kAllLanes;
}

// The same for each sample; returns the lanes that have any.
template <int edges>
unsigned coverSamples(const EdgeLanes& lanes, const Int (&value)[3], unsigned within, int count,
                      SampleCoverage& samples)
{
    unsigned any = 0;
    for (std::size_t s = 0; s < static_cast<std::size_t>(count); ++s) {
        Int atSample[3];
        for (int k = 0; k < edges; ++k) atSample[k] = value[k] + lanes.toSample[k][s];
        const unsigned covered = insideOf<edges>(atSample) & within;
        samples[s] = static_cast<std::uint16_t>(covered);
        any |= covered;
    }
    return any;
}

// Visits the blocks of `pixels` (not empty, upper left corner on the block grid): those that all edges let through.
// `edges` is how many there are.
template <int edges, bool severalSamples>
inline CoveredBlock* coverBlocks(int triangle, const Rectangle& pixels, const Room& room, EdgeLanes& lanes,
                                 CoveredBlock* out)
{
    for (int y = pixels.y0;;) {
        Int value[3];
        for (int k = 0; k < edges; ++k) value[k] = lanes.value[k];
        for (int x = pixels.x0;;) {
            unsigned coverage = kAllLanes;
            if (room.clip != nullptr) coverage = lanesWithin(*room.clip, x, y);
            if constexpr (severalSamples) {
                coverage =
                    coverSamples<edges>(lanes, value, coverage, room.pattern.count, room.samples[out - room.blocks]);
            } else {
                coverage &= insideOf<edges>(value);
            }
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
template <bool severalSamples>
inline CoveredBlock* coverSmall(const TriangleBatch& batch, int triangle, const Rectangle& pixels, const Room& room,
                                CoveredBlock* out)
{
    EdgeLanes lanes;
    for (int k = 0; k < 3; ++k) {
        const std::int32_t x = batch.stepX[k][triangle], y = batch.stepY[k][triangle];
        lanes.add(batch.coverage[k][triangle], x, y);
        if constexpr (severalSamples)
            lanes.addSamples(k, room.pattern, [x, y](SamplePattern::Position p) {
                return (x >> kSubpixelBits) * p.x + (y >> kSubpixelBits) * p.y;
            });
    }
    return coverBlocks<3, severalSamples>(triangle, pixels, room, lanes, out);
}

// Any triangle, in a part of the screen of at most kCoverageSquare pixels: edges that have all of it on one side are
// sorted out first, and the others then fit into 32 bits.
template <bool severalSamples>
CoveredBlock* coverSquare(const TriangleBatch& batch, int triangle, const Rectangle& pixels, const Room& room,
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
        std::int64_t low = 0, high = 0;  // of a pixel's samples
        if constexpr (severalSamples) {
            const auto toSample = [&](SamplePattern::Position p) {
                return static_cast<std::int32_t>(edge.coverage(pixels.x0, pixels.y0, p) - corner);
            };
            lanes.addSamples(lanes.count, room.pattern, toSample);
            const auto [least, most] =
                std::minmax_element(lanes.toSample[lanes.count], lanes.toSample[lanes.count] + room.pattern.count);
            low = *least;
            high = *most;
        }
        if (corner + high + std::max(zero, acrossX) + std::max(zero, acrossY) < 0) return out;
        if (corner + low + std::min(zero, acrossX) + std::min(zero, acrossY) >= 0) continue;
        lanes.add(static_cast<std::int32_t>(corner), edge.stepX, edge.stepY);
    }
    switch (lanes.count) {
        case 0:
            return coverBlocks<0, severalSamples>(triangle, pixels, room, lanes, out);
        case 1:
            return coverBlocks<1, severalSamples>(triangle, pixels, room, lanes, out);
        case 2:
            return coverBlocks<2, severalSamples>(triangle, pixels, room, lanes, out);
        default:
            return coverBlocks<3, severalSamples>(triangle, pixels, room, lanes, out);
    }
}

// Any triangle, square by square.
template <bool severalSamples>
CoveredBlock* coverLarge(const TriangleBatch& batch, int triangle, const Rectangle& pixels, const Room& room,
                         CoveredBlock* out)
{
    for (int y = pixels.y0; y < pixels.y1;) {
        const int nextY = std::min(pixels.y1, (y & -kCoverageSquare) + kCoverageSquare);
        for (int x = pixels.x0; x < pixels.x1;) {
            const int nextX = std::min(pixels.x1, (x & -kCoverageSquare) + kCoverageSquare);
            out = coverSquare<severalSamples>(batch, triangle, {x, y, nextX, nextY}, room, out);
            x = nextX;
        }
        y = nextY;
    }
    return out;
}

template <bool severalSamples>
[[gnu::flatten]] CoveredBlock* coverBatch(const TriangleBatch& batch, const Room& room, CoveredBlock* out)
{
    for (unsigned rest = batch.visible; rest != 0; rest &= rest - 1) {
        const int t = std::countr_zero(rest);
        const Rectangle pixels = {batch.x0[t], batch.y0[t], batch.x1[t], batch.y1[t]};
        const bool small = (batch.small >> t & 1u) != 0;
        out = small ? coverSmall<severalSamples>(batch, t, pixels, room, out)
                    : coverLarge<severalSamples>(batch, t, pixels, room, out);
    }
    return out;
}

}  // namespace

CoveredBlock* rasterise(const TriangleBatch& batch, const Rectangle& clip, CoveredBlock* out, SampleCoverage* samples)
{
    const Room room = {*batch.samples, isOnBlockGrid(clip) ? nullptr : &clip, out, samples};
    return batch.samples->isMultiple() ? coverBatch<true>(batch, room, out) : coverBatch<false>(batch, room, out);
}

}  // namespace relief::inline RELIEF_WIDTH

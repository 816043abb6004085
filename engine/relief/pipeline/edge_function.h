// The edge function: twice the signed area of the triangle (a, b, p), in 1/65536 px^2; positive where p is on the inner
// side of an edge a -> b of a clockwise triangle (y down).
//
//     E(p) = (b.x - a.x) (p.y - a.y) - (b.y - a.y) (p.x - a.x)
//
// All coordinates are integers (24.8 fixed point), so E is one too, and every sign is exact.
#pragma once

#include <cstdint>

#include "relief/lanes/int.h"
#include "relief/pipeline/geometry.h"
#include "relief/pipeline/sample_pattern.h"

namespace relief::inline RELIEF_WIDTH {

struct EdgeFunction
{
    std::int32_t stepX, stepY;  // E changes by 256 * step from one pixel to the next
    std::int64_t origin;        // E at the centre of pixel (0, 0)

    EdgeFunction() = default;
    EdgeFunction(std::int32_t ax, std::int32_t ay, std::int32_t bx, std::int32_t by)
        : stepX(ay - by),
          stepY(bx - ax),
          origin(static_cast<std::int64_t>(stepY) * (kSubpixels / 2 - ay) +
                 static_cast<std::int64_t>(stepX) * (kSubpixels / 2 - ax))
    {
    }

    // The top-left rule: a pixel centre that lies on an edge belongs to the triangle whose top (horizontal, above the
    // others) or left edge it is (D3D 11.3, 3.4.2.1). For all other edges E = 0 is outside.
    bool isTopLeft() const { return stepX > 0 || (stepX == 0 && stepY > 0); }

    // floor(E / 256), lowered by one unit of E unless the edge is top-left, at the centre of pixel (x, y), or at a
    // sample so many sub-pixels from it: not negative exactly where that is inside, because whole pixels change E by
    // multiples of 256.
    std::int64_t coverage(int x, int y, SamplePattern::Position sample = {0, 0}) const
    {
        const std::int64_t biased = at(sample) - (isTopLeft() ? 0 : 1);
        return (biased >> kSubpixelBits) + along(x, y);
    }

    // E at a sample of pixel (0, 0).
    std::int64_t at(SamplePattern::Position sample) const { return origin + along(sample.x, sample.y); }

private:
    std::int64_t along(int x, int y) const
    {
        return static_cast<std::int64_t>(stepX) * x + static_cast<std::int64_t>(stepY) * y;
    }
};

// Edge k lies opposite corner k: E_k / area is the barycentric weight of that corner.
inline EdgeFunction edgeOf(const Triangle& t, int k)
{
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    return {t.x[a], t.y[a], t.x[b], t.y[b]};
}

// The smallest and largest of three coordinates.
inline std::int32_t lowest(const std::int32_t v[3])
{
    const std::int32_t low = v[0] < v[1] ? v[0] : v[1];
    return low < v[2] ? low : v[2];
}
inline std::int32_t highest(const std::int32_t v[3])
{
    const std::int32_t high = v[0] > v[1] ? v[0] : v[1];
    return high > v[2] ? high : v[2];
}

// The pixels whose centres lie within the triangle's bounds, clipped; may be empty. With a reach, those that have a
// point so far from the centre or nearer, in sub-pixels, within the bounds: all that could have a sample there.
inline Rectangle sampleBounds(const Triangle& t, const Rectangle& clip, int reach = 0)
{
    const int first = kSubpixels / 2 - 1 - reach, last = kSubpixels / 2 - reach;
    return intersect({(lowest(t.x) + first) >> kSubpixelBits, (lowest(t.y) + first) >> kSubpixelBits,
                      ((highest(t.x) - last) >> kSubpixelBits) + 1, ((highest(t.y) - last) >> kSubpixelBits) + 1},
                     clip);
}

// The same with a triangle in every lane: pixels [x0, x1) x [y0, y1).
struct RectangleLanes
{
    Int x0, y0, x1, y1;
};

inline RectangleLanes sampleBounds(const Int (&x)[3], const Int (&y)[3], const Rectangle& clip, int reach)
{
    const int first = kSubpixels / 2 - 1 - reach, last = kSubpixels / 2 - reach;
    const Int minX = min(min(x[0], x[1]), x[2]), maxX = max(max(x[0], x[1]), x[2]);
    const Int minY = min(min(y[0], y[1]), y[2]), maxY = max(max(y[0], y[1]), y[2]);
    return {max((minX + first) >> kSubpixelBits, clip.x0), max((minY + first) >> kSubpixelBits, clip.y0),
            min(((maxX - last) >> kSubpixelBits) + 1, clip.x1), min(((maxY - last) >> kSubpixelBits) + 1, clip.y1)};
}

}  // namespace relief::inline RELIEF_WIDTH

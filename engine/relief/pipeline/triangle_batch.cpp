#include "relief/pipeline/triangle_batch.h"

#include <cstddef>
#include <limits>

#include "relief/lanes/double.h"
#include "relief/pipeline/edge_function.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// Where the snapped corners lie.
struct Corners
{
    Int x[3], y[3];
};

void setBounds(TriangleBatch& batch, const Corners& c, const Rectangle& clip)
{
    const RectangleLanes pixels = sampleBounds(c.x, c.y, clip, batch.samples->reach);
    batch.x0 = pixels.x0 & -kBlockWidth;
    batch.y0 = pixels.y0 & -kBlockHeight;
    batch.x1 = pixels.x1;
    batch.y1 = pixels.y1;
    batch.visible = ((pixels.x0 < pixels.x1) & (pixels.y0 < pixels.y1)).bits();

    constexpr std::int32_t limit = kSmallTriangle * kSubpixels;
    const auto extent = [](const Int(&v)[3]) { return max(max(v[0], v[1]), v[2]) - min(min(v[0], v[1]), v[2]); };
    batch.small = ((extent(c.x) <= limit) & (extent(c.y) <= limit)).bits();
}

// EdgeFunction and edgeOf(), modulo 2^32.
void setEdges(TriangleBatch& batch, const Corners& c)
{
    for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const Int stepX = c.y[a] - c.y[b], stepY = c.x[b] - c.x[a];
        batch.origin[k] = stepY * (kSubpixels / 2 - c.y[a]) + stepX * (kSubpixels / 2 - c.x[a]);
        batch.stepX[k] = stepX << kSubpixelBits;
        batch.stepY[k] = stepY << kSubpixelBits;
        const Mask topLeft = (stepX > 0) | ((stepX == 0) & (stepY > 0));
        batch.coverage[k] =
            batch.origin[k] + batch.stepX[k] * batch.x0 + batch.stepY[k] * batch.y0 - select(topLeft, Int(0), Int(1));
    }
    batch.sum = batch.origin[0] + batch.origin[1] + batch.origin[2];
}

// An integer below 2^49: exact in double, rounded once to float.
void setArea(TriangleBatch& batch, const Corners& c)
{
    const Double x1(c.x[1] - c.x[0]), y1(c.y[1] - c.y[0]), x2(c.x[2] - c.x[0]), y2(c.y[2] - c.y[0]);
    batch.doubledArea = toFloat(x1 * y2 - x2 * y1);
    batch.inverseArea = 1.0f / batch.doubledArea;
}

// `a` where the two are equal, or b is NaN: exactly the scalar code b < a ? b : a.
Float lower(Float a, Float b)
{
    return Float(native::min(b.value, a.value));
}
Float higher(Float a, Float b)
{
    return Float(native::max(b.value, a.value));
}

// 1/w times a power of two that brings the largest near 1: exact, and no w can over- or underflow the sums.
void setInvW(TriangleBatch& batch, const Float (&invW)[3])
{
    const Int exponent = asInt(higher(higher(invW[0], invW[1]), invW[2])) & 0x7f800000;
    batch.scale = asFloat(Int(0x7f000000) - max(exponent, 0x00800000));
    // The smallest are kept above zero: a pixel in the very corner has no other weight to be divided by.
    constexpr float least = std::numeric_limits<float>::min();
    for (int k = 0; k < 3; ++k) batch.invW[k] = higher(invW[k] * batch.scale, least);
}

// DepthBias in every lane, for depths z.
Float biasOf(const TriangleBatch& batch, const Corners& c, const Float (&z)[3], const DepthBias& bias)
{
    // One step of a float is 2^-23 of the power of two below it.
    const Float largest = higher(higher(abs(z[0]), abs(z[1])), abs(z[2]));
    const Float step = asFloat(asInt(largest) & 0x7f800000) * 0x1p-23f;
    // Differences of corners are exact; dz/dx = 256 ((y2 - y0) dz1 - (y1 - y0) dz2) / (2 area).
    const auto side = [](const Int(&v)[3], int k) { return Float(v[k] - v[0]); };
    const Float dz1 = z[1] - z[0], dz2 = z[2] - z[0], perPixel = static_cast<float>(kSubpixels) * batch.inverseArea;
    const Float across = abs(side(c.y, 2) * dz1 - side(c.y, 1) * dz2),
                down = abs(side(c.x, 1) * dz2 - side(c.x, 2) * dz1);
    Float sum = bias.constant * step;
    // Seen edge-on the slope may be infinite, or no number: no bias by it where none is asked for, else the largest.
    if (bias.slope != 0.0f) {
        const Float slope = higher(across, down) * perPixel;
        sum = sum + bias.slope * select(isnan(slope), Float(std::numeric_limits<float>::max()), slope);
    }
    // On the limit's side only; finite anyhow.
    return clamp(sum, bias.limit < 0.0f ? bias.limit : -1e30f, bias.limit > 0.0f ? bias.limit : 1e30f);
}

void setDepth(TriangleBatch& batch, const Float (&z)[3])
{
    const auto inRange = [](Float depth) { return lower(higher(depth, 0.0f), 1.0f); };
    batch.z0 = z[0];
    batch.dz1 = z[1] - z[0];
    batch.dz2 = z[2] - z[0];
    batch.nearest = inRange(lower(lower(z[0], z[1]), z[2]));
    batch.farthest = inRange(higher(higher(z[0], z[1]), z[2]));
}

}  // namespace

void TriangleBatch::set(std::span<const Triangle* const> triangles, const Rectangle& clip,
                        const SamplePattern& samplePattern, const DepthBias& bias)
{
    samples = &samplePattern;
    // The 12 words before `vertex`, from one triangle after the other to one word after the other. Lanes that are not
    // used hold the first triangle again.
    static_assert(offsetof(Triangle, y) == 12 && offsetof(Triangle, z) == 24 && offsetof(Triangle, invW) == 36);
    for (std::size_t i = 0; i < kLanes; ++i) triangle[i] = triangles[i < triangles.size() ? i : 0];
    native::IntVector word[12];
    for (int part = 0; part < 3; ++part) {
        const auto addressOf = [&](int lane) { return reinterpret_cast<const std::byte*>(triangle[lane]) + 16 * part; };
        native::loadTransposed<native::FourWords>(addressOf, word + 4 * part);
    }
    const Corners corners = {{Int(word[0]), Int(word[1]), Int(word[2])}, {Int(word[3]), Int(word[4]), Int(word[5])}};
    Float z[3] = {asFloat(Int(word[6])), asFloat(Int(word[7])), asFloat(Int(word[8]))};
    const Float w[3] = {asFloat(Int(word[9])), asFloat(Int(word[10])), asFloat(Int(word[11]))};

    setBounds(*this, corners, clip);
    visible &= triangles.size() < kLanes ? (1u << triangles.size()) - 1 : kAllLanes;
    setEdges(*this, corners);
    setArea(*this, corners);
    setInvW(*this, w);
    if (bias.constant != 0.0f || bias.slope != 0.0f) {
        const Float by = biasOf(*this, corners, z, bias);
        for (Float& depth : z) depth = depth + by;
    }
    setDepth(*this, z);
}

}  // namespace relief::inline RELIEF_WIDTH

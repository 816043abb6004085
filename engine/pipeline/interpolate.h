// Interpolation: from a triangle's three corners to every pixel of a block. The weights come from the exact integer
// edge values, rounded once to float, so they are good to the last bits for slivers, huge triangles and triangles far
// from the origin alike, and do not depend on tile or block.
//
//     b_k = E_k / area                     linear on screen: depth, and what is declared noperspective
//     p_k = E_k / w_k / sum(E_j / w_j)     linear in space: everything else
#pragma once

#include <limits>

#include "hlsl/semantics.h"
#include "lanes/double.h"
#include "pipeline/edge_function.h"

namespace relief {

// The edge values of one block, rounded to float, and what follows from them.
struct BlockWeights
{
    Float linear1, linear2;            // b_1, b_2
    Float perspective1, perspective2;  // p_1, p_2
    Float inverseSum;                  // 1 / sum(E_j / w_j), w scaled by TriangleWeights::scale
};

class TriangleWeights
{
public:
    TriangleWeights() = default;
    explicit TriangleWeights(const Triangle& t) { set(t); }

    void set(const Triangle& t)
    {
        small = isSmall(t);
        for (int k = 0; k < 3; ++k) {
            edge[k] = edgeOf(t, k);
            const Int steps = laneXs() * Int(edge[k].stepX) + laneYs() * Int(edge[k].stepY);
            if (small) {
                smallLanes[k] = steps << kSubpixelBits;
            } else {
                // stepX * 3 + stepY * 3 stays below 2^27; times 256 it needs the double.
                largeLanes[k] = Double(steps) * Double(kSubpixels);
            }
        }
        const std::int64_t area = static_cast<std::int64_t>(t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) -
                                  static_cast<std::int64_t>(t.x[2] - t.x[0]) * (t.y[1] - t.y[0]);
        inverseArea = 1.0f / static_cast<float>(area);

        // 1/w times a power of two that brings the largest near 1: exact, and no w can over- or underflow the sums.
        float largest = t.invW[0];
        for (int k = 1; k < 3; ++k) largest = t.invW[k] > largest ? t.invW[k] : largest;
        const std::uint32_t exponent = std::bit_cast<std::uint32_t>(largest) & 0x7f800000u;
        const float powerOfTwo = std::bit_cast<float>(0x7f000000u - (exponent < 0x00800000u ? 0x00800000u : exponent));
        // The smallest are kept above zero: a pixel in the very corner has no other weight to be divided by.
        constexpr float least = std::numeric_limits<float>::min();
        for (int k = 0; k < 3; ++k) {
            invW[k] = t.invW[k] * powerOfTwo;
            invW[k] = invW[k] < least ? least : invW[k];
        }
        scale = powerOfTwo;
        doubledArea = static_cast<float>(area);

        z0 = t.z[0];
        dz1 = t.z[1] - t.z[0];
        dz2 = t.z[2] - t.z[0];
        nearest = t.z[0];
        farthest = t.z[0];
        for (int k = 1; k < 3; ++k) {
            nearest = t.z[k] < nearest ? t.z[k] : nearest;
            farthest = t.z[k] > farthest ? t.z[k] : farthest;
        }
        const auto inRange = [](float z) { return z < 0.0f ? 0.0f : z > 1.0f ? 1.0f : z; };
        nearest = inRange(nearest);
        farthest = inRange(farthest);
    }

    // Of the block whose upper left pixel is (x, y). `covered` lanes lie in the triangle.
    BlockWeights at(int x, int y, unsigned covered) const
    {
        Float e[3];
        for (int k = 0; k < 3; ++k) e[k] = edgeValue(k, x, y);

        BlockWeights w;
        w.linear1 = e[1] * inverseArea;
        w.linear2 = e[2] * inverseArea;

        Float sum = e[0] * invW[0] + e[1] * invW[1] + e[2] * invW[2];
        if (covered != kAllLanes) [[unlikely]] {
            // Beyond the triangle the sum, which is 1/w, may reach zero: behind the horizon. There, attributes come
            // from the nearest weights within the triangle instead, so that differences to the neighbours stay finite.
            // Just above zero it is as bad. Covered pixels have no negative weights: nothing changes for them.
            const Mask beyond = !(sum > 0x1p-20f);
            if (any(beyond)) {
                for (Float& value : e) value = select(beyond, max(value, Float(0.0f)), value);
                sum = e[0] * invW[0] + e[1] * invW[1] + e[2] * invW[2];
            }
        }
        w.inverseSum = 1.0f / sum;
        w.perspective1 = e[1] * invW[1] * w.inverseSum;
        w.perspective2 = e[2] * invW[2] * w.inverseSum;
        return w;
    }

    // Linear on screen, and never outside 0 ... 1 and the corners' range, so that coarse depth bounds are safe.
    Float depth(const BlockWeights& w) const
    {
        return clamp(z0 + w.linear1 * dz1 + w.linear2 * dz2, nearest, farthest);
    }

    // Clip-space w at the pixels.
    Float clipW(const BlockWeights& w) const { return doubledArea * w.inverseSum * scale; }

    float nearest = 0, farthest = 0;  // the corners' depths, within 0 ... 1

private:
    // E at the pixels of a block: an exact integer either way, then rounded once.
    Float edgeValue(int k, int x, int y) const
    {
        const std::int64_t steps =
            static_cast<std::int64_t>(edge[k].stepX) * x + static_cast<std::int64_t>(edge[k].stepY) * y;
        const std::int64_t corner = edge[k].origin + steps * kSubpixels;
        if (small) return Float(smallLanes[k] + static_cast<std::int32_t>(corner));
        return toFloat(largeLanes[k] + Double(static_cast<double>(corner)));
    }

    EdgeFunction edge[3] = {};
    Int smallLanes[3] = {0, 0, 0};
    Double largeLanes[3] = {0.0, 0.0, 0.0};
    bool small = false;
    float doubledArea = 0, inverseArea = 0, scale = 0;
    float invW[3] = {};
    float z0 = 0, dz1 = 0, dz2 = 0;
};

// The components of a triangle's corners, ready to be weighted.
template <int components>
struct CornerComponents
{
    float first[components + 1] = {}, toSecond[components + 1] = {},
                             toThird[components + 1] = {};  // + 1: zero components are allowed

    void set(const float* a, const float* b, const float* c)
    {
        for (int i = 0; i < components; ++i) {
            first[i] = a[i];
            toSecond[i] = b[i] - a[i];
            toThird[i] = c[i] - a[i];
        }
    }

    Float perspective(int i, const BlockWeights& w) const
    {
        return first[i] + w.perspective1 * toSecond[i] + w.perspective2 * toThird[i];
    }
    Float affine(int i, const BlockWeights& w) const
    {
        return first[i] + w.linear1 * toSecond[i] + w.linear2 * toThird[i];
    }
};

// Fills in a fragment program's input. What the program does not read, the compiler leaves out.
template <class Interpolators, int components>
Interpolators interpolate(const TriangleWeights& triangle, const CornerComponents<components>& corners,
                          const BlockWeights& w, int x, int y, Float depth)
{
    Interpolators result;
    int slot = 0;
    forEachField(result, [&]<class Field>(Field& field) {
        if constexpr (Field::kIsPosition) {
            field.x = Float(laneXs() + x) + 0.5f;
            field.y = Float(laneYs() + y) + 0.5f;
            field.z = depth;
            field.w = triangle.clipW(w);
        } else {
            for (int c = 0; c < kComponents<typename Field::Value>; ++c, ++slot) {
                component(static_cast<typename Field::Value&>(field), c) =
                    Field::kInterpolation == Interpolation::perspective ? corners.perspective(slot, w)
                                                                        : corners.affine(slot, w);
            }
        }
    });
    return result;
}

}  // namespace relief

// Interpolation: from a triangle's three corners to every pixel of a block. The weights come from the exact integer
// edge values, rounded once to float, so they are good to the last bits for slivers, huge triangles and triangles far
// from the origin alike, and do not depend on tile or block.
//
//     b_k = E_k / area                     linear on screen: depth, and what is declared noperspective
//     p_k = E_k / w_k / sum(E_j / w_j)     linear in space: everything else
#pragma once

#include "hlsl/semantics.h"
#include "lanes/double.h"
#include "pipeline/edge_function.h"
#include "pipeline/triangle_batch.h"

namespace relief {

// One number for all lanes, as it is read fastest: SSE2 has no instruction that spreads a number while it is loaded.
using Broadcast = std::conditional_t<kLanes == 4, Float, float>;

// The edge values of one block, rounded to float, and what follows from them.
struct BlockWeights
{
    Float linear1, linear2;            // b_1, b_2
    Float perspective1, perspective2;  // p_1, p_2
    Float inverseSum;                  // 1 / sum(E_j / w_j), w scaled by TriangleWeights::scale
};

// One triangle of a batch, which must live as long.
class TriangleWeights
{
public:
    void set(const TriangleBatch& triangles, int triangle)
    {
        batch = &triangles;
        lane = triangle;
        nearest = batch->nearest[lane];
        farthest = batch->farthest[lane];
        inverseArea = batch->inverseArea[lane];
        z0 = batch->z0[lane];
        dz1 = batch->dz1[lane];
        dz2 = batch->dz2[lane];
        small = (batch->small >> lane & 1u) != 0;
        for (int k = 0; k < 3; ++k) {
            invW[k] = batch->invW[k][lane];
            if (small) {
                stepX[k] = batch->stepX[k][lane];
                stepY[k] = batch->stepY[k][lane];
                smallLanes[k] = laneXs() * stepX[k] + laneYs() * stepY[k] + batch->origin[k][lane];
            } else {
                const EdgeFunction edge = edgeOf(*batch->triangle[lane], k);
                // stepX * 3 + stepY * 3 stays below 2^27; times 256 it needs the double.
                const Int steps = laneXs() * edge.stepX + laneYs() * edge.stepY;
                largeLanes[k] = Double(steps) * Double(kSubpixels) + Double(static_cast<double>(edge.origin));
                largeStepX[k] = static_cast<double>(edge.stepX) * kSubpixels;
                largeStepY[k] = static_cast<double>(edge.stepY) * kSubpixels;
            }
        }
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
    Float clipW(const BlockWeights& w) const { return batch->doubledArea[lane] * w.inverseSum * batch->scale[lane]; }

    float nearest, farthest;  // the corners' depths, within 0 ... 1

private:
    // E at the pixels of a block: an exact integer either way, then rounded once.
    Float edgeValue(int k, int x, int y) const
    {
        if (small) {
            const std::uint32_t steps = static_cast<std::uint32_t>(stepX[k]) * static_cast<std::uint32_t>(x) +
                                        static_cast<std::uint32_t>(stepY[k]) * static_cast<std::uint32_t>(y);
            return Float(smallLanes[k] + static_cast<std::int32_t>(steps));
        }
        return toFloat(largeLanes[k] + Double(largeStepX[k] * x + largeStepY[k] * y));
    }

    const TriangleBatch* batch;
    int lane;
    bool small;

    // E at the pixels of the block at (0, 0), and its steps from one pixel to the next: modulo 2^32 where the triangle
    // is small, or exact in doubles.
    Int smallLanes[3];
    std::int32_t stepX[3], stepY[3];
    Double largeLanes[3];
    double largeStepX[3], largeStepY[3];

    // The batch's, of this triangle.
    Broadcast invW[3], inverseArea, z0, dz1, dz2;
};

// The components of a triangle's corners, ready to be weighted.
template <int components>
struct CornerComponents
{
    Broadcast first[components + 1], toSecond[components + 1], toThird[components + 1];  // + 1: there may be none

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

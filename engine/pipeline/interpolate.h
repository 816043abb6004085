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
        small = (batch->small >> lane & 1u) != 0;
        for (int k = 0; k < 3; ++k) {
            if (small) {
                const Int stepX = batch->stepX[k][lane], stepY = batch->stepY[k][lane];
                smallLanes[k] = laneXs() * stepX + laneYs() * stepY + batch->origin[k][lane];
            } else {
                edge[k] = edgeOf(*batch->triangle[lane], k);
                const Int steps = laneXs() * Int(edge[k].stepX) + laneYs() * Int(edge[k].stepY);
                // stepX * 3 + stepY * 3 stays below 2^27; times 256 it needs the double.
                largeLanes[k] = Double(steps) * Double(kSubpixels);
            }
        }
    }

    // Of the block whose upper left pixel is (x, y). `covered` lanes lie in the triangle.
    BlockWeights at(int x, int y, unsigned covered) const
    {
        Float e[3];
        for (int k = 0; k < 3; ++k) e[k] = edgeValue(k, x, y);

        BlockWeights w;
        const float inverseArea = batch->inverseArea[lane];
        w.linear1 = e[1] * inverseArea;
        w.linear2 = e[2] * inverseArea;

        const float invW[3] = {batch->invW[0][lane], batch->invW[1][lane], batch->invW[2][lane]};
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
        return clamp(batch->z0[lane] + w.linear1 * batch->dz1[lane] + w.linear2 * batch->dz2[lane], nearest, farthest);
    }

    // Clip-space w at the pixels.
    Float clipW(const BlockWeights& w) const { return batch->doubledArea[lane] * w.inverseSum * batch->scale[lane]; }

    float nearest = 0, farthest = 0;  // the corners' depths, within 0 ... 1

private:
    // E at the pixels of a block: an exact integer either way, then rounded once.
    Float edgeValue(int k, int x, int y) const
    {
        if (small) {
            const auto stepX = static_cast<std::uint32_t>(batch->stepX[k][lane]);
            const auto stepY = static_cast<std::uint32_t>(batch->stepY[k][lane]);
            const std::uint32_t steps = stepX * static_cast<std::uint32_t>(x) + stepY * static_cast<std::uint32_t>(y);
            return Float(smallLanes[k] + static_cast<std::int32_t>(steps));
        }
        const std::int64_t steps =
            static_cast<std::int64_t>(edge[k].stepX) * x + static_cast<std::int64_t>(edge[k].stepY) * y;
        const std::int64_t corner = edge[k].origin + steps * kSubpixels;
        return toFloat(largeLanes[k] + Double(static_cast<double>(corner)));
    }

    const TriangleBatch* batch = nullptr;
    int lane = 0;
    bool small = false;
    Int smallLanes[3] = {0, 0, 0};           // E at the pixels of the block at (0, 0), modulo 2^32; of small triangles
    EdgeFunction edge[3] = {};               // of the others,
    Double largeLanes[3] = {0.0, 0.0, 0.0};  // and what to add to E at a block's upper left pixel
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

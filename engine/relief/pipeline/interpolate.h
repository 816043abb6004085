// Interpolation: from a triangle's three corners to every pixel of a block. The weights come from the exact integer
// edge values, rounded once to float, so they are good to the last bits for slivers, huge triangles and triangles far
// from the origin alike, and do not depend on tile or block.
//
//     b_k = E_k / area                     linear on screen: depth, and what is declared noperspective
//     p_k = E_k / w_k / sum(E_j / w_j)     linear in space: everything else
#pragma once

#include "relief/bits.h"
#include "relief/hlsl/semantics.h"
#include "relief/lanes/double.h"
#include "relief/pipeline/edge_function.h"
#include "relief/pipeline/triangle_batch.h"

namespace relief::inline RELIEF_WIDTH {

// One number for all lanes, as it is read fastest: SSE2 has no instruction that spreads a number while it is loaded.
using Broadcast = std::conditional_t<kLanes == 4, Float, float>;

// A triangle's edge functions at the pixels of a block: exact integers, rounded to float once. The three add up to
// twice the triangle's area, so that two are followed over the pixels and the other one is the rest.
class TriangleEdges
{
public:
    // At the pixels' centres, or at one of their samples. The batch must live as long.
    void set(const TriangleBatch& batch, int lane, SamplePattern::Position sample = {0, 0})
    {
        small = (batch.small >> lane & 1u) != 0;
        if (small) {
            smallSum = batch.sum[lane];
            for (int k = 1; k < 3; ++k) {
                stepX[k] = batch.stepX[k][lane];
                stepY[k] = batch.stepY[k][lane];
                smallLanes[k] = laneXs() * stepX[k] + laneYs() * stepY[k] + batch.origin[k][lane] +
                                ((stepX[k] >> kSubpixelBits) * sample.x + (stepY[k] >> kSubpixelBits) * sample.y);
            }
            return;
        }
        const Triangle& triangle = *batch.triangle[lane];
        largeSum = static_cast<double>(edgeOf(triangle, 0).at(sample));
        for (int k = 1; k < 3; ++k) {
            const EdgeFunction edge = edgeOf(triangle, k);
            // stepX * 3 + stepY * 3 stays below 2^27; times 256 it needs the double.
            const Int steps = laneXs() * edge.stepX + laneYs() * edge.stepY;
            const auto origin = static_cast<double>(edge.at(sample));
            largeLanes[k] = Double(steps) * Double(kSubpixels) + Double(origin);
            largeStepX[k] = static_cast<double>(edge.stepX) * kSubpixels;
            largeStepY[k] = static_cast<double>(edge.stepY) * kSubpixels;
            largeSum += origin;
        }
    }

    // Of the block whose upper left pixel is (x, y).
    void at(int x, int y, Float (&edge)[3]) const
    {
        if (small) {
            const auto value = [&](int k) {
                const std::uint32_t steps = static_cast<std::uint32_t>(stepX[k]) * static_cast<std::uint32_t>(x) +
                                            static_cast<std::uint32_t>(stepY[k]) * static_cast<std::uint32_t>(y);
                return smallLanes[k] + static_cast<std::int32_t>(steps);
            };
            const Int edge1 = value(1), edge2 = value(2);
            edge[0] = Float(smallSum - edge1 - edge2);
            edge[1] = Float(edge1);
            edge[2] = Float(edge2);
        } else {
            const auto value = [&](int k) { return largeLanes[k] + Double(largeStepX[k] * x + largeStepY[k] * y); };
            const Double edge1 = value(1), edge2 = value(2);
            edge[0] = toFloat(Double(largeSum) - edge1 - edge2);
            edge[1] = toFloat(edge1);
            edge[2] = toFloat(edge2);
        }
    }

private:
    bool small;

    // E_1 and E_2 at the pixels of the block at (0, 0), their steps from one pixel to the next, and the sum of all
    // three: modulo 2^32 where the triangle is small, or exact in doubles.
    Int smallLanes[3];
    std::int32_t stepX[3], stepY[3], smallSum;
    Double largeLanes[3];
    double largeStepX[3], largeStepY[3], largeSum;
};

// The pixels of a block. In one that quads of several triangles share, each is in its own triangle.
struct BlockPixels
{
    Float edge[3];      // the edge functions at their centres
    Float centroid[3];  // and at their centroids: the centres, where a pixel has one sample
    Int x, y;           // on the target
    unsigned covered;   // the lanes whose pixels' centres are in the triangle
};

// What follows from the edge values of one block.
struct BlockWeights
{
    Float linear1, linear2;            // b_1, b_2
    Float perspective1, perspective2;  // p_1, p_2
    Float inverseSum;                  // 1 / sum(E_j / w_j), w scaled by TriangleBatch::scale
};

// The depth of a triangle of a batch, which is linear on screen. `Constant`: Float, where many blocks are asked for, or
// Broadcast.
template <class Constant>
struct DepthPlane
{
    Constant inverseArea, z0, dz1, dz2;  // the batch's
    Constant nearest, farthest;          // the corners' depths, within 0 ... 1

    void set(const TriangleBatch& batch, int lane)
    {
        inverseArea = batch.inverseArea[lane];
        z0 = batch.z0[lane];
        dz1 = batch.dz1[lane];
        dz2 = batch.dz2[lane];
        nearest = batch.nearest[lane];
        farthest = batch.farthest[lane];
    }
    Float at(Float edge1, Float edge2) const { return z0 + edge1 * inverseArea * dz1 + edge2 * inverseArea * dz2; }

    // What is tested and stored is never outside 0 ... 1 and the corners' range, so that coarse depth bounds are safe.
    Float stored(Float edge1, Float edge2) const { return clamp(at(edge1, edge2), nearest, farthest); }
};

// How much of each corner a pixel has. Of one triangle of a batch, which must live as long.
class TriangleWeights
{
public:
    void set(const TriangleBatch& triangles, int triangle)
    {
        batch = &triangles;
        lane = triangle;
        nearest = batch->nearest[lane];
        farthest = batch->farthest[lane];
        plane.set(triangles, triangle);
        for (int k = 0; k < 3; ++k) invW[k] = batch->invW[k][lane];
    }

    // Of a block with these edge values. `covered` lanes lie in the triangle. What is not read, the compiler leaves
    // out.
    BlockWeights of(const Float (&edge)[3], unsigned covered) const
    {
        BlockWeights w;
        w.linear1 = edge[1] * plane.inverseArea;
        w.linear2 = edge[2] * plane.inverseArea;

        Float e[3] = {edge[0], edge[1], edge[2]};
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

    Float depth(Float edge1, Float edge2) const { return plane.stored(edge1, edge2); }

    // SV_POSITION.z: the depth that is stored, where the triangle covers the pixel; beyond it the plane goes on, and
    // with it the difference between the neighbours.
    Float positionZ(const Float (&edge)[3], unsigned covered) const
    {
        const Float stored = plane.stored(edge[1], edge[2]);
        return covered == kAllLanes ? stored : select(Mask::fromBits(covered), stored, plane.at(edge[1], edge[2]));
    }

    // Clip-space w at the pixels.
    Float clipW(const BlockWeights& w) const { return batch->doubledArea[lane] * w.inverseSum * batch->scale[lane]; }

    float nearest, farthest;  // the corners' depths, within 0 ... 1

private:
    const TriangleBatch* batch;
    int lane;
    DepthPlane<Broadcast> plane;
    Broadcast invW[3];  // the batch's, of this triangle
};

// A word in all lanes as it is: it may be an integer whose bits are a signalling NaN's.
template <class T = Broadcast>
T broadcastBits(float word)
{
    if constexpr (std::is_same_v<T, float>) {
        return word;
    } else {
        return asFloat(Int(bitCast<std::int32_t>(word)));
    }
}

// The components of a triangle's corners, ready to be weighted.
template <int components>
struct CornerComponents
{
    static constexpr int kCount = components;
    Broadcast first[components + 1], toSecond[components + 1], toThird[components + 1];  // + 1: there may be none

    void set(const float* a, const float* b, const float* c)
    {
        for (int i = 0; i < components; ++i) {
            first[i] = broadcastBits(a[i]);
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
    Float flat(int i) const
    {
        if constexpr (kLanes == 4) {
            return first[i];
        } else {
            return broadcastBits<Float>(first[i]);
        }
    }
};

// One component by itself, as interpolate() makes it; `weights` are the centroids' where that is how.
inline Float interpolated(Interpolation how, float a, float b, float c, const BlockWeights& weights)
{
    CornerComponents<1> corners;
    corners.set(&a, &b, &c);
    return how == Interpolation::flat     ? corners.flat(0)
           : how == Interpolation::affine ? corners.affine(0, weights)
                                          : corners.perspective(0, weights);
}

// Fills in a fragment program's input. What the program does not read, the compiler leaves out. `isFront`: whether the
// triangle is seen from its front.
template <class Interpolators, int components>
Interpolators interpolate(const TriangleWeights& triangle, const CornerComponents<components>& corners, bool isFront,
                          const BlockPixels& pixels)
{
    const BlockWeights w = triangle.of(pixels.edge, pixels.covered);
    BlockWeights atCentroid;
    if constexpr (usesCentroid(FieldsOf<Interpolators>{})) atCentroid = triangle.of(pixels.centroid, pixels.covered);
    Interpolators result;
    int slot = 0;
    forEachField(result, [&]<class Field>(Field& field) {
        if constexpr (Field::kIsPosition) {
            field.x = Float(pixels.x) + 0.5f;
            field.y = Float(pixels.y) + 0.5f;
            field.z = triangle.positionZ(pixels.edge, pixels.covered);
            field.w = triangle.clipW(w);
        } else if constexpr (Field::kSystemValue == SystemValue::facing) {
            field = Field(Mask(isFront));
        } else {
            for (int c = 0; c < kComponents<typename Field::Value>; ++c, ++slot) {
                constexpr Interpolation how = Field::kInterpolation;
                const Float value = how == Interpolation::perspective ? corners.perspective(slot, w)
                                    : how == Interpolation::affine    ? corners.affine(slot, w)
                                    : how == Interpolation::centroid  ? corners.perspective(slot, atCentroid)
                                                                      : corners.flat(slot);
                setWord(component(static_cast<typename Field::Value&>(field), c), value);
            }
        }
    });
    return result;
}

}  // namespace relief::inline RELIEF_WIDTH

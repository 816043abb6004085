// Clipping in homogeneous clip space, for the few triangles that need it: those that cross the near or the far plane,
// or reach beyond the guard band. All others keep their vertices and are cut off by their pixels alone.
#pragma once

#include <array>
#include <span>

#include "relief/pipeline/geometry.h"

namespace relief::inline RELIEF_WIDTH {

struct ClipVertex
{
    glm::vec4 position;  // clip space
    float weight[3];     // this vertex = sum of weight[k] * the triangle's corner k
    double onScreen[3];  // the same after the division by w: the weights of what is linear on the screen
};

struct ClipLimits
{
    float inverseGuardX, inverseGuardY;  // see viewport_transform.h
    bool depthClip;
    float distance[kMaxClipDistances][3] = {};  // the corners' to each plane of the vertex program's own
    int distanceCount = 0;
};

// Those of a draw, for a triangle with these corners.
ClipLimits clipLimits(const DrawGeometry& draw, const std::array<std::uint32_t, 3>& corners);

// A corner more for each plane. Corners are rounded: planes of the program's own that all but coincide can each cut off
// several of them, and what is more than this is left out.
inline constexpr int kMaxClippedVertices = 3 + 7 + kMaxClipDistances;

// Cuts a triangle at w >= kSmallestW, the near and far plane, the guard band's four sides and the program's own planes.
// The result is a convex polygon in the triangle's order: its vertex count, 0 if nothing is left. A point on a plane is
// inside. The new vertex on an edge is computed from the inside end to the outside end, whichever triangle asks:
// neighbours get the same bits.
int clipTriangle(const glm::vec4 corners[3], const ClipLimits& limits, std::span<ClipVertex, kMaxClippedVertices> out);

// Cuts a line at the same planes, with the same arithmetic. The result is its two ends, in order, with weights of the
// first two corners only; false if nothing is left.
bool clipLine(const glm::vec4 ends[2], const ClipLimits& limits, ClipVertex out[2]);

// A new vertex's number, with components between those of the corners: in space, on the screen, or the first corner's.
// Equal values stay what they are, to the bit, and neighbours that share an edge get the same.
std::uint32_t clippedVertex(const DrawGeometry& draw, const std::array<std::uint32_t, 3>& corners,
                            const ClipVertex& vertex, TriangleChunk& chunk);

}  // namespace relief::inline RELIEF_WIDTH

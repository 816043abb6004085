// Clipping in homogeneous clip space, for the few triangles that need it: those that cross the near or the far plane,
// or reach beyond the guard band. All others keep their vertices and are cut off by their pixels alone.
#pragma once

#include <span>

#include <glm/vec4.hpp>

namespace relief {

struct ClipVertex
{
    glm::vec4 position;  // clip space
    float weight[3];     // this vertex = sum of weight[k] * the triangle's corner k
};

struct ClipLimits
{
    float inverseGuardX, inverseGuardY;  // see viewport_transform.h
    bool depthClip;
};

inline constexpr int kMaxClippedVertices = 3 + 7;  // a corner more for each plane

// Cuts a triangle at w >= kSmallestW, the near and far plane and the guard band's four sides. The result is a convex
// polygon in the triangle's order: its vertex count, 0 if nothing is left. A point on a plane is inside. The new vertex
// on an edge is computed from the inside end to the outside end, whichever triangle asks: neighbours get the same bits.
int clipTriangle(const glm::vec4 corners[3], const ClipLimits& limits, std::span<ClipVertex, kMaxClippedVertices> out);

// Cuts a line at the same planes, with the same arithmetic. The result is its two ends, in order, with weights of the
// first two corners only; false if nothing is left.
bool clipLine(const glm::vec4 ends[2], const ClipLimits& limits, ClipVertex out[2]);

}  // namespace relief

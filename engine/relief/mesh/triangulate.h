// Cuts a polygon of a mesh file into triangles, by ear clipping. Why not a fan: concave polygons are common in OBJ
// files (letters, floor plans), and a fan covers what lies outside of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relief {

// Returns corners.size() - 2 triangles of corner numbers, wound like the polygon; none for fewer than three corners. A
// convex polygon gives the fan around corner 0. The corners should be finite and lie about in a plane; a polygon that
// crosses itself or has no area still gives as many triangles, though not a sensible picture. Takes time that grows
// with the square of the number of corners, and with its cube at worst.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::vec3> corners);

}  // namespace relief

// The tangent space that a normal map is decoded in, at any point of a triangle: what the shader interpolates
// (shading/tangent_space.h), in double. Object space. In: a mesh with tangents, and barycentric weights.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "relief/mesh/mesh.h"

namespace relief {

// Where the binormal is computed: for each vertex, then interpolated; or for each fragment, from the interpolated
// normal and tangent. Both are in use, and give different directions between the vertices (Rendering 6, 4.4).
enum class BinormalAt
{
    vertex,
    fragment
};

// The directions that x, y and z of a normal map's vector stand for. Neither of unit length nor at right angles.
struct TangentFrame
{
    glm::dvec3 tangent{0}, binormal{0}, normal{0};
};

// One vertex, as a vertex program hands it on: normal and tangent of unit length, or zero.
struct FrameCorner
{
    glm::dvec3 position{0};
    TangentFrame frame;
    double sign = 1;
};

// Zero stays zero, and so does what is not finite.
inline glm::dvec3 unitOrZero(const glm::dvec3& v)
{
    const double length = std::sqrt(glm::dot(v, v));
    return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0);
}

// The three corners of a triangle. The mesh must be valid and have tangents.
inline std::array<FrameCorner, 3> frameCorners(const Mesh& mesh, std::size_t triangle)
{
    std::array<FrameCorner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t vertex = mesh.indices[3 * triangle + k];
        FrameCorner& corner = corners[k];
        corner.position = mesh.positions[vertex];
        corner.sign = mesh.tangents[vertex].w < 0.0f ? -1.0 : 1.0;
        corner.frame.normal = unitOrZero(mesh.normals[vertex]);
        corner.frame.tangent = unitOrZero(glm::vec3(mesh.tangents[vertex]));
        corner.frame.binormal = glm::cross(corner.frame.normal, corner.frame.tangent) * corner.sign;
    }
    return corners;
}

// MikkTSpace's frame: interpolated, and not made unit again.
inline TangentFrame frameAt(const std::array<FrameCorner, 3>& corners, const std::array<double, 3>& weights,
                            BinormalAt binormalAt)
{
    TangentFrame sum;
    double sign = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        sum.tangent += weights[k] * corners[k].frame.tangent;
        sum.binormal += weights[k] * corners[k].frame.binormal;
        sum.normal += weights[k] * corners[k].frame.normal;
        sign += weights[k] * corners[k].sign;
    }
    if (binormalAt == BinormalAt::fragment)
        sum.binormal = glm::cross(sum.normal, sum.tangent) * (sign < 0 ? -1.0 : 1.0);
    return sum;
}

// Three unit vectors at right angles: what a shader has that cleans its frame up in every fragment. The normal keeps
// its direction, and the binormal the side that it is on.
inline TangentFrame orthonormal(const TangentFrame& frame)
{
    TangentFrame result;
    result.normal = unitOrZero(frame.normal);
    result.tangent = unitOrZero(frame.tangent - result.normal * glm::dot(result.normal, frame.tangent));
    const glm::dvec3 binormal = glm::cross(result.normal, result.tangent);
    result.binormal = glm::dot(binormal, frame.binormal) < 0 ? -binormal : binormal;
    return result;
}

// From tangent space to the space of the frame, of unit length; the frame's own normal where the sum is zero.
inline glm::dvec3 decoded(const glm::dvec3& v, const TangentFrame& frame)
{
    const glm::dvec3 sum = unitOrZero(v.x * frame.tangent + v.y * frame.binormal + v.z * frame.normal);
    return sum == glm::dvec3(0) ? unitOrZero(frame.normal) : sum;
}

// The unit vector v for which decoded(v, frame) is `direction`: the rows of the inverse are the cross products of the
// frame's vectors, divided by their determinant, of which the sign alone matters (mikktspace.h). (0, 0, 1) if the frame
// is flat, or the direction zero.
inline glm::dvec3 encoded(const glm::dvec3& direction, const TangentFrame& frame)
{
    const glm::dvec3 alongX = glm::cross(frame.binormal, frame.normal);
    const glm::dvec3 alongY = glm::cross(frame.normal, frame.tangent);
    const glm::dvec3 alongZ = glm::cross(frame.tangent, frame.binormal);
    const double determinant = glm::dot(frame.tangent, alongX);
    const double size = std::sqrt(glm::dot(frame.tangent, frame.tangent) * glm::dot(frame.binormal, frame.binormal) *
                                  glm::dot(frame.normal, frame.normal));
    constexpr double kFlat = 1e-9;  // of the volume that right angles would give
    if (!(std::fabs(determinant) > kFlat * size)) return {0, 0, 1};
    const glm::dvec3 sides(glm::dot(direction, alongX), glm::dot(direction, alongY), glm::dot(direction, alongZ));
    const glm::dvec3 unit = unitOrZero(determinant < 0 ? -sides : sides);
    return unit == glm::dvec3(0) ? glm::dvec3(0, 0, 1) : unit;
}

}  // namespace relief

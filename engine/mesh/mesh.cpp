// What makes a mesh safe to draw, and normals for meshes that come without.
#include "mesh/mesh.h"

#include <cmath>
#include <cstddef>
#include <span>

#include <glm/geometric.hpp>

#include "lanes/environment.h"

namespace relief {
namespace {

Expected<void> checkLength(const Mesh& mesh, const char* what, std::size_t length, bool optional)
{
    const std::size_t expected = mesh.positions.size();
    if (length == expected || (optional && length == 0)) return {};
    return fail("mesh '" + mesh.name + "': " + std::to_string(length) + " " + what + " for " +
                std::to_string(expected) + " positions; give every vertex one" + (optional ? " or none at all" : ""));
}

template <class Vector>
Expected<void> checkFinite(const Mesh& mesh, const char* what, std::span<const Vector> vectors)
{
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (int axis = 0; axis < Vector::length(); ++axis) {
            if (std::isfinite(vectors[i][axis])) continue;
            return fail("mesh '" + mesh.name + "': the " + what + " of vertex " + std::to_string(i) +
                        " is not finite; repair or rescale the mesh");
        }
    }
    return {};
}

Expected<void> checkIndices(const Mesh& mesh)
{
    if (mesh.indices.size() % 3 != 0) {
        return fail("mesh '" + mesh.name + "': " + std::to_string(mesh.indices.size()) +
                    " indices are no whole number of triangles; give three per triangle");
    }
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        if (mesh.indices[i] < mesh.positions.size()) continue;
        return fail("mesh '" + mesh.name + "': triangle " + std::to_string(i / 3) + " uses vertex " +
                    std::to_string(mesh.indices[i]) + " of " + std::to_string(mesh.positions.size()) +
                    "; vertices are counted from 0");
    }
    return {};
}

}  // namespace

Expected<void> validate(const Mesh& mesh)
{
    return checkLength(mesh, "normals", mesh.normals.size(), false)
        .and_then([&] { return checkLength(mesh, "uvs", mesh.uvs.size(), true); })
        .and_then([&] { return checkLength(mesh, "tangents", mesh.tangents.size(), true); })
        .and_then([&] { return checkLength(mesh, "colours", mesh.colors.size(), true); })
        .and_then([&] { return checkIndices(mesh); })
        .and_then([&] { return checkFinite<glm::vec3>(mesh, "position", mesh.positions); })
        .and_then([&] { return checkFinite<glm::vec3>(mesh, "normal", mesh.normals); })
        .and_then([&] { return checkFinite<glm::vec2>(mesh, "uv", mesh.uvs); })
        .and_then([&] { return checkFinite<glm::vec4>(mesh, "tangent", mesh.tangents); })
        .and_then([&] { return checkFinite<glm::vec4>(mesh, "colour", mesh.colors); });
}

void computeNormals(Mesh& mesh)
{
    const DefaultFloatingPoint environment;
    // In double, no finite float position is so large or so small that a cross product or its square leaves the range.
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t corners[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        const glm::dvec3 a = mesh.positions[corners[0]];
        const glm::dvec3 b = mesh.positions[corners[1]];
        const glm::dvec3 c = mesh.positions[corners[2]];
        const glm::dvec3 twiceArea = glm::cross(b - a, c - a);  // its length is twice the triangle's area
        for (const std::uint32_t corner : corners) sums[corner] += twiceArea;
    }
    mesh.normals.resize(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double length = std::sqrt(glm::dot(sums[i], sums[i]));
        mesh.normals[i] = length > 0 ? glm::vec3(sums[i] / length) : glm::vec3(0, 1, 0);
    }
}

Mesh withMirroredUv(Mesh mesh)
{
    const DefaultFloatingPoint environment;
    for (glm::vec2& uv : mesh.uvs) uv.x = 1.0f - uv.x;
    for (glm::vec4& tangent : mesh.tangents) tangent = -tangent;
    return mesh;
}

}  // namespace relief

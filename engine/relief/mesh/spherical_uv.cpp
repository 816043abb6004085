// Spherical texture coordinates: each vertex by itself first, then triangle by triangle what a seam and two poles ask.
#include "relief/mesh/spherical_uv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "relief/lanes/environment.h"
#include "relief/lanes/math.h"
#include "relief/mesh/bounds.h"
#include "relief/mesh/weld.h"

namespace relief {
namespace {

constexpr float kPi = 3.14159265f;

struct Spherical
{
    glm::vec2 uv;  // u in 0..1
    bool onAxis;   // where u means nothing
};

// `fromCentre` in double, where no difference of two floats leaves the range.
Spherical sphericalOf(glm::dvec3 fromCentre)
{
    // The largest coordinate becomes 1: the angles stay, and squares neither overflow nor vanish.
    const double size = std::max({std::fabs(fromCentre.x), std::fabs(fromCentre.y), std::fabs(fromCentre.z)});
    if (size == 0) return {{0.5f, 0.5f}, true};
    const glm::vec3 direction(fromCentre / size);
    const float radius = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const float v = std::min(atan2(radius, -direction.y) / kPi, 1.0f);
    if (radius == 0) return {{0.5f, v}, true};
    const float turns = atan2(-direction.x, direction.z) / (2.0f * kPi);  // -0.5..0.5, 0 at +Z
    return {{std::min(turns < 0 ? turns + 1.0f : turns, 1.0f), v}, false};
}

// The uvs of a triangle's corners, next to each other where the picture lets them be.
std::array<glm::vec2, 3> joined(const std::array<Spherical, 3>& corners)
{
    float largest = 0;
    for (const Spherical& corner : corners) {
        if (!corner.onAxis) largest = std::max(largest, corner.uv.x);
    }
    std::array<glm::vec2, 3> uvs{};
    float sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        uvs[i] = corners[i].uv;
        if (corners[i].onAxis) continue;
        if (largest - uvs[i].x > 0.5f) uvs[i].x += 1.0f;
        sum += uvs[i].x;
        ++count;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (corners[i].onAxis && count > 0) uvs[i].x = sum / static_cast<float>(count);
    }
    return uvs;
}

}  // namespace

Expected<Mesh> withSphericalUvs(Mesh mesh)
{
    const DefaultFloatingPoint environment;
    mesh.uvs.clear();
    mesh.tangents.clear();
    if (const Expected<void> valid = validate(mesh); !valid) return tl::unexpected(valid.error());
    if (mesh.positions.empty()) return mesh;

    const Bounds bounds = boundsOf(mesh);
    const glm::dvec3 centre = 0.5 * (glm::dvec3(bounds.low) + glm::dvec3(bounds.high));
    std::vector<Spherical> vertices;
    vertices.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions) {
        vertices.push_back(sphericalOf(glm::dvec3(position) - centre));
        mesh.uvs.push_back(vertices.back().uv);
    }

    std::vector<glm::vec2> uvs;
    uvs.reserve(mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return vertices[mesh.indices[i + k]]; };
        const std::array<glm::vec2, 3> triangle = joined({corner(0), corner(1), corner(2)});
        uvs.insert(uvs.end(), triangle.begin(), triangle.end());
    }
    setPerCorner(mesh, &Mesh::uvs, uvs);
    return mesh;
}

}  // namespace relief

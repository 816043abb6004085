// Displacement: weld by position, move, and take normals from the welded surface.
#include "relief/mesh/displace.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "relief/lanes/environment.h"
#include "relief/mesh/weld.h"

namespace relief {
namespace {

// For each vertex the first at the same position.
std::vector<std::uint32_t> firstAtPosition(const Mesh& mesh)
{
    std::vector<std::array<std::uint32_t, 3>> records;
    records.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) records.push_back({weldWord(p.x), weldWord(p.y), weldWord(p.z)});
    return firstEqual(records);
}

// What the vertices at one position have in common, in the order of the vertices.
struct Place
{
    glm::dvec3 normal{0};
    double height = 0;
    int vertices = 0;
};

}  // namespace

Expected<Mesh> displaced(Mesh base, const std::function<float(float u, float v)>& heights, float amount)
{
    const DefaultFloatingPoint environment;
    if (const Expected<void> valid = validate(base); !valid) return tl::unexpected(valid.error());
    if (base.uvs.empty() && !base.positions.empty()) {
        return fail("mesh '" + base.name + "': displacement needs uvs; give every vertex one (withSphericalUvs)");
    }
    const std::vector<std::uint32_t> first = firstAtPosition(base);
    std::vector<Place> places(first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        Place& place = places[first[i]];
        place.normal += glm::dvec3(base.normals[i]);
        place.height += static_cast<double>(heights(base.uvs[i].x, base.uvs[i].y));
        ++place.vertices;
    }
    Mesh moved = std::move(base);
    moved.tangents.clear();
    for (std::size_t i = 0; i < first.size(); ++i) {
        const Place& place = places[first[i]];
        const double length = std::sqrt(glm::dot(place.normal, place.normal));
        const double distance = static_cast<double>(amount) * place.height / place.vertices;
        glm::dvec3 position(moved.positions[i]);
        if (length > 0) position += place.normal * (distance / length);
        moved.positions[i] = glm::vec3(position);
        for (int axis = 0; axis < 3; ++axis) {
            if (std::isfinite(moved.positions[i][axis])) continue;
            return fail("mesh '" + moved.name + "': displacement moves vertex " + std::to_string(i) +
                        " out of the floats; give finite heights and a smaller amount");
        }
    }

    // Every triangle uses the first vertex at each position, so that all around it count.
    std::vector<std::uint32_t> indices = moved.indices;
    for (std::uint32_t& index : moved.indices) index = first[index];
    computeNormals(moved);
    moved.indices = std::move(indices);
    for (std::size_t i = 0; i < first.size(); ++i) moved.normals[i] = moved.normals[first[i]];
    return moved;
}

}  // namespace relief

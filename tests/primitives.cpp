// Primitives: conventions (winding, uv, tangents), closed surfaces, finite numbers for every count, the same bits
// always.
#include "relief/mesh/primitives.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace relief;

namespace {

using Point = std::array<float, 3>;

Point toPoint(glm::vec3 v)
{
    return {v.x, v.y, v.z};
}

std::uint64_t hashOf(const Mesh& mesh)
{
    std::uint64_t hash = 14695981039346656037u;
    const auto add = [&](std::uint32_t value) { hash = (hash ^ value) * 1099511628211u; };
    const auto addVectors = [&](const auto& vectors) {
        for (const auto& vector : vectors) {
            for (int axis = 0; axis < vector.length(); ++axis) add(std::bit_cast<std::uint32_t>(vector[axis]));
        }
    };
    addVectors(mesh.positions);
    addVectors(mesh.normals);
    addVectors(mesh.uvs);
    addVectors(mesh.tangents);
    for (const std::uint32_t index : mesh.indices) add(index);
    return hash;
}

// Lengths, unit vectors, right angles, triangles that face where their normals point, pictures that are not mirrored.
void checkMesh(const Mesh& mesh)
{
    const Expected<void> valid = validate(mesh);
    REQUIRE_MESSAGE(valid.has_value(), valid.error().message);
    REQUIRE(mesh.uvs.size() == mesh.positions.size());
    REQUIRE(mesh.tangents.size() == mesh.positions.size());
    int badLengths = 0;
    int badAngles = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 normal = mesh.normals[i];
        const glm::vec3 tangent(mesh.tangents[i]);
        badLengths += std::fabs(glm::length(normal) - 1.0f) > 1e-6f || std::fabs(glm::length(tangent) - 1.0f) > 1e-6f;
        badAngles += std::fabs(glm::dot(normal, tangent)) > 1e-6f || mesh.tangents[i].w != -1.0f;
        badAngles += mesh.uvs[i].x < 0 || mesh.uvs[i].x > 1 || mesh.uvs[i].y < 0 || mesh.uvs[i].y > 1;
    }
    CHECK(badLengths == 0);
    CHECK(badAngles == 0);

    int backFaces = 0;
    int badTangents = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i];
        const std::uint32_t b = mesh.indices[i + 1];
        const std::uint32_t c = mesh.indices[i + 2];
        const glm::vec3 ab = mesh.positions[b] - mesh.positions[a];
        const glm::vec3 ac = mesh.positions[c] - mesh.positions[a];
        const glm::vec3 front = glm::cross(ab, ac);
        for (const std::uint32_t corner : {a, b, c}) backFaces += glm::dot(front, mesh.normals[corner]) <= 0;

        // The direction in which u and v grow on the triangle, from the two edges' uv differences.
        const glm::vec2 uvAb = mesh.uvs[b] - mesh.uvs[a];
        const glm::vec2 uvAc = mesh.uvs[c] - mesh.uvs[a];
        const float determinant = uvAb.x * uvAc.y - uvAb.y * uvAc.x;
        const glm::vec3 alongU = (ab * uvAc.y - ac * uvAb.y) / determinant;
        const glm::vec3 alongV = (ac * uvAb.x - ab * uvAc.x) / determinant;
        const glm::vec3 tangent(mesh.tangents[a]);
        const glm::vec3 binormal = glm::cross(mesh.normals[a], tangent) * mesh.tangents[a].w;
        badTangents += glm::dot(tangent, alongU) <= 0 || glm::dot(binormal, alongV) <= 0;
    }
    CHECK(backFaces == 0);
    CHECK(badTangents == 0);
}

// Every edge, by position and direction, is used once, and once the other way round.
bool isClosed(const Mesh& mesh)
{
    std::map<std::pair<Point, Point>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Point from = toPoint(mesh.positions[mesh.indices[i + corner]]);
            const Point to = toPoint(mesh.positions[mesh.indices[i + (corner + 1) % 3]]);
            if (from == to || ++edges[{from, to}] > 1) return false;
        }
    }
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        return edges.count({edge.first.second, edge.first.first}) == 1;
    });
}

}  // namespace

TEST_CASE("primitives: the quad is Unity's")
{
    const Mesh quad = makeQuad();
    checkMesh(quad);
    REQUIRE(quad.positions.size() == 4);
    CHECK(quad.indices == std::vector<std::uint32_t>{0, 3, 1, 3, 0, 2});
    CHECK(quad.positions[0] == glm::vec3(-0.5f, -0.5f, 0));
    CHECK(quad.positions[3] == glm::vec3(0.5f, 0.5f, 0));
    CHECK(quad.uvs[0] == glm::vec2(0, 0));
    CHECK(quad.uvs[1] == glm::vec2(1, 0));
    CHECK(quad.uvs[2] == glm::vec2(0, 1));
    CHECK(quad.normals[2] == glm::vec3(0, 0, -1));
    CHECK(quad.tangents[2] == glm::vec4(1, 0, 0, -1));
}

TEST_CASE("primitives: the grid is the quad in cells")
{
    const Mesh quad = makeQuad(), one = makeGrid(1, 1), grid = makeGrid(4, 3);
    CHECK(one.positions == quad.positions);
    CHECK(one.uvs == quad.uvs);
    CHECK(one.tangents == quad.tangents);
    CHECK(one.indices == quad.indices);
    checkMesh(grid);
    CHECK(grid.positions.size() == 5 * 4);
    CHECK(grid.indices.size() == 4 * 3 * 6);
    for (std::size_t i = 0; i < grid.positions.size(); ++i) {
        CHECK(grid.positions[i] == glm::vec3(grid.uvs[i].x - 0.5f, grid.uvs[i].y - 0.5f, 0.0f));
        CHECK(grid.normals[i] == glm::vec3(0, 0, -1));
    }
    CHECK(grid.uvs[7] == glm::vec2(0.5f, 1.0f / 3.0f));
    CHECK(hashOf(makeGrid(0, -3)) == hashOf(makeGrid(1, 1)));
}

TEST_CASE("primitives: the cube has six upright faces and is closed")
{
    const Mesh cube = makeCube();
    checkMesh(cube);
    CHECK(cube.positions.size() == 24);
    CHECK(cube.indices.size() == 36);
    CHECK(isClosed(cube));
    std::set<Point> normals;
    for (std::size_t i = 0; i < cube.positions.size(); ++i) {
        normals.insert(toPoint(cube.normals[i]));
        CHECK(glm::dot(cube.positions[i], cube.normals[i]) == 0.5f);
        CHECK(std::fabs(cube.positions[i].x * cube.positions[i].y * cube.positions[i].z) == 0.125f);
        const glm::vec3 binormal = glm::cross(cube.normals[i], glm::vec3(cube.tangents[i])) * cube.tangents[i].w;
        const bool isSide = cube.normals[i].y == 0;
        if (isSide) CHECK(binormal == glm::vec3(0, 1, 0));
        if (isSide) CHECK(cube.positions[i].y == cube.uvs[i].y - 0.5f);
    }
    CHECK(normals.size() == 6);
}

TEST_CASE("primitives: spheres are round, closed and wound outwards")
{
    for (const glm::ivec2 count : {glm::ivec2(3, 2), {4, 3}, {7, 5}, {32, 16}, {64, 48}}) {
        const int segments = count.x;
        const int rings = count.y;
        CAPTURE(segments);
        CAPTURE(rings);
        const Mesh sphere = makeSphere(segments, rings);
        checkMesh(sphere);
        CHECK(isClosed(sphere));
        CHECK(sphere.indices.size() == static_cast<std::size_t>(6 * segments * (rings - 1)));
        int bad = 0;
        for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
            bad += std::fabs(glm::length(sphere.positions[i]) - 0.5f) > 1e-6f;
            bad += sphere.positions[i] != sphere.normals[i] * 0.5f;
        }
        CHECK(bad == 0);
    }
    const Mesh sphere = makeSphere(4, 2);  // the middle of the picture faces -Z, u grows to the right
    CHECK(glm::distance(sphere.positions[4 + 2], glm::vec3(0, 0, -0.5f)) < 1e-6f);
    CHECK(glm::distance(sphere.positions[4 + 3], glm::vec3(0.5f, 0, 0)) < 1e-6f);
}

TEST_CASE("primitives: counts out of range are clamped, and every count gives finite numbers")
{
    for (const int count : {-5, 0, 1, 2, 3, 1023, 1024}) {
        CAPTURE(count);
        CHECK(validate(makeSphere(count, count)).has_value());
        CHECK(validate(makeSphere(count, 3)).has_value());
    }
    for (int segments = 1; segments <= 1024; ++segments) CHECK(validate(makeSphere(segments, 2)).has_value());
    CHECK(hashOf(makeSphere(-1, -1)) == hashOf(makeSphere(3, 2)));
    CHECK(makeSphere(1'000'000, 2).indices.size() == 6 * 1024);
    CHECK(hashOf(makeCubeSphere(0)) == hashOf(makeCubeSphere(1)));
    CHECK(hashOf(makeTerrain(0, -3)) == hashOf(makeTerrain(1, 1)));
}

TEST_CASE("primitives: the cube sphere is round and closed")
{
    for (const int subdivisions : {1, 2, 3, 8, 21}) {
        CAPTURE(subdivisions);
        const Mesh sphere = makeCubeSphere(subdivisions);
        checkMesh(sphere);
        CHECK(isClosed(sphere));
        CHECK(sphere.indices.size() == static_cast<std::size_t>(36 * subdivisions * subdivisions));
        for (const glm::vec3& position : sphere.positions) {
            CHECK(glm::length(position) == doctest::Approx(0.5f).epsilon(1e-6));
        }
    }
}

TEST_CASE("primitives: the terrain is a height field with the normals of its own slopes")
{
    const int cells = 512;
    const Mesh terrain = makeTerrain(cells, cells);
    checkMesh(terrain);
    REQUIRE(terrain.positions.size() == 513 * 513);
    float lowest = 1;
    float highest = -1;
    float worst = 0;
    for (int z = 0; z <= cells; ++z) {
        for (int x = 0; x <= cells; ++x) {
            const auto at = [&](int column, int row) {
                return terrain.positions[static_cast<std::size_t>(row * (cells + 1) + column)];
            };
            const glm::vec3 position = at(x, z);
            lowest = std::min(lowest, position.y);
            highest = std::max(highest, position.y);
            if (x == 0 || z == 0 || x == cells || z == cells) continue;
            const glm::vec3 alongX = at(x + 1, z) - at(x - 1, z);
            const glm::vec3 alongZ = at(x, z + 1) - at(x, z - 1);
            const glm::vec3 expected = glm::normalize(glm::cross(alongZ, alongX));
            worst = std::max(worst, glm::distance(expected, terrain.normals[static_cast<std::size_t>(z * 513 + x)]));
        }
    }
    CHECK(lowest > -0.1f);
    CHECK(lowest < -0.03f);
    CHECK(highest < 0.1f);
    CHECK(highest > 0.03f);
    CHECK(worst < 0.02f);
    CHECK(terrain.positions.front().x == -0.5f);
    CHECK(terrain.positions.back().z == 0.5f);
    CHECK(makeTerrain(3, 7).positions.size() == 4 * 8);
    CHECK(makeTerrain(3, 7).indices.size() == 6 * 3 * 7);
}

TEST_CASE("primitives: the same bits always")
{
    CHECK(hashOf(makeTerrain(64, 48)) == 878321749355309427u);
    CHECK(hashOf(makeSphere(24, 12)) == 5636363874992987409u);
    CHECK(hashOf(makeCubeSphere(7)) == 14406302218894948701u);
}

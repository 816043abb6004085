// Spherical uvs: makeSphere's own are found again; seams, poles and meshes without an inside.
#include "relief/mesh/spherical_uv.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>

#include "relief/mesh/primitives.h"

using namespace relief;

namespace {

// Points alone, and a triangle for every three.
Mesh pointsOf(std::vector<glm::vec3> points)
{
    Mesh mesh;
    mesh.positions = std::move(points);
    for (std::uint32_t i = 0; i + 2 < mesh.positions.size(); i += 3)
        mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + 2});
    computeNormals(mesh);
    return mesh;
}

float largestExtent(const Mesh& mesh)
{
    float largest = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const float a = mesh.uvs[mesh.indices[i]].x;
        const float b = mesh.uvs[mesh.indices[i + 1]].x;
        const float c = mesh.uvs[mesh.indices[i + 2]].x;
        largest = std::max(largest, std::max({a, b, c}) - std::min({a, b, c}));
    }
    return largest;
}

}  // namespace

TEST_CASE("spherical uv: a sphere gets back its own, seam and poles included")
{
    for (const int segments : {3, 8, 48, 101}) {
        CAPTURE(segments);
        const Mesh sphere = makeSphere(segments, 24);
        const Expected<Mesh> mesh = withSphericalUvs(sphere);
        REQUIRE(mesh.has_value());
        CHECK(mesh->indices == sphere.indices);
        CHECK(mesh->positions == sphere.positions);
        REQUIRE(mesh->uvs.size() == sphere.uvs.size());
        float largest = 0;
        for (std::size_t i = 0; i < sphere.uvs.size(); ++i) {
            const glm::vec2 difference = glm::abs(mesh->uvs[i] - sphere.uvs[i]);
            largest = std::max({largest, difference.x, difference.y});
        }
        // Odd numbers have no vertex at -Z: their box's centre is not the sphere's.
        if (segments % 2 == 0) CHECK(largest < 1e-6f);
        CHECK(mesh->tangents.empty());
    }
}

TEST_CASE("spherical uv: a sphere without seam or poles is split so that no triangle spans more than it should")
{
    Mesh sphere = makeSphere(48, 24);
    const std::size_t vertices = sphere.positions.size();
    // One vertex for each point: indices to the first at the same position.
    for (std::uint32_t& index : sphere.indices) {
        const auto first = std::find(sphere.positions.begin(), sphere.positions.end(), sphere.positions[index]);
        index = static_cast<std::uint32_t>(first - sphere.positions.begin());
    }
    const Expected<Mesh> mesh = withSphericalUvs(sphere);
    REQUIRE(mesh.has_value());
    CHECK(validate(*mesh).has_value());
    CHECK(largestExtent(*mesh) < 1.0f / 48 + 1e-6f);
    // A copy of each of the 23 points of the seam, and of each pole for every triangle but the first.
    CHECK(mesh->positions.size() == vertices + 23 + 2 * 47);
    for (std::size_t i = 0; i < sphere.indices.size(); ++i) {
        CHECK(mesh->positions[mesh->indices[i]] == sphere.positions[sphere.indices[i]]);
        CHECK(mesh->normals[mesh->indices[i]] == sphere.normals[sphere.indices[i]]);
    }
}

TEST_CASE("spherical uv: the middle of the picture faces -Z, u grows to the right, v up")
{
    const Expected<Mesh> mesh =
        withSphericalUvs(pointsOf({{0, 0, -2}, {2, 0, 0}, {0, 2, 0}, {-2, 0, 0}, {0, -2, 0}, {0, 0, 2}}));
    REQUIRE(mesh.has_value());
    CHECK(mesh->uvs[0] == glm::vec2(0.5f, 0.5f));
    CHECK(mesh->uvs[1] == glm::vec2(0.75f, 0.5f));
    CHECK(mesh->uvs[2] == glm::vec2(0.625f, 1.0f));  // a pole: the mean of its triangle
    CHECK(mesh->uvs[3] == glm::vec2(0.25f, 0.5f));
    CHECK(mesh->uvs[4] == glm::vec2(0.125f, 0.0f));
    CHECK(mesh->uvs[5] == glm::vec2(0.0f, 0.5f));
}

TEST_CASE("spherical uv: right of the seam u goes on beyond 1")
{
    const Expected<Mesh> mesh =
        withSphericalUvs(pointsOf({{-1, 0, 1}, {1, 0, 1}, {0, 1, 0}, {-1, 0, -1}, {1, 0, -1}, {0, -1, 0}}));
    REQUIRE(mesh.has_value());
    CHECK(mesh->uvs[0].x == doctest::Approx(1.125f));
    CHECK(mesh->uvs[1].x == doctest::Approx(0.875f));
    CHECK(mesh->uvs[2].x == doctest::Approx(1.0f));
}

TEST_CASE("spherical uv: size and place of the mesh do not matter")
{
    const Mesh cube = makeCube();
    const Expected<Mesh> expected = withSphericalUvs(cube);
    for (const float scale : {1e-38f, 1e-20f, 1e20f, 3e38f}) {
        CAPTURE(scale);
        Mesh mesh = cube;
        for (glm::vec3& position : mesh.positions) position *= scale;
        const Expected<Mesh> scaled = withSphericalUvs(mesh);
        REQUIRE(scaled.has_value());
        CHECK(scaled->uvs == expected->uvs);
    }
    Mesh mesh = cube;
    for (glm::vec3& position : mesh.positions) position += glm::vec3(64, -32, 16);
    CHECK(withSphericalUvs(mesh)->uvs == expected->uvs);
}

TEST_CASE("spherical uv: meshes without extent, without triangles and without points")
{
    CHECK(withSphericalUvs(Mesh{})->uvs.empty());
    CHECK(withSphericalUvs(pointsOf({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}))->uvs ==
          std::vector<glm::vec2>(3, {0.5f, 0.5f}));
    CHECK(withSphericalUvs(pointsOf({{0, 0, -1}, {0, 0, 1}}))->uvs == std::vector<glm::vec2>{{0.5f, 0.5f}, {0, 0.5f}});
    // A vertex in the centre takes the mean longitude, too.
    const Expected<Mesh> star =
        withSphericalUvs(pointsOf({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 0, 1}, {-1, 0, 0}, {0, 0, 0}}));
    CHECK(star->uvs[0] == glm::vec2(0.625f, 0.5f));
    // A triangle on the axis has no longitude at all.
    CHECK(withSphericalUvs(pointsOf({{0, 1, 0}, {0, 0, 0}, {0, -1, 0}}))->uvs ==
          std::vector<glm::vec2>{{0.5f, 1}, {0.5f, 0.5f}, {0.5f, 0}});
}

TEST_CASE("spherical uv: an invalid mesh is an error")
{
    Mesh mesh = makeQuad();
    mesh.positions[1].x = std::numeric_limits<float>::quiet_NaN();
    CHECK(withSphericalUvs(mesh).error().message.find("position of vertex 1") != std::string::npos);
    mesh = makeQuad();
    mesh.indices[0] = 9;
    CHECK_FALSE(withSphericalUvs(mesh).has_value());
}

// Displaced meshes: heights that are known, and seams that stay closed.
#include "relief/mesh/displace.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "relief/lanes/math.h"
#include "relief/mesh/primitives.h"
#include "relief/mesh/spherical_uv.h"

using namespace relief;

namespace {

// Does not have the same value at u = 0 and u = 1, nor all around a pole.
float slope(float u, float v)
{
    return u + 0.3f * v;
}

// Positions before, as exact keys, to what they became.
void checkClosed(const Mesh& base, const Mesh& mesh)
{
    REQUIRE(mesh.positions.size() == base.positions.size());
    std::map<std::array<float, 3>, std::size_t> places;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < base.positions.size(); ++i) {
        const glm::vec3 p = base.positions[i];
        const auto [place, isNew] = places.emplace(std::array<float, 3>{p.x, p.y, p.z}, i);
        shared += !isNew;
        CHECK(mesh.positions[i] == mesh.positions[place->second]);
        CHECK(mesh.normals[i] == mesh.normals[place->second]);
    }
    CHECK(shared > 0);
}

}  // namespace

TEST_CASE("displace: a constant height makes a sphere larger, and leaves it a sphere")
{
    const Mesh base = makeSphere(32, 16);
    const Expected<Mesh> mesh = displaced(
        base, [](float, float) { return 0.5f; }, 0.25f);
    REQUIRE(mesh.has_value());
    CHECK(validate(*mesh).has_value());
    CHECK(mesh->indices == base.indices);
    CHECK(mesh->uvs == base.uvs);
    CHECK(mesh->tangents.empty());
    for (std::size_t i = 0; i < base.positions.size(); ++i) {
        CHECK(glm::distance(mesh->positions[i], base.normals[i] * 0.625f) < 1e-6f);
        CHECK(glm::dot(mesh->normals[i], base.normals[i]) > 0.999f);
    }
}

TEST_CASE("displace: a tilted height tilts the quad")
{
    // Towards the viewer at -Z by u: the plane z = -u = -(x + 0.5), whose front looks along (-1, 0, -1).
    const Expected<Mesh> mesh = displaced(
        makeQuad(), [](float u, float) { return u; }, 1.0f);
    REQUIRE(mesh.has_value());
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(mesh->positions[i].z == -mesh->uvs[i].x);
        CHECK(glm::distance(mesh->normals[i], glm::vec3(-std::sqrt(0.5f), 0, -std::sqrt(0.5f))) < 1e-6f);
    }
}

TEST_CASE("displace: seams and poles stay closed and smooth, even where the heights disagree")
{
    for (const Mesh& base : {makeSphere(24, 12), makeCubeSphere(8), makeCube()}) {
        CAPTURE(base.name);
        const Expected<Mesh> mesh = displaced(base, slope, 0.1f);
        REQUIRE(mesh.has_value());
        checkClosed(base, *mesh);
    }
}

TEST_CASE("displace: numbers that no mesh may hold are errors of one line")
{
    const auto errorOf = [](const Expected<Mesh>& mesh) { return mesh ? std::string() : mesh.error().message; };
    const auto flat = [](float, float) { return 1.0f; };
    Mesh bare = makeQuad();
    bare.uvs.clear();
    CHECK(errorOf(displaced(bare, flat, 1.0f)) ==
          "mesh 'quad': displacement needs uvs; give every vertex one (withSphericalUvs)");
    const std::string outOfRange =
        "mesh 'quad': displacement moves vertex 0 out of the floats; give finite heights and a smaller amount";
    CHECK(errorOf(displaced(makeQuad(), flat, std::numeric_limits<float>::quiet_NaN())) == outOfRange);
    CHECK(errorOf(displaced(
              makeQuad(), [](float, float) { return 1e30f; }, 1e30f)) == outOfRange);
    Mesh broken = makeQuad();
    broken.indices.pop_back();
    CHECK(errorOf(displaced(broken, flat, 1.0f)).find("5 indices") != std::string::npos);
    CHECK(displaced(Mesh{}, flat, 1.0f).has_value());
}

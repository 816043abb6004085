// Meshes: what validate() refuses, and normals whose directions are known.
#include "relief/mesh/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "contents.h"
#include "relief/mesh/primitives.h"
#include "relief/mesh/triangulate.h"

using namespace relief;

namespace {

std::string errorOf(const Mesh& mesh)
{
    const Expected<void> valid = validate(mesh);
    return valid ? "" : valid.error().message;
}

// A polygon in the plane z = 0 that turns counter-clockwise around +z, and its area.
struct Polygon
{
    std::vector<glm::vec3> corners;
    double area;
};

// Every triangle turns like the polygon, whose front is +axis (or -axis where it is turned over), and the areas add up.
void checkTriangulation(const Polygon& polygon, int axis, bool turnedOver, glm::vec3 offset)
{
    std::vector<glm::vec3> corners;
    for (const glm::vec3& corner : polygon.corners) {
        glm::vec3 placed = offset;
        placed[(axis + 1) % 3] += corner.x;
        placed[(axis + 2) % 3] += corner.y;
        placed[axis] += 0.1f * corner.x;  // a bit tilted
        corners.push_back(placed);
    }
    if (turnedOver) std::reverse(corners.begin(), corners.end());
    const auto triangles = triangulate(corners);
    REQUIRE(triangles.size() == corners.size() - 2);
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
        const glm::dvec3 cross = glm::cross(glm::dvec3(corners[b]) - glm::dvec3(corners[a]),
                                            glm::dvec3(corners[c]) - glm::dvec3(corners[a]));
        const double projected = turnedOver ? -cross[axis] : cross[axis];
        CHECK(projected >= 0);
        area += 0.5 * projected;
    }
    CHECK(area == doctest::Approx(polygon.area));
}

}  // namespace

TEST_CASE("mesh: validate accepts a quad, and an empty mesh")
{
    CHECK(errorOf(makeQuad()) == "");
    CHECK(errorOf(Mesh{}) == "");
}

TEST_CASE("mesh: validate names what is wrong")
{
    Mesh mesh = makeQuad();
    mesh.normals.pop_back();
    CHECK(contains(errorOf(mesh), "mesh 'quad': 3 normals for 4 positions"));

    mesh = makeQuad();
    mesh.uvs.resize(5);
    CHECK(contains(errorOf(mesh), "5 uvs for 4 positions"));
    mesh.uvs.clear();
    CHECK(errorOf(mesh) == "");

    mesh = makeQuad();
    mesh.tangents.resize(1);
    CHECK(contains(errorOf(mesh), "1 tangents for 4 positions"));
    mesh.tangents.clear();
    mesh.colors.resize(3);
    CHECK(contains(errorOf(mesh), "3 colours for 4 positions"));
    mesh.colors.clear();
    CHECK(errorOf(mesh) == "");

    mesh = makeQuad();
    mesh.indices.pop_back();
    CHECK(contains(errorOf(mesh), "5 indices are no whole number of triangles"));

    mesh = makeQuad();
    mesh.indices[4] = 4;
    CHECK(contains(errorOf(mesh), "triangle 1 uses vertex 4 of 4"));

    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        mesh = makeQuad();
        mesh.positions[2].z = bad;
        CHECK(contains(errorOf(mesh), "the position of vertex 2 is not finite"));
        mesh = makeQuad();
        mesh.normals[1].x = -bad;
        CHECK(contains(errorOf(mesh), "the normal of vertex 1 is not finite"));
        mesh = makeQuad();
        mesh.uvs[3].y = bad;
        CHECK(contains(errorOf(mesh), "the uv of vertex 3 is not finite"));
        mesh = makeQuad();
        mesh.tangents[0].w = bad;
        CHECK(contains(errorOf(mesh), "the tangent of vertex 0 is not finite"));
        mesh = makeQuad();
        mesh.colors.assign(4, glm::vec4(1));
        mesh.colors[3].y = bad;
        CHECK(contains(errorOf(mesh), "the colour of vertex 3 is not finite"));
    }
}

TEST_CASE("mesh: computed normals point out of the clockwise side")
{
    Mesh mesh = makeQuad();
    const std::vector<glm::vec3> expected = mesh.normals;
    mesh.normals.clear();
    computeNormals(mesh);
    CHECK(mesh.normals == expected);
}

TEST_CASE("mesh: computed normals are weighted by area")
{
    // Two triangles at a right angle that share the edge from 0 to 1, one three times as large: the sum is (-1, 0, -3).
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 1, 0}, {3, 0, 0}, {0, 0, 1}};
    mesh.indices = {0, 1, 2, 0, 3, 1};
    computeNormals(mesh);
    const glm::vec3 expected = glm::vec3(-1, 0, -3) / std::sqrt(10.0f);
    CHECK(glm::distance(mesh.normals[0], expected) < 1e-6f);
    CHECK(mesh.normals[2] == glm::vec3(0, 0, -1));
    CHECK(mesh.normals[3] == glm::vec3(-1, 0, 0));
}

TEST_CASE("mesh: computed normals are of unit length for any size and for no area")
{
    for (const float scale : {1e-30f, 1e-19f, 1.0f, 1e19f, 1e30f}) {
        CAPTURE(scale);
        Mesh mesh = makeCube();
        for (glm::vec3& position : mesh.positions) position *= scale;
        const std::vector<glm::vec3> expected = mesh.normals;
        computeNormals(mesh);
        CHECK(mesh.normals == expected);
    }
    Mesh flat;
    flat.positions = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}};
    flat.indices = {0, 1, 2};
    computeNormals(flat);
    CHECK(flat.normals == std::vector<glm::vec3>(4, glm::vec3(0, 1, 0)));
}

TEST_CASE("triangulate: convex polygons are fans")
{
    const std::vector<glm::vec3> pentagon = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {-1, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    CHECK(triangulate(pentagon) == fan);
    CHECK(triangulate(std::span(pentagon).first(3)) == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    CHECK(triangulate(std::span(pentagon).first(2)).empty());
}

TEST_CASE("triangulate: concave polygons keep their area wherever they lie")
{
    const std::vector<Polygon> polygons = {
        {{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 3},                        // an L
        {{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, 7},  // a U
        {{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}, 4},                                              // a dart
        {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}}, 4},             // in line
        {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 1, 0}, {1, 1, 0}}, 15.5},
    };
    for (const Polygon& polygon : polygons) {
        for (const glm::vec3 offset : {glm::vec3(0, 0, 0), {10, 10, 0}, {-10, 10, 3}, {10, -10, -3}, {-1, -1, 0}}) {
            Polygon rotated = polygon;
            for (std::size_t first = 0; first < polygon.corners.size(); ++first) {
                CAPTURE(first);
                CAPTURE(polygon.area);
                for (int axis = 0; axis < 3; ++axis) {
                    CAPTURE(axis);
                    checkTriangulation(rotated, axis, false, offset);
                    checkTriangulation(rotated, axis, true, offset);
                }
                rotated.corners.push_back(rotated.corners.front());
                rotated.corners.erase(rotated.corners.begin());
            }
        }
    }
}

TEST_CASE("triangulate: polygons without area give as many triangles as others")
{
    CHECK(triangulate(std::vector<glm::vec3>(6, glm::vec3(1, 2, 3))).size() == 4);
    const std::vector<glm::vec3> bowTie = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5f, 2, 0}};
    CHECK(triangulate(bowTie).size() == 3);
}

// Boxes around meshes.
#include "relief/mesh/bounds.h"

#include <doctest/doctest.h>

#include "relief/mesh/primitives.h"

using namespace relief;

TEST_CASE("bounds: of the cube, of the quad, and of nothing")
{
    const Bounds cube = boundsOf(makeCube());
    CHECK(cube.low == glm::vec3(-0.5f));
    CHECK(cube.high == glm::vec3(0.5f));
    CHECK(cube.centre() == glm::vec3(0.0f));
    CHECK(cube.radius() == doctest::Approx(0.8660254));
    for (const float size : {0x1p-110f, 0x1p-70f, 0x1p70f, 0x1p126f}) {
        Mesh scaled = makeCube();
        for (glm::vec3& p : scaled.positions) p *= 2.0f * size;
        CHECK(boundsOf(scaled).radius() / size == doctest::Approx(1.7320508));
    }
    CHECK(boundsOf(makeQuad()).high == glm::vec3(0.5f, 0.5f, 0.0f));
    CHECK(boundsOf(Mesh{}).high == glm::vec3(0.0f));
}

TEST_CASE("bounds: the distance to a box is 0 inside, and to the nearest side, edge or corner outside")
{
    const Bounds cube = boundsOf(makeCube());
    CHECK(cube.squaredDistance({0.2f, -0.5f, 0.4f}) == 0.0f);
    CHECK(cube.squaredDistance({0.0f, 2.5f, 0.0f}) == 4.0f);
    CHECK(cube.squaredDistance({3.5f, 4.5f, 0.0f}) == 25.0f);
    CHECK(cube.squaredDistance({-1.5f, -1.5f, 1.5f}) == 3.0f);
}

TEST_CASE("bounds: a moved box holds all moved points")
{
    const Mesh mesh = makeSphere(16, 8);
    const glm::mat4 matrix = {{0.6f, 0.8f, 0, 0}, {-0.8f, 0.6f, 0, 0}, {0, 0, -3, 0}, {1, 2, 3, 1}};
    const Bounds moved = transformed(boundsOf(mesh), matrix);
    for (const glm::vec3& p : mesh.positions) {
        const glm::vec4 q = matrix * glm::vec4(p, 1.0f);
        CHECK(moved.squaredDistance(glm::vec3(q)) <= 1e-12f);
    }
    CHECK(moved.high.z == doctest::Approx(4.5));
    CHECK(moved.high.x == doctest::Approx(1.7));
}

// Rays against meshes: hits that are known by algebra, rays through edges and corners, and every triangle tried in
// turn.
#include "relief/mesh/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "numbers.h"
#include "relief/mesh/primitives.h"

using namespace relief;

namespace {

glm::dvec3 unit(glm::dvec3 v)
{
    return v / std::sqrt(glm::dot(v, v));
}

// Numbers in -1..1, the same everywhere.
struct Numbers
{
    std::uint64_t state = 1;
    double next()
    {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state >> 11) * 0x1p-52 - 1.0;
    }
    glm::dvec3 point()
    {
        const double x = next(), y = next(), z = next();
        return {x, y, z};
    }
};

Mesh triangleSoup(int count)
{
    Numbers numbers;
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 centre = numbers.point();
        for (int k = 0; k < 3; ++k) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(glm::vec3(centre + 0.2 * numbers.point()));
            mesh.normals.push_back({0, 1, 0});
        }
    }
    return mesh;
}

// By Cramer's rule, without a tree; infinity if the front is not hit.
double distanceTo(const Mesh& mesh, std::size_t triangle, const Ray& ray)
{
    const glm::dvec3 a(mesh.positions[mesh.indices[3 * triangle]]);
    const glm::dvec3 ab = glm::dvec3(mesh.positions[mesh.indices[3 * triangle + 1]]) - a;
    const glm::dvec3 ac = glm::dvec3(mesh.positions[mesh.indices[3 * triangle + 2]]) - a;
    const double determinant = -glm::dot(ray.direction, glm::cross(ab, ac));
    if (determinant <= 0) return kInfinity;
    const glm::dvec3 fromA = ray.origin - a;
    const glm::dvec3 q = glm::cross(fromA, ray.direction);
    const double v = glm::dot(ac, q) / determinant, w = -glm::dot(ab, q) / determinant;
    const double t = glm::dot(fromA, glm::cross(ab, ac)) / determinant;
    return v >= 0 && w >= 0 && v + w <= 1 && t >= ray.begin && t <= ray.end ? t : kInfinity;
}

}  // namespace

TEST_CASE("ray_tree: a quad is hit from the front, at its distance, and not from behind")
{
    const RayTree tree(makeQuad());
    const std::optional<RayHit> hit = tree.firstHit({{0.25, -0.125, -3}, {0, 0, 1}, 0, 10});
    REQUIRE(hit.has_value());
    CHECK(hit->t == 3.0);
    CHECK(hit->weights[0] + hit->weights[1] + hit->weights[2] == 1.0);
    CHECK_FALSE(tree.firstHit({{0.25, -0.125, 3}, {0, 0, -1}, 0, 10}).has_value());
    CHECK_FALSE(tree.firstHit({{0.75, 0, -3}, {0, 0, 1}, 0, 10}).has_value());
    // A ray in the quad's own plane.
    CHECK_FALSE(tree.firstHit({{-3, 0, 0}, {1, 0, 0}, 0, 10}).has_value());
}

TEST_CASE("ray_tree: begin and end belong to the ray, and may be negative")
{
    const RayTree tree(makeQuad());
    const auto isHit = [&](double begin, double end) {
        return tree.firstHit({{0.25, -0.125, 1}, {0, 0, 1}, begin, end}).has_value();
    };
    CHECK(isHit(-1, 1));
    CHECK(isHit(-2, -1));
    CHECK_FALSE(isHit(-0.999, 1));
    CHECK_FALSE(isHit(-2, -1.001));
}

TEST_CASE("ray_tree: nothing is hit in a mesh without triangles, or without area")
{
    CHECK_FALSE(RayTree(Mesh{}).firstHit({{0, 0, -1}, {0, 0, 1}, -10, 10}).has_value());
    Mesh flat;
    flat.positions = {{0, 0, 0}, {1, 1, 0}, {0.5f, 0.5f, 0}};
    flat.normals.assign(3, {0, 0, -1});
    flat.indices = {0, 1, 2, 0, 0, 0, 1, 0, 2};
    CHECK_FALSE(RayTree(flat).firstHit({{0.5, 0.5, -1}, {0, 0, 1}, -10, 10}).has_value());
}

TEST_CASE("ray_tree: of triangles at the same place the lowest number is hit, whatever their order in the tree")
{
    Mesh mesh = makeQuad();
    const std::vector<std::uint32_t> once = mesh.indices;
    for (int i = 0; i < 20; ++i) mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
    const RayTree tree(mesh);
    CHECK(tree.firstHit({{0.3, -0.3, -1}, {0, 0, 1}, 0, 2})->triangle == 0);
    CHECK(tree.firstHit({{-0.3, 0.3, -1}, {0, 0, 1}, 0, 2})->triangle == 1);
    CHECK(tree.firstHit({{0, 0, -1}, {0, 0, 1}, 0, 2})->triangle == 0);
}

TEST_CASE("ray_tree: rays at a sphere's centre slip through no vertex and no edge")
{
    const Mesh sphere = makeSphere(37, 23);
    const RayTree tree(sphere);
    int missed = 0;
    const auto shoot = [&](glm::dvec3 at) {
        const glm::dvec3 direction = -unit(at);
        const std::optional<RayHit> hit = tree.firstHit({at * 4.0, direction, 0, 10});
        missed += !hit || hit->t > 2.0;
    };
    for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 a(sphere.positions[sphere.indices[i + k]]);
            const glm::dvec3 b(sphere.positions[sphere.indices[i + (k + 1) % 3]]);
            shoot(a);
            for (int step = 1; step < 8; ++step) shoot(a + (b - a) * (step / 8.0));
        }
    }
    CHECK(missed == 0);
}

TEST_CASE("ray_tree: the hit is the one that trying every triangle finds")
{
    const Mesh mesh = triangleSoup(400);
    const RayTree tree(mesh);
    Numbers numbers;
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        Ray ray{2.0 * numbers.point(), {}, -1, 3};
        ray.direction = i % 4 == 0 ? glm::dvec3(0) : unit(numbers.point());
        if (i % 4 == 0) ray.direction[i / 4 % 3] = i / 12 % 2 == 0 ? 1.0 : -1.0;
        double nearest = kInfinity;
        std::size_t which = 0;
        for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
            const double distance = distanceTo(mesh, t, ray);
            if (distance < nearest) which = t;
            nearest = std::min(nearest, distance);
        }
        const std::optional<RayHit> hit = tree.firstHit(ray);
        REQUIRE(hit.has_value() == (nearest < kInfinity));
        if (!hit) continue;
        ++hits;
        CHECK(hit->triangle == which);
        CHECK(hit->t == doctest::Approx(nearest).epsilon(1e-9));
        glm::dvec3 point(0);
        for (std::size_t k = 0; k < 3; ++k) {
            point += hit->weights[k] * glm::dvec3(mesh.positions[mesh.indices[3 * which + k]]);
        }
        CHECK(glm::distance(point, ray.origin + hit->t * ray.direction) < 1e-9);
    }
    CHECK(hits > 200);
}

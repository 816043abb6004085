// The camera's matrices: where known points go, by algebra. And cameras that no picture needs: whatever matrix comes
// out, the frame stays finite (stability case S-114).
#include "relief/shading/camera.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "common/camera.h"
#include "common/render.h"
#include "pipeline_fixture.h"
#include "relief/texture/cube_face.h"

using namespace fixture;
using namespace relief::samples;

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

// How far a matrix takes a point from where it should go.
float offBy(const glm::mat4& m, const glm::vec3& point, const glm::vec3& expected)
{
    const glm::vec4 p = m * glm::vec4(point, 1.0f);
    return glm::length(glm::vec3(p) / p.w - expected);
}

}  // namespace

TEST_CASE("camera: lookAt puts the camera at the origin and its target on +z, right is +x, up is +y")
{
    const glm::vec3 position(3, 2, -5), target(3, 2, 7);
    CHECK(offBy(lookAt(position, target), position, {0, 0, 0}) == 0.0f);
    CHECK(offBy(lookAt(position, target), target, {0, 0, 12}) == 0.0f);
    CHECK(offBy(lookAt(position, target), {4, 2, -5}, {1, 0, 0}) == 0.0f);
    CHECK(offBy(lookAt(position, target), {3, 3, -5}, {0, 1, 0}) == 0.0f);
    const glm::mat4 oblique = lookAt({1, 2, 3}, {-4, 0, 9});
    CHECK(offBy(oblique, {-4, 0, 9}, {0, 0, std::sqrt(65.0f)}) < 2e-6f);
    CHECK((oblique * glm::vec4(0, 1, 0, 0)).y > 0.0f);
    CHECK(std::abs((oblique * glm::vec4(0, 1, 0, 0)).x) < 1e-7f);
    CHECK(glm::determinant(oblique) == doctest::Approx(1.0f));  // no mirror
}

TEST_CASE("camera: lookAt straight up or down still has a right and an up")
{
    for (const float y : {-5.0f, 5.0f}) {
        CHECK(offBy(lookAt({0, 0, 0}, {0, y, 0}), {0, y, 0}, {0, 0, 5}) < 1e-6f);
        CHECK(glm::determinant(lookAt({0, 0, 0}, {0, y, 0})) == doctest::Approx(1.0f));
        CHECK(glm::determinant(lookAt({0, 0, 0}, {0, 0, y}, {0, 0, 1})) == doctest::Approx(1.0f));
    }
    CHECK(offBy(lookAt({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), {1, 0, 0}, {0, 1, 0}) < 1e-7f);
}

TEST_CASE("camera: six cameras through the faces of a cube see every direction once, turned as cube maps are")
{
    const glm::vec3 position(0.5f, -2.0f, 3.0f);
    const glm::mat4 projection = perspective(90, 1, 0.25f, 16);
    for (int face = 0; face < kCubeFaces; ++face) {
        CAPTURE(face);
        const glm::mat4 clipFromWorld = projection * lookThroughFace(position, face);
        for (const float s : {-0.75f, 0.0f, 0.5f}) {
            for (const float t : {-0.5f, 0.25f, 0.75f}) {
                const float3 d = cubeDirection(face, s, t);
                const glm::vec4 p = clipFromWorld * glm::vec4(position + firstLane(d) * 2.0f, 1.0f);
                CHECK(p.x / p.w == doctest::Approx(static_cast<double>(s)).epsilon(1e-5));
                CHECK(p.y / p.w == doctest::Approx(static_cast<double>(t)).epsilon(1e-5));
                int seen = 0;
                for (int other = 0; other < kCubeFaces; ++other) {
                    const glm::vec4 q =
                        projection * lookThroughFace(position, other) * glm::vec4(position + firstLane(d) * 2.0f, 1.0f);
                    seen += q.w > 0.0f && std::abs(q.x) < q.w && std::abs(q.y) < q.w;
                }
                CHECK(seen == 1);
            }
        }
    }
}

TEST_CASE("camera: far away, a direction is what it is at the origin")
{
    for (const float far : {1e5f, 16777216.0f, 1e20f}) {
        for (int face = 0; face < kCubeFaces; ++face) {
            const glm::mat3 here(lookThroughFace(glm::vec3(0), face)), there(lookThroughFace(glm::vec3(far), face));
            CHECK(here == there);
        }
    }
    CHECK(lookAlong({1, 2, 3}, {3, 0, 4}) == lookAt({1, 2, 3}, {4, 2, 7}));
}

TEST_CASE("camera: perspective of 90 degrees has the frustum's corners at -1 and 1, depth from 0 to 1")
{
    const glm::mat4 m = perspective(90, 2, 0.5f, 8);
    CHECK(offBy(m, {0, 0, 0.5f}, {0, 0, 0}) < 1e-6f);
    CHECK(offBy(m, {0, 0, 8}, {0, 0, 1}) < 1e-6f);
    CHECK(offBy(m, {6, 3, 3}, {1, 1, m[2][2] + m[3][2] / 3}) < 1e-6f);
    CHECK(offBy(m, {-16, -8, 8}, {-1, -1, 1}) < 1e-6f);
    CHECK((m * glm::vec4(1, 2, 3, 1)).w == 3.0f);
}

TEST_CASE("camera: the far plane may be at infinity, and depth reversed")
{
    CHECK(offBy(perspective(90, 1, 0.5f, kFar), {0, 0, 0.5f}, {0, 0, 0}) == 0.0f);
    CHECK(offBy(perspective(90, 1, 0.5f, kFar), {0, 0, 1e30f}, {0, 0, 1}) == 0.0f);
    CHECK(offBy(perspectiveReversed(90, 1, 0.5f, kFar), {0, 0, 0.5f}, {0, 0, 1}) == 0.0f);
    CHECK(offBy(perspectiveReversed(90, 1, 0.5f, kFar), {0, 0, 1e10f}, {0, 0, 5e-11f}) == 0.0f);
    CHECK(offBy(perspectiveReversed(90, 1, 0.5f, 8), {0, 0, 0.5f}, {0, 0, 1}) < 1e-6f);
    CHECK(offBy(perspectiveReversed(90, 1, 0.5f, 8), {0, 0, 8}, {0, 0, 0}) < 1e-6f);
}

TEST_CASE("camera: orthographic has a box's corners at -1 and 1")
{
    const glm::mat4 m = orthographic(4, 2, 1, 9);
    CHECK(offBy(m, {2, 1, 1}, {1, 1, 0}) == 0.0f);
    CHECK(offBy(m, {-2, -1, 9}, {-1, -1, 1}) == 0.0f);
    CHECK((m * glm::vec4(1, 2, 3, 1)).w == 1.0f);
}

TEST_CASE("camera: rotations take y to z, z to x and x to y, translations and scalings")
{
    const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    CHECK(offBy(rotationX(90), y, z) < 1e-7f);
    CHECK(offBy(rotationY(90), z, x) < 1e-7f);
    CHECK(offBy(rotationZ(90), x, y) < 1e-7f);
    CHECK(offBy(rotationZ(-30), x, {std::sqrt(0.75f), -0.5f, 0}) < 1e-6f);
    CHECK(offBy(translation({1, 2, 3}), {4, 5, 6}, {5, 7, 9}) == 0.0f);
    CHECK(offBy(scaling({1, 2, 3}), {4, 5, 6}, {4, 10, 18}) == 0.0f);
}

TEST_CASE("camera: S-114 near = far, near below 0, 179.9 degrees, an aspect of 1e6: finite pictures")
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const Camera usual = {.position = {0, 1.1f, -2.7f}};
    std::vector<Camera> cameras(1, usual);
    const auto add = [&](auto change) {
        cameras.push_back(usual);
        change(cameras.back());
    };
    add([](Camera& c) { c.nearPlane = c.farPlane = 1.0f; });
    add([](Camera& c) { c.nearPlane = -1.0f; });
    add([](Camera& c) { c.nearPlane = 0.0f; });
    add([](Camera& c) { std::swap(c.nearPlane, c.farPlane); });
    add([=](Camera& c) { c.farPlane = infinity; });
    add([](Camera& c) { c.nearPlane = 1e-30f; });
    add([](Camera& c) { c.farPlane = 3e38f; });
    for (const float angle : {0.0f, 1e-30f, 1e-4f, 179.9f, 180.0f, 270.0f, 360.0f, -40.0f, 1e30f}) {
        add([=](Camera& c) { c.fieldOfView = angle; });
    }
    add([](Camera& c) { c.target = c.position; });  // no direction
    add([](Camera& c) { c.position = {0, 3, 0}; });
    add([](Camera& c) { c.position = {1e30f, 0, 0}; });

    const auto stage = findStage("1.25");
    REQUIRE(stage.has_value());
    const auto prepared = PreparedStage::prepare(**stage);
    REQUIRE(prepared.has_value());
    int drawn = 0, notFinite = 0;
    for (const Camera& camera : cameras) {
        Framebuffer target = makeTarget(48, 27, Format::rgba32f, Store::keep);
        Frame frame(target, {1, kDefaultTileSize});
        prepared->record(frame, 48, 27, camera);
        const Statistics statistics = frame.run();
        CHECK(addsUp(statistics));
        notFinite += !allFinite(target);
        drawn += statistics.pixelsShaded > 0;
    }
    for (const float aspect : {1e6f, 1e-6f, 0.0f, 1e38f, 16384.0f}) {
        const glm::mat4 clip = clipFromView(usual, aspect) * viewFromWorld(usual);
        Mesh mesh;
        for (int i = 0; i < 200; ++i) {
            const auto corner = [&](int k) -> TestVertex {
                const float a = static_cast<float>((i * 7 + k * 5) % 13) / 6.0f - 1.0f;
                const float b = static_cast<float>((i * 3 + k * 11) % 17) / 8.0f - 1.0f;
                const glm::vec4 p = clip * glm::vec4(a, b, a * b, 1.0f);
                return {p, glm::vec4(a, b, 0, 1)};
            };
            addTriangle(mesh, {corner(0), corner(1), corner(2)});
        }
        Framebuffer target = makeTarget(48, 27, Format::rgba32f, Store::keep);
        const Statistics statistics = drawClip<kDepthTested>(target, mesh, Value{});
        CHECK(addsUp(statistics));
        notFinite += !allFinite(target);
    }
    measured("pictures that are not finite", notFinite, 0);
    CHECK(drawn >= 3);  // some of them do show something
}

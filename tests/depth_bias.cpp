// Depth bias, as Direct3D words it (11.3, 15.10).
#include <doctest/doctest.h>

#include "pipeline_fixture.h"

using namespace fixture;

namespace {

// What a triangle with these corners (x, y in pixels, depth) leaves in the middle of a 16x16 target.
float depthOf(const glm::vec3 (&corners)[3], const DepthBias& bias, int samples = 1)
{
    Mesh mesh;
    TestVertex v[3];
    for (std::size_t k = 0; k < 3; ++k) v[k].position = {corners[k].x, corners[k].y, corners[k].z, 1.0f};
    addTriangle(mesh, v[0], v[1], v[2]);
    Expected<Framebuffer> target =
        Framebuffer::create(16, 16, std::vector<Attachment>{{Format::depth32f, Store::keep}}, samples);
    REQUIRE(target.has_value());
    Frame frame(*target, {1, 16});
    const Viewport viewport = exactViewport(16, 16);
    frame.clearDepth();
    frame.setViewport(viewport);
    RenderState state = kDepthTested;
    state.depthBias = bias;
    REQUIRE(frame.draw(mesh, FromPixels(viewport), One{}, state));
    frame.run();
    return target->depth()[8 * 16 + 8];
}

constexpr glm::vec3 kFlat[3] = {{0, 0, 0.6f}, {64, 0, 0.6f}, {0, 64, 0.6f}};
// 1/256 a pixel to the right, 1/512 a pixel down.
constexpr glm::vec3 kLeaning[3] = {{0, 0, 0.25f}, {64, 0, 0.5f}, {0, 64, 0.375f}};

}  // namespace

TEST_CASE("depth bias: a step is that of a float as large as the triangle's largest depth")
{
    CHECK(depthOf(kFlat, {}) == 0.6f);
    for (const float steps : {1.0f, 5.0f, -3.0f, 1000.0f}) {
        CHECK(depthOf(kFlat, {.constant = steps}) == 0.6f + steps * 0x1p-24f);  // 0.6 lies between 1/2 and 1
        CHECK(depthOf(kFlat, {.constant = steps, .slope = 7.0f}) == 0.6f + steps * 0x1p-24f);
    }
    CHECK(depthOf({{0, 0, 0.3f}, {64, 0, 0.3f}, {0, 64, 0.3f}}, {.constant = 8.0f}) == 0.3f + 8.0f * 0x1p-25f);
    CHECK(depthOf({{0, 0, 0.0f}, {64, 0, 0.0f}, {0, 64, 0.0f}}, {.constant = 8.0f}) == 0.0f);
}

TEST_CASE("depth bias: the slope is the larger of the two, in any winding and in any size")
{
    const float plain = depthOf(kLeaning, {});
    CHECK(plain == 0.25f + 8.5f / 256.0f + 8.5f / 512.0f);
    CHECK(depthOf(kLeaning, {.slope = 1.0f}) == plain + 1.0f / 256.0f);
    CHECK(depthOf(kLeaning, {.slope = -2.0f}) == plain - 2.0f / 256.0f);
    CHECK(depthOf({kLeaning[0], kLeaning[2], kLeaning[1]}, {.slope = 1.0f}) == plain + 1.0f / 256.0f);
    CHECK(depthOf({{0, 0, 0.25f}, {64, 0, 0.125f}, {0, 64, 0.5f}}, {.slope = 4.0f}) ==
          0.25f - 8.5f / 512.0f + 8.5f / 256.0f + 4.0f / 256.0f);                                // the way down
    const glm::vec3 large[3] = {{-8192, 0, -31.75f}, {8192, 0, 32.25f}, {-8192, 16384, 0.25f}};  // 1/256, 1/512
    const float there = depthOf(large, {});
    CHECK(depthOf(large, {.slope = 1.0f}) == doctest::Approx(there + 1.0f / 256.0f));
}

TEST_CASE("depth bias: both together are limited on the limit's side, and depth stays within 0 and 1")
{
    const float plain = depthOf(kLeaning, {});
    for (const float sign : {1.0f, -1.0f}) {
        const float limit = sign / 128.0f;
        CHECK(depthOf(kLeaning, {.slope = sign * 16.0f, .limit = limit}) == plain + limit);
        CHECK(depthOf(kLeaning, {.slope = sign * 1.0f, .limit = limit}) == plain + limit / 2.0f);
        CHECK(depthOf(kLeaning, {.slope = sign * -16.0f, .limit = limit}) == plain - 8.0f * limit);
    }
    CHECK(depthOf(kLeaning, {.slope = 1e9f}) == 1.0f);  // as far as what is cleared: not drawn
    CHECK(depthOf(kLeaning, {.slope = -1e9f}) == 0.0f);
    const glm::vec3 steep[3] = {{0, 0, -1e30f}, {64, 0, 1e30f}, {0, 64, 1e30f}};
    for (const float sign : {1.0f, -1.0f}) {
        const float depth = depthOf(steep, {.constant = sign * 3e38f, .slope = sign * -3e38f});
        CHECK((depth >= 0.0f && depth <= 1.0f));
    }
}

TEST_CASE("depth bias: a triangle that is seen edge-on has a slope that is no number (S-907)")
{
    constexpr float most = 3e38f;
    int wrong = 0;
    for (const float a : {-most, 0.5f, most}) {
        for (const float b : {-most, 0.5f, most}) {
            for (const float c : {-most, 0.5f, most}) {
                const glm::vec3 corners[3] = {{0, 0, a}, {64, 0, b}, {0, 64, c}};
                const float plain = depthOf(corners, {});
                // Without a slope only the constant counts: no step at all is the same as nothing.
                wrong += depthOf(corners, {.constant = 1e-30f}) != plain;
                for (const float slope : {1.0f, -1.0f, 1e-30f, most}) {
                    const float depth = depthOf(corners, {.slope = slope});
                    wrong += !(depth >= 0.0f && depth <= 1.0f);
                }
            }
        }
    }
    measured("depths that are none, or were moved", wrong, 0);
}

TEST_CASE("depth bias: hidden blocks know of it")
{
    // A wall, and the same wall moved towards the viewer: every pixel of it passes, however it is cut.
    for (const int samples : {1, 4}) {
        Mesh wall;
        addTriangle(wall, Corners{{{-6400, -6400}, {64000, -6400}, {-6400, 64000}}}, glm::vec4(1.0f));
        Expected<Framebuffer> target = Framebuffer::create(100, 100, Format::rgba32f, Store::keep, samples);
        REQUIRE(target.has_value());
        Frame frame(*target, {1, 32});
        const Viewport viewport = exactViewport(100, 100);
        frame.clear(glm::vec4(0.0f));
        frame.setViewport(viewport);
        RenderState state = kDepthTested;
        state.blend = Blend::additive;
        for (int i = 0; i < 3; ++i) {
            state.depthBias.constant = static_cast<float>(-i);
            REQUIRE(frame.draw(wall, FromPixels(viewport), Value{}, state));
        }
        state.depthBias.constant = 1.0f;
        REQUIRE(frame.draw(wall, FromPixels(viewport), Value{}, state));
        checkInvariants(*target, frame.run());
        CHECK(pixelsNotEqualTo(*target, 3.0f) == 0);
    }
}

TEST_CASE("depth bias: numbers that are none are refused")
{
    Framebuffer target = makeTarget(8, 8);
    Frame frame(target, {1, 16});
    Mesh mesh;
    addTriangle(mesh, Corners{{{0, 0}, {999, 0}, {0, 999}}});
    mesh.name = "m";
    RenderState state;
    state.depthBias.slope = std::numeric_limits<float>::quiet_NaN();
    const Expected<void> drawn = frame.draw(mesh, FromPixels(exactViewport(8, 8)), One{}, state);
    REQUIRE(!drawn.has_value());
    CHECK(drawn.error().message ==
          "draw of mesh 'm': its depth bias holds a NaN or an infinity; set all of RenderState::depthBias to finite "
          "numbers");
}

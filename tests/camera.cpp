// Cameras that no picture needs: whatever matrix comes out, the frame stays finite (stability case S-114).
#include "common/camera.h"

#include <limits>

#include "common/render.h"
#include "pipeline_fixture.h"

using namespace fixture;
using namespace relief::samples;

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

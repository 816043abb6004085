// Instruments: what a frame depends on, and what its programs cost alone.
#include "relief/pipeline/instruments.h"

#include "pipeline_fixture.h"

using namespace fixture;

namespace {

struct TwoValues
{
    SV_POSITION position;
    TEXCOORD<0, float4> used;
    TEXCOORD<1, float4> unused;
};

struct GiveTwo
{
    TwoValues operator()(const TestVertexData& v) const
    {
        return {float4(v.position.x, v.position.y, v.position.z, v.w.x), v.value, v.value};
    }
};

struct ShowFirst
{
    float4 operator()(const TwoValues& i) const { return i.used; }
};

Mesh wholeScreen(float depth)
{
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, depth, 1}, glm::vec4(0.25f)}, {{-1, 3, depth, 1}, glm::vec4(0.25f)},
                {{3, -1, depth, 1}, glm::vec4(0.25f)});
    return mesh;
}

}  // namespace

TEST_CASE("instruments: dependsOn tells used from unused components, and leaves the target as it was")
{
    const Mesh mesh = wholeScreen(0.5f);
    Framebuffer target = makeTarget(20, 20, Format::rgba32f, Store::keep);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(0.0f));
    REQUIRE(frame.draw(mesh, GiveTwo{}, ShowFirst{}, kDepthTested).has_value());
    frame.run();
    const std::uint64_t before = hashOf(target);
    for (int c = 0; c < 8; ++c) CHECK(*dependsOn(frame, 0, c) == (c < 4));
    CHECK(hashOf(target) == before);
}

TEST_CASE("instruments: dependsOn is right without clear(), asked before the frame runs")
{
    const Mesh mesh = wholeScreen(0.5f);
    Framebuffer target = makeTarget(20, 20, Format::rgba32f, Store::keep);
    {
        // Additive: a second run would add again, whatever the component.
        Frame frame(target, {1, 16});
        REQUIRE(frame.draw(mesh, GiveTwo{}, ShowFirst{}, kCount).has_value());
        CHECK(*dependsOn(frame, 0, 0));
        CHECK_FALSE(*dependsOn(frame, 0, 4));
        CHECK(pixelsNotEqualTo(target, 0.0f) == 0);
    }
    {
        // With depth that is kept: a second run would draw nothing.
        Frame frame(target, {1, 16});
        REQUIRE(frame.draw(mesh, GiveTwo{}, ShowFirst{}, kDepthTested).has_value());
        CHECK(*dependsOn(frame, 0, 0));
        CHECK_FALSE(*dependsOn(frame, 0, 4));
    }
}

TEST_CASE("instruments: draws and components that are not there are errors, and an empty frame costs nothing")
{
    const Mesh mesh = wholeScreen(0.5f);
    Framebuffer target = makeTarget(20, 20);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(0.0f));
    CHECK_FALSE(dependsOn(frame, 0, 0).has_value());
    REQUIRE(frame.draw(mesh, GiveTwo{}, ShowFirst{}).has_value());
    for (const auto& [draw, component] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 8}}) {
        CHECK_FALSE(dependsOn(frame, draw, component).has_value());
    }
    CHECK_FALSE(componentCount(frame, 1).has_value());
    CHECK_FALSE(outputSignature(frame, -1).has_value());
    CHECK(*componentCount(frame, 0) == 8);
    CHECK(outputSignature(frame, 0)->find("TEXCOORD") != std::string::npos);

    frame.run();
    CHECK(shadeAlone(frame, 100) > 0.0f);
    frame.reset();
    CHECK(shadeAlone(frame, 100) == 0.0f);
}

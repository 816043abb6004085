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

TEST_CASE("instruments: a target's texture stays where samplers find it")
{
    const Mesh mesh = wholeScreen(0.5f);
    Expected<Framebuffer> target = Framebuffer::create(20, 20, {{Format::rgba32f, Store::texture}});
    REQUIRE(target.has_value());
    const Texture* const texture = target->texture(0);
    Frame frame(*target, {1, 16});
    frame.clear(glm::vec4(0.0f));
    REQUIRE(frame.draw(mesh, GiveTwo{}, ShowFirst{}, kDepthTested).has_value());
    frame.run();
    const Framebuffer before = *target;
    CHECK(*dependsOn(frame, 0, 0));
    CHECK(statisticsOf(frame, 0)->pixelsShaded == 400);
    CHECK(target->texture(0) == texture);
    CHECK(target->samePixels(before));
    CHECK(texture->texel(3, 3) == glm::vec4(0.25f));
}

TEST_CASE("instruments: what one draw adds to the statistics, and what it writes")
{
    // The left half is marked; of the whole screen behind it the stencil lets half through, and the depth test nothing.
    const Mesh whole = wholeScreen(0.5f), far = wholeScreen(0.75f);
    for (const int samples : {1, 4}) {
        Expected<Framebuffer> target = Framebuffer::create(
            32, 16, {{Format::rgba32f}, {Format::rgba8}, {Format::depth32f}, {Format::stencil8}}, samples);
        REQUIRE(target.has_value());
        Frame frame(*target, {1, 16});
        frame.clear(glm::vec4(0.0f));
        frame.setScissor({0, 0, 16, 16});
        RenderState mark = kDepthTested;
        mark.colorWrite = false;
        mark.stencil = bothSides(1, {.pass = StencilOp::replace});
        REQUIRE(frame.draw(whole, GiveTwo{}, ShowFirst{}, mark).has_value());
        frame.setScissor({0, 0, 32, 16});
        RenderState marked = kDepthTested;
        marked.stencil = bothSides(1, {.test = Compare::equal});
        REQUIRE(frame.draw(far, GiveTwo{}, ShowFirst{}, marked).has_value());
        REQUIRE(frame.draw(far, GiveTwo{}, ShowFirst{}, kDepthTested).has_value());
        const Statistics all = frame.run();
        const std::uint64_t hash = hashOf(*target);
        const std::uint64_t half = 16 * 16 * static_cast<std::uint64_t>(samples);
        const Statistics first = *statisticsOf(frame, 0), second = *statisticsOf(frame, 1),
                         third = *statisticsOf(frame, 2);
        CHECK(first.stencilPassed == half);
        CHECK(first.stencilFailed == 0);
        CHECK(second.stencilPassed == half);
        CHECK(second.stencilFailed == half);
        CHECK(second.pixelsShaded == 0);
        CHECK(third.stencilPassed + third.stencilFailed == 0);
        CHECK(third.pixelsShaded == 16 * 16);
        CHECK(first.draws + second.draws + third.draws == all.draws);
        CHECK(first.pixelsShaded + second.pixelsShaded + third.pixelsShaded == all.pixelsShaded);
        CHECK(first.stencilPassed + second.stencilPassed == all.stencilPassed);
        CHECK(frame.drawCount() == 3);
        CHECK(hashOf(*target) == hash);
        frame.run();
        CHECK(hashOf(*target) == hash);

        const DrawFacts marks = *factsOf(frame, 0), tests = *factsOf(frame, 1), plain = *factsOf(frame, 2);
        CHECK((marks.colors == 0 && marks.depth && marks.stencil && marks.testsStencil && !marks.program));
        CHECK((tests.colors == 1 && tests.depth && !tests.stencil && tests.testsStencil && tests.program));
        CHECK((plain.colors == 1 && plain.depth && !plain.stencil && !plain.testsStencil && plain.program));
        CHECK_FALSE(factsOf(frame, 3).has_value());
        CHECK_FALSE(statisticsOf(frame, -1).has_value());
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

// Stencil, several colour targets, and what a fragment program may give besides colours: against a model that goes
// pixel by pixel in plain C++.
#include <doctest/doctest.h>

#include <algorithm>

#include "pipeline_fixture.h"
#include "relief/pipeline/instruments.h"

using namespace fixture;

namespace {

constexpr Compare kCompares[] = {Compare::never,   Compare::less,     Compare::equal,        Compare::lessEqual,
                                 Compare::greater, Compare::notEqual, Compare::greaterEqual, Compare::always};
constexpr StencilOp kOps[] = {StencilOp::keep,           StencilOp::zero,           StencilOp::replace,
                              StencilOp::incrementClamp, StencilOp::decrementClamp, StencilOp::invert,
                              StencilOp::incrementWrap,  StencilOp::decrementWrap};

template <class T>
bool holds(Compare compare, T a, T b)
{
    switch (compare) {
        case Compare::never:
            return false;
        case Compare::less:
            return a < b;
        case Compare::equal:
            return a == b;
        case Compare::lessEqual:
            return a <= b;
        case Compare::greater:
            return a > b;
        case Compare::notEqual:
            return a != b;
        case Compare::greaterEqual:
            return a >= b;
        case Compare::always:
            break;
    }
    return true;
}

int operated(StencilOp op, int old, int reference)
{
    switch (op) {
        case StencilOp::keep:
            break;
        case StencilOp::zero:
            return 0;
        case StencilOp::replace:
            return reference;
        case StencilOp::incrementClamp:
            return std::min(old + 1, 255);
        case StencilOp::decrementClamp:
            return std::max(old - 1, 0);
        case StencilOp::invert:
            return 255 - old;
        case StencilOp::incrementWrap:
            return (old + 1) % 256;
        case StencilOp::decrementWrap:
            return (old + 255) % 256;
    }
    return old;
}

// What the fragment program of a draw decides.
enum class Decides
{
    nothing,
    discard,  // every second pixel
    depth,    // 0.3 in every third column, its own elsewhere
    coverage  // no sample in every fourth row
};

struct DrawnTriangle
{
    Corners corners;
    float depth;
    glm::vec4 color;
    RenderState state;
    Decides decides;

    bool isFront() const
    {
        const auto dx = [&](std::size_t k) { return std::int64_t{corners[k].x} - corners[0].x; };
        const auto dy = [&](std::size_t k) { return std::int64_t{corners[k].y} - corners[0].y; };
        return dx(1) * dy(2) - dx(2) * dy(1) > 0;
    }
    bool discards(int x, int y) const { return decides == Decides::discard && (x + y) % 2 == 1; }
    bool covers(int y) const { return decides != Decides::coverage || y % 4 != 0; }
    float depthAt(int x) const { return decides == Decides::depth && x % 3 == 0 ? 0.3f : depth; }
};

struct DiscardSome
{
    float4 operator()(const Interpolated& i, Discard& discard) const
    {
        const Int x = truncateToInt(i.position.x), y = truncateToInt(i.position.y);
        discard(((x + y) & 1) == 1);
        return i.value;
    }
};
struct ColorAndDepth
{
    SV_Target<0> color;
    SV_Depth depth;
};
struct GiveDepth
{
    ColorAndDepth operator()(const Interpolated& i) const
    {
        const Int x = truncateToInt(i.position.x);
        // x % 3 by a product: exact for the few columns that there are.
        return {i.value, select(x - truncateToInt(Float(x) * 0.33334f) * 3 == 0, Float(0.3f), i.position.z)};
    }
};
struct ColorAndCoverage
{
    SV_Target<0> color;
    SV_Coverage coverage;
};
struct GiveCoverage
{
    ColorAndCoverage operator()(const Interpolated& i) const
    {
        return {i.value, select((truncateToInt(i.position.y) & 3) == 0, Int(0), Int(255))};
    }
};

DrawnTriangle someTriangle(Random& random, int side)
{
    DrawnTriangle t = {};
    t.corners = randomTriangle(random, side, side, 300);
    t.depth = static_cast<float>(random.between(0, 4)) * 0.25f;
    t.color = glm::vec4(static_cast<float>(random.between(1, 200)));
    const auto face = [&] {
        return StencilFace{kCompares[random.between(0, 7)], kOps[random.between(0, 7)], kOps[random.between(0, 7)],
                           kOps[random.between(0, 7)]};
    };
    const auto byte = [&] { return static_cast<std::uint8_t>(random.between(0, 255)); };
    t.state.cull = Cull::none;
    t.state.depthTest = kCompares[random.between(0, 7)];
    t.state.depthWrite = random.chance(2);
    t.state.colorWrite = !random.chance(5);
    if (!random.chance(4)) t.state.stencil = {byte(), byte(), byte(), face(), face()};
    t.decides = static_cast<Decides>(random.between(0, 3));
    return t;
}

// What a picture is to be, pixel by pixel; of several samples the first.
struct Model
{
    int side;
    bool hasDepth, hasStencil;
    std::vector<float> depth = std::vector<float>(static_cast<std::size_t>(side * side), 0.75f);
    std::vector<int> stencil = std::vector<int>(static_cast<std::size_t>(side * side), 7);
    std::vector<glm::vec4> color = std::vector<glm::vec4>(static_cast<std::size_t>(side * side), glm::vec4(0.0f));

    void draw(const DrawnTriangle& t, SamplePattern::Position sample)
    {
        ExactTriangle(moved(t.corners, sample)).forEachPixel({0, 0, side, side}, [&](int x, int y) {
            if (t.discards(x, y) || !t.covers(y)) return;
            const auto at = static_cast<std::size_t>(y * side + x);
            const Stencil& s = t.state.stencil;
            const StencilFace& face = t.isFront() ? s.front : s.back;
            const bool passes = !hasStencil || holds(face.test, s.reference & s.readMask, stencil[at] & s.readMask);
            const bool drawn = passes && (!hasDepth || holds(t.state.depthTest, t.depthAt(x), depth[at]));
            const StencilOp op = !passes ? face.fail : !drawn ? face.depthFail : face.pass;
            stencil[at] = (stencil[at] & ~s.writeMask & 255) | (operated(op, stencil[at], s.reference) & s.writeMask);
            if (drawn && t.state.depthWrite) depth[at] = t.depthAt(x);
            if (drawn && t.state.colorWrite) color[at] = t.color;
        });
    }
};

int wrongPixels(const Framebuffer& target, const Model& model)
{
    int wrong = 0;
    for (std::size_t i = 0; i < model.depth.size(); ++i) {
        wrong += model.hasDepth && target.depth()[i] != model.depth[i];
        wrong += model.hasStencil && target.stencil()[i] != static_cast<std::uint32_t>(model.stencil[i]);
        wrong += !target.samples().isMultiple() && target.color32f()[i] != model.color[i];
    }
    return wrong;
}

}  // namespace

TEST_CASE("stencil: tests and operations of both sides, with depth, discard, SV_Depth, SV_Coverage and samples")
{
    Random random(71);
    constexpr int kSide = 40;
    int wrong = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        const int samples = random.chance(2) ? 1 : 1 << random.between(1, 3);
        Model model = {kSide, !random.chance(4), !random.chance(6)};
        std::vector<Attachment> attachments = {{Format::rgba32f, Store::keep}};
        if (model.hasStencil) attachments.push_back({Format::stencil8, Store::keep});
        if (model.hasDepth) attachments.push_back({Format::depth32f, Store::keep});
        Expected<Framebuffer> target = Framebuffer::create(kSide, kSide, attachments, samples);
        REQUIRE(target.has_value());
        Frame frame(*target, {1 + trial % 2, 16 << trial % 3});
        const Viewport viewport = exactViewport(kSide, kSide);
        frame.setViewport(viewport);
        frame.clear(glm::vec4(0.0f), 0.75f);
        frame.clearStencil(7);
        std::vector<Mesh> meshes;
        meshes.reserve(24);
        for (int i = 0; i < 24; ++i) {
            const DrawnTriangle t = someTriangle(random, kSide);
            model.draw(t, target->samples().position[0]);
            Mesh& mesh = meshes.emplace_back();
            addTriangle(mesh, t.corners, t.color, t.depth);
            const FromPixels vertexProgram(viewport);
            const bool recorded =
                (t.decides == Decides::discard    ? frame.draw(mesh, vertexProgram, DiscardSome{}, t.state)
                 : t.decides == Decides::depth    ? frame.draw(mesh, vertexProgram, GiveDepth{}, t.state)
                 : t.decides == Decides::coverage ? frame.draw(mesh, vertexProgram, GiveCoverage{}, t.state)
                                                  : frame.draw(mesh, vertexProgram, Value{}, t.state))
                    .has_value();
            REQUIRE(recorded);
        }
        frame.run();
        wrong += wrongPixels(*target, model);
    }
    measured("wrong depths, stencils and colours", wrong, 0);
}

TEST_CASE("stencil: what is not cleared stays, what is not kept begins at 0, and a frame in parts is the same")
{
    Random random(72);
    std::vector<DrawnTriangle> triangles;
    for (int i = 0; i < 40; ++i) triangles.push_back(someTriangle(random, 64));
    const auto render = [&](const FrameOptions& options, bool inTwoFrames) {
        Framebuffer target = *Framebuffer::create(
            64, 64, {{Format::stencil8, Store::keep}, {Format::rgba32f, Store::keep}, {Format::depth32f, Store::keep}});
        const Viewport viewport = exactViewport(64, 64);
        Frame frame(target, options);
        std::vector<Mesh> meshes(triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            if (i == 0 || (inTwoFrames && i == 20)) {
                frame.run();
                frame.reset();
                frame.setViewport(viewport);
                if (i == 0) frame.clear(glm::vec4(0.0f));
            }
            addTriangle(meshes[i], triangles[i].corners, triangles[i].color, triangles[i].depth);
            REQUIRE(frame.draw(meshes[i], FromPixels(viewport), Value{}, triangles[i].state));
        }
        frame.run();
        return target;
    };
    const Framebuffer whole = render({1, 64}, false);
    CHECK(std::any_of(whole.stencil().begin(), whole.stencil().end(), [](std::uint32_t s) { return s != 0; }));
    CHECK(whole.samePixels(render({2, 16}, false)));
    CHECK(whole.samePixels(render({1, 64}, true)));
    CHECK(whole.samePixels(render({2, 32, 3}, false)));

    // Discarded, so every frame begins at 0: the first draw passes, the second does not.
    Framebuffer target = *Framebuffer::create(8, 8, {{Format::rgba32f}, {Format::stencil8, Store::discard}});
    CHECK(target.stencil().empty());
    const Mesh mesh = meshOf({{Point{0, 0}, Point{8000, 0}, Point{0, 8000}}});
    const StencilFace once = {Compare::equal, StencilOp::keep, StencilOp::keep, StencilOp::incrementClamp};
    RenderState state = kCount;
    state.stencil = bothSides(0, once);
    for (int run = 1; run <= 2; ++run) {
        Frame frame(target, {1, 16});
        const Viewport viewport = exactViewport(8, 8);
        frame.setViewport(viewport);
        for (int i = 0; i < 2; ++i) REQUIRE(frame.draw(mesh, FromPixels(viewport), One{}, state));
        frame.run();
        CHECK(pixelsNotEqualTo(target, static_cast<float>(run)) == 0);
    }
}

// --- several colours ---

namespace {

struct ThreeColors
{
    SV_Target<2> third;
    SV_Target<0> first;
    SV_Target<3> fourth;
};
struct GiveThree
{
    ThreeColors operator()(const Interpolated& i) const { return {i.value * 0.25f, i.value, i.value * 4.0f}; }
};

}  // namespace

TEST_CASE("targets: several colours of different formats are what each would be alone, and the one not given stays")
{
    constexpr Format kFormats[] = {Format::rgba8, Format::rgba8Srgb, Format::rgba16f, Format::r32f, Format::rgba32f};
    Random random(73);
    int wrong = 0;
    for (int trial = 0; trial < trials(60); ++trial) {
        Format format[4];
        for (Format& f : format) f = kFormats[random.between(0, 4)];
        const int samples = 1 << random.between(0, 3);
        RenderState state = kDepthTested;
        state.blend = static_cast<Blend>(random.between(0, 2));
        Mesh mesh;
        for (int i = 0; i < 12; ++i) {
            const auto part = [&] { return static_cast<float>(random.between(0, 64)) / 64.0f; };
            addTriangle(mesh, randomTriangle(random, 40, 40, 300), {part(), part(), part(), part()}, part());
        }
        const Viewport viewport = exactViewport(40, 40);
        const auto render = [&](const std::vector<Attachment>& attachments, const auto& program) {
            Expected<Framebuffer> target = Framebuffer::create(40, 40, attachments, samples);
            REQUIRE(target.has_value());
            Frame frame(*target, {1, 16});
            frame.setViewport(viewport);
            frame.clear(glm::vec4(0.0f));
            frame.clearColor(1, {0.25f, 0.5f, 0.75f, 1.0f});
            REQUIRE(frame.draw(mesh, FromPixels(viewport), program, state));
            frame.run();
            return std::move(*target);
        };
        const Attachment depth = {Format::depth32f, Store::discard};
        const Framebuffer all = render({{format[0]}, {format[1]}, depth, {format[2]}, {format[3]}}, GiveThree{});
        const auto same = [&](int target, const auto& program) {
            const Framebuffer one = render({{format[target]}, depth}, program);
            return std::ranges::equal(all.words(all.colorIndex(target)), one.words(0));
        };
        struct Times
        {
            float by;
            float4 operator()(const Interpolated& i) const { return i.value * by; }
        };
        wrong += !same(0, Times{1.0f}) + !same(2, Times{0.25f}) + !same(3, Times{4.0f});
        Framebuffer cleared = *Framebuffer::create(40, 40, {{format[1]}}, samples);
        Frame frame(cleared, {1, 16});
        frame.clearColor({0.25f, 0.5f, 0.75f, 1.0f});
        frame.run();
        wrong += !std::ranges::equal(all.words(all.colorIndex(1)), cleared.words(0));
    }
    measured("targets that differ", wrong, 0);
}

TEST_CASE("targets: lists that are not possible are errors of one line")
{
    const auto message = [](const std::vector<Attachment>& attachments) {
        const Expected<Framebuffer> target = Framebuffer::create(8, 8, attachments);
        REQUIRE_FALSE(target.has_value());
        CHECK(target.error().message.find('\n') == std::string::npos);
        return target.error().message;
    };
    CHECK(message({}).find("at least one") != std::string::npos);
    CHECK(message(std::vector<Attachment>(5)).find("5 colour") != std::string::npos);
    CHECK(message({{Format::stencil8}, {Format::stencil8}}).find("2 stencil") != std::string::npos);
    CHECK(message({{Format::depth32f}, {Format::depth32f}}).find("2 depth") != std::string::npos);
    CHECK(Framebuffer::create(8, 8, {{Format::stencil8}}).has_value());
}

TEST_CASE("targets: without colours written a program that decides nothing is not run")
{
    Framebuffer target = makeTarget(40, 40, Format::rgba32f, Store::keep);
    const Mesh mesh = meshOf({{Point{0, 0}, Point{30000, 0}, Point{0, 30000}}});
    RenderState state = kDepthTested;
    state.colorWrite = false;
    const Viewport viewport = exactViewport(40, 40);
    Frame frame(target, {1, 16});
    frame.setViewport(viewport);
    frame.clear(glm::vec4(0.0f));
    REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, state));
    frame.run();
    CHECK(pixelsNotEqualTo(target, 0.0f) == 0);
    CHECK(std::ranges::all_of(target.depth(), [](float z) { return z == 0.5f; }));
    CHECK(shadeAlone(frame, 0) == 0.0f);
}

// --- facing ---

namespace {

struct SidedInterpolators
{
    SV_POSITION position;
    SV_IsFrontFace isFront;
};
struct SidedVertices
{
    FromPixels inner;
    SidedInterpolators operator()(const TestVertexData& v) const
    {
        SidedInterpolators o;
        o.position = inner(v).position;
        return o;
    }
};
struct ShowSide
{
    float4 operator()(const SidedInterpolators& i) const
    {
        return float4(select(i.isFront, Float(1.0f), Float(-1.0f)));
    }
};

}  // namespace

TEST_CASE("SV_IsFrontFace: by the corners' order, whatever is culled and whichever order is the front's")
{
    Random random(74);
    int wrong = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        DrawnTriangle t = {};
        t.corners = randomTriangle(random, 40, 40, trial % 2 == 0 ? 300 : 32000);
        Mesh mesh;
        addTriangle(mesh, t.corners);
        const bool counterClockwise = random.chance(2);
        RenderState state = kPaint;
        state.cull = static_cast<Cull>(random.between(0, 2));
        Framebuffer target = makeTarget(40, 40);
        const Viewport viewport = exactViewport(40, 40);
        Frame frame(target, {1, 16});
        frame.setViewport(viewport);
        frame.setFrontCounterClockwise(counterClockwise);
        frame.clear(glm::vec4(0.0f));
        REQUIRE(frame.draw(mesh, SidedVertices{FromPixels(viewport)}, ShowSide{}, state));
        frame.run();
        const bool isFront = t.isFront() != counterClockwise;
        const bool isCulled = (state.cull == Cull::back && !isFront) || (state.cull == Cull::front && isFront);
        std::vector<int> counts(40 * 40);
        addExactCoverage(t.corners, 40, 40, counts);
        for (int& c : counts) c = isCulled ? 0 : isFront ? c : -c;
        wrong += wrongCounts(target, counts);
    }
    measured("pixels with the wrong side", wrong, 0);
}

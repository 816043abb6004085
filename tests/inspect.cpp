// Looking inside a frame: every view against numbers known by hand, and the frame that it leaves behind.
#include "relief/pipeline/inspect.h"

#include "pipeline_fixture.h"
#include "relief/texture/sampler.h"

using namespace fixture;

namespace {

constexpr int kSize = 32;  // pixels; two tiles of 16 by two

// A triangle over the whole target.
Mesh wholeScreen(float depth, const glm::vec4& value = glm::vec4(0.25f))
{
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, depth, 1}, value}, {{-1, 3, depth, 1}, value}, {{3, -1, depth, 1}, value});
    return mesh;
}

// The left half (x < 16) of the target, as two triangles.
Mesh leftHalf(float depth)
{
    Mesh mesh;
    const glm::vec4 value(0.5f);
    addTriangle(mesh, {{-1, -1, depth, 1}, value}, {{-1, 1, depth, 1}, value}, {{0, 1, depth, 1}, value});
    addTriangle(mesh, {{-1, -1, depth, 1}, value}, {{0, 1, depth, 1}, value}, {{0, -1, depth, 1}, value});
    return mesh;
}

struct Scene
{
    Framebuffer target = makeTarget(kSize, kSize, Format::rgba32f, Store::keep);
    Frame frame;

    explicit Scene(const FrameOptions& options = {1, 16}) : frame(target, options) { frame.clear(glm::vec4(0.0f)); }

    template <class Program = Value>
    Scene& draw(const Mesh& mesh, const Program& program = {}, const RenderState& state = kDepthTested)
    {
        REQUIRE(frame.draw(mesh, FromClip{}, program, state).has_value());
        return *this;
    }
    Inspection see(const std::string& view)
    {
        Expected<Inspection> seen = inspect(frame, view);
        REQUIRE(seen.has_value());
        return std::move(*seen);
    }
};

std::size_t at(int x, int y)
{
    return static_cast<std::size_t>(y * kSize + x);
}

// How many pixels do not have this number.
int notEqual(const Inspection& seen, float value)
{
    int count = 0;
    for (std::size_t i = 0; i < seen.values.size(); ++i) count += seen.drawn[i] == 0 || seen.values[i].x != value;
    return count;
}

struct ThrowLeftAway
{
    float4 operator()(const Interpolated& i, Discard& discard) const
    {
        discard(i.position.x < 16.0f);
        return i.value;
    }
};

}  // namespace

TEST_CASE("inspect: depth is what the frame leaves in its depth attachment")
{
    const Mesh far = wholeScreen(0.75f), near = leftHalf(0.25f);
    // From 0 on the left edge to 1 on the right one: pixel x has (x + 0.5) / 32.
    Mesh leaning;
    addTriangle(leaning, {{-1, -1, 0, 1}, {}}, {{-1, 3, 0, 1}, {}}, {{3, -1, 2, 1}, {}});
    {
        Scene scene;
        const Inspection seen = scene.draw(far).draw(near).see("depth");
        CHECK(seen.values[at(15, 31)].x == 0.25f);
        CHECK(seen.values[at(16, 31)].x == 0.75f);
        CHECK(seen.lowest == 0.25f);
        CHECK(seen.highest == 0.75f);
    }
    {
        Scene scene;
        const Inspection seen = scene.draw(leaning, Value{}, {.depthClip = false, .cull = Cull::none}).see("depth");
        for (int x = 0; x < kSize; ++x) {
            const float depth = seen.values[at(x, 7)].x;
            CHECK(depth == doctest::Approx((static_cast<float>(x) + 0.5f) / 32.0f).epsilon(1e-6));
            CHECK(depth == scene.target.depth()[at(x, 7)]);
        }
    }
    {
        Scene scene;  // what writes no depth has none
        const Inspection seen = scene.draw(far, Value{}, kPaint).see("depth");
        CHECK(std::count(seen.drawn.begin(), seen.drawn.end(), 1) == 0);
    }
}

TEST_CASE("inspect: an interpolator is what the program gets, to the bit, with perspective too")
{
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, 0.5f, 1}, {1, 2, -3, 4}}, {{-3, 9, 1.5f, 3}, {0.1f, 0.7f, 1e6f, 0}},
                {{6, -2, 1.0f, 2}, {-5, 6, 7, 0.3f}});
    Scene scene;
    const Inspection all = scene.draw(mesh).see("TEXCOORD0"), last = scene.see("TEXCOORD0.w");
    CHECK(all.components == 4);
    CHECK(last.components == 1);
    int drawn = 0, wrong = 0;
    for (std::size_t i = 0; i < all.values.size(); ++i) {
        if (all.drawn[i] == 0) continue;
        ++drawn;
        wrong += all.values[i] != scene.target.color32f()[i] || last.values[i].x != all.values[i].w;
    }
    CHECK(drawn > 500);
    CHECK(wrong == 0);
}

TEST_CASE("inspect: overdraw counts the runs of programs: all from back to front, one from front to back")
{
    const Mesh far = wholeScreen(0.75f), middle = wholeScreen(0.5f), near = leftHalf(0.25f);
    {
        Scene scene;
        const Inspection seen = scene.draw(far).draw(middle).draw(near).see("overdraw");
        CHECK(seen.values[at(3, 3)].x == 3.0f);
        CHECK(seen.values[at(16, 3)].x == 2.0f);
        CHECK(seen.lowest == 0.0f);
        CHECK(seen.highest == 3.0f);
    }
    Scene scene;
    CHECK(notEqual(scene.draw(near).draw(middle).draw(far).see("overdraw"), 1.0f) == 0);
}

TEST_CASE("inspect: what is thrown away has run, and has no value")
{
    const Mesh mesh = wholeScreen(0.5f);
    Scene scene;
    scene.draw(mesh, ThrowLeftAway{});
    CHECK(notEqual(scene.see("overdraw"), 1.0f) == 0);
    const Inspection depth = scene.see("depth");
    CHECK(depth.drawn[at(15, 9)] == 0);
    CHECK(depth.drawn[at(16, 9)] == 1);
}

TEST_CASE("inspect: lanes in use, and the blocks that ran")
{
    const Mesh whole = wholeScreen(0.5f);
    {
        Scene scene;
        CHECK(notEqual(scene.draw(whole).see("lanes"), static_cast<float>(kLanes)) == 0);
        const Inspection blocks = scene.see("blocks");
        CHECK(blocks.values[at(0, 0)].x == blocks.values[at(1, 1)].x);
        CHECK(blocks.values[at(0, 0)].x != blocks.values[at(kBlockWidth, 0)].x);
        CHECK(blocks.values[at(0, 0)].x != blocks.values[at(0, kBlockHeight)].x);
        CHECK(blocks.tileSize == 16);
    }
    Mesh onePixel;  // around the centre of pixel (5, 5)
    const auto clip = [](float x, float y) { return glm::vec4(x / 16 - 1, 1 - y / 16, 0.5f, 1); };
    addTriangle(onePixel, {clip(5.25f, 5.25f), {}}, {clip(6, 5.25f), {}}, {clip(5.25f, 6), {}});
    Scene scene;
    const Inspection lanes = scene.draw(onePixel).see("lanes");
    CHECK(lanes.values[at(5, 5)].x == 1.0f);
    CHECK(std::count(lanes.drawn.begin(), lanes.drawn.end(), 1) == 1);
    const Inspection blocks = scene.see("blocks");
    CHECK(std::count(blocks.drawn.begin(), blocks.drawn.end(), 1) == kLanes);
}

TEST_CASE("inspect: a triangle has one name, another one has another")
{
    const Mesh mesh = leftHalf(0.5f);
    Scene scene;
    const Inspection seen = scene.draw(mesh).see("triangles");
    const float upper = seen.values[at(0, 0)].x, lower = seen.values[at(15, 31)].x;
    CHECK(upper != lower);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < 16; ++x) {
            const float name = seen.values[at(x, y)].x;
            CHECK((name == upper || name == lower));
        }
    }
    CHECK(seen.drawn[at(16, 5)] == 0);
}

namespace {

struct TextureVertexData
{
    POSITION position;
    NORMAL normal;
    TEXCOORD<0, float2> uv;
};
struct TextureInterpolators
{
    SV_POSITION position;
    TEXCOORD<3, float3> sum;
    TEXCOORD<5, float3> normal;
    TEXCOORD<7, float4> uv;
};
struct GiveUv
{
    Float scale = 1.0f;
    TextureInterpolators operator()(TextureVertexData v) const
    {
        return {v.position, v.normal + v.position.xyz(), v.normal * 2.0f,
                float4(v.uv.x * scale, v.uv.y * scale, v.uv.x, 0.0f)};
    }
};

// Samples as often as it is told, level by level.
struct Sample
{
    sampler2D texture;
    int implied = 1;
    float given = -1.0f;  // a level for tex2Dlod, if it is one
    float where = -1.0f;  // and only where x is below, if it is a pixel
    float4 operator()(TextureInterpolators i) const
    {
        float4 color(0.0f);
        for (int k = 0; k < implied; ++k) color = color + tex2D(texture, i.uv.xy());
        if (given >= 0.0f) color = color + tex2Dlod(texture, float4(i.uv.x, i.uv.y, 0.0f, given));
        if (where >= 0.0f) color = color + tex2DWhere(i.position.x < where, texture, i.uv.xy());
        return color;
    }
};

// uv goes from 0 to 1 over the target.
Mesh wholeScreenWithUv()
{
    Mesh mesh;
    mesh.positions = {{-1, -1, 0.5f}, {-1, 3, 0.5f}, {3, -1, 0.5f}};
    mesh.normals = {{0, 0, -0.5f}, {0, 0, -0.5f}, {0, 0, -0.5f}};
    mesh.uvs = {{0, 0}, {0, 2}, {2, 0}};
    mesh.indices = {0, 1, 2};
    return mesh;
}

Inspection seeSampled(const std::string& view, const Sample& sample, float scale = 1.0f)
{
    static const Mesh mesh = wholeScreenWithUv();
    Scene scene;
    REQUIRE(scene.frame.draw(mesh, GiveUv{scale}, sample, kDepthTested).has_value());
    const std::uint64_t before = (scene.frame.run(), hashOf(scene.target));
    Inspection seen = scene.see(view);
    CHECK(hashOf(scene.target) == before);
    return seen;
}

Texture textureOf(int side)
{
    std::vector<float> texels(static_cast<std::size_t>(side * side) * 4);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<float>(i % 7);
    return *Texture::fromRgbaFloat(side, side, texels);
}

}  // namespace

TEST_CASE("inspect: mip is the level that is sampled: 0 where magnified, 2 where a pixel is four texels wide")
{
    const Texture texture = textureOf(128);  // on 32 pixels: level 2
    const sampler2D trilinear = {.texture = &texture};
    CHECK(notEqual(seeSampled("mip", {trilinear}), 2.0f) == 0);
    CHECK(notEqual(seeSampled("mip", {trilinear}, 0.125f), 0.0f) == 0);
    CHECK(notEqual(seeSampled("mip", {trilinear}, 1024.0f), 7.0f) == 0);
    const Inspection between = seeSampled("mip", {trilinear}, 1.5f);  // 2 + log2(1.5) = 2.585
    CHECK(between.values[at(9, 9)].x == doctest::Approx(2.585f).epsilon(0.002));
    CHECK(notEqual(seeSampled("mip", {{.texture = &texture, .filter = Filter::bilinear}}, 1.5f), 3.0f) == 0);
    CHECK(notEqual(seeSampled("mip", {{.texture = &texture, .mipmaps = false}}), 0.0f) == 0);
    CHECK(notEqual(seeSampled("mip", {{.texture = &texture, .maxAnisotropy = 8}}), 2.0f) == 0);
    // The coarsest of several, where they are.
    CHECK(notEqual(seeSampled("mip", {trilinear, 1, 3.5f}), 3.5f) == 0);
    CHECK(notEqual(seeSampled("mip", {trilinear, 1, 1.0f}), 2.0f) == 0);
    const Inspection left = seeSampled("mip", {trilinear, 0, -1.0f, 16.0f});
    CHECK(left.values[at(15, 0)].x == 2.0f);
    CHECK(left.values[at(16, 0)].x == 0.0f);
    CHECK(left.drawn[at(15, 0)] == 1);
    CHECK(left.drawn[at(16, 0)] == 0);
    const Inspection none = seeSampled("mip", {trilinear, 0});
    CHECK(std::count(none.drawn.begin(), none.drawn.end(), 1) == 0);
}

TEST_CASE("inspect: samples are counted pixel by pixel, and those of one texel are none")
{
    const Texture texture = textureOf(8);
    const sampler2D sampler = {.texture = &texture};
    CHECK(notEqual(seeSampled("samples", {sampler, 3, 1.0f}), 4.0f) == 0);
    CHECK(notEqual(seeSampled("samples", {{}, 3}), 0.0f) == 0);
    const Inspection left = seeSampled("samples", {sampler, 1, -1.0f, 16.0f});
    CHECK(left.values[at(15, 0)].x == 2.0f);
    CHECK(left.values[at(16, 0)].x == 1.0f);
}

TEST_CASE("inspect: what a program gives beside its first colour stays as it is, however often it runs")
{
    struct Two
    {
        SV_Target<0> first;
        SV_Target<1> second;
    };
    struct SampleTwice
    {
        sampler2D sampler;
        Two operator()(const TextureInterpolators& i) const
        {
            const float4 color = tex2D(sampler, i.uv.xy());
            return {color, color + ddx(i.uv.x)};
        }
    };
    const Texture texture = textureOf(128);
    const Mesh mesh = wholeScreenWithUv();
    Framebuffer target =
        *Framebuffer::create(kSize, kSize, {{Format::rgba32f, Store::keep}, {Format::rgba32f, Store::keep}});
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(0.0f));
    REQUIRE(frame.draw(mesh, GiveUv{1.0f}, SampleTwice{{.texture = &texture}}, kDepthTested).has_value());
    frame.run();
    const std::span<const std::uint32_t> words = target.words(1);
    const std::vector<std::uint32_t> before(words.begin(), words.end());
    for (const char* const view : {"mip", "samples", "time"}) {
        CAPTURE(view);
        REQUIRE(inspect(frame, view).has_value());
        CHECK(std::equal(before.begin(), before.end(), target.words(1).begin()));
    }
}

TEST_CASE("inspect: time is a positive number everywhere")
{
    const Inspection seen = seeSampled("time", {});
    for (const glm::vec4& value : seen.values) CHECK(value.x > 0.0f);
}

TEST_CASE("inspect: normal and uv are found by what they are made from")
{
    const Inspection normal = seeSampled("normal", {});
    CHECK(normal.values[at(4, 4)] == glm::vec4(0, 0, -1, 0));
    CHECK(normal.lowest == -1.0f);
    const Inspection uv = seeSampled("uv", {}, 4.0f);
    CHECK(uv.components == 2);
    CHECK(uv.values[at(10, 0)].x == doctest::Approx(4 * 10.5f / 32 - 1));  // the fraction of 1.3125
    CHECK(uv.values[at(10, 0)].y == doctest::Approx(4 * 31.5f / 32 - 3));

    Framebuffer target = makeTarget(8, 8);
    Frame frame(target, {1, 16});
    const Mesh mesh = wholeScreenWithUv();
    REQUIRE(frame.draw(mesh, GiveUv{}, Sample{}).has_value());
    CHECK(findView(frame, "TEXCOORD3")->meaning == "float3, from POSITION and NORMAL");
    CHECK(findView(frame, "TEXCOORD7.w")->name == "TEXCOORD7.w");
}

TEST_CASE("inspect: a view that is not there is an error that names those that are")
{
    const Mesh mesh = wholeScreen(0.5f);
    Scene scene;
    scene.draw(mesh);
    for (const char* const name :
         {"", "depht", "normal", "TEXCOORD1", "TEXCOORD0.q", "TEXCOORD0.", "TEXCOORD0.xy", "depth.x"}) {
        const Expected<Inspection> seen = inspect(scene.frame, name);
        REQUIRE_FALSE(seen.has_value());
        CHECK(seen.error().message.find("it has color, depth, TEXCOORD0, mip") != std::string::npos);
    }
    scene.frame.reset();
    CHECK(scene.see("depth").drawn.size() == std::size_t{kSize * kSize});
}

TEST_CASE("inspect: the frame, its statistics and its draws are as ever, for every view, thread and tile")
{
    Random random(4);
    Mesh mesh;
    for (int i = 0; i < 60; ++i) {
        const auto corner = [&] {
            const float w = random.real(0.5f, 2.0f);
            return TestVertex{{random.real(-1, 1) * w, random.real(-1, 1) * w, random.real(0, 1) * w, w},
                              {random.real(-1, 1), random.real(0, 1), 0, 1}};
        };
        const TestVertex a = corner(), b = corner(), c = corner();
        addTriangle(mesh, a, b, c);
    }
    Scene plain;
    const Statistics statistics = plain.draw(mesh).draw(mesh, ThrowLeftAway{}).frame.run();
    for (const View& view : viewsOf(plain.frame)) {
        CAPTURE(view.name);
        std::uint64_t first = 0;
        for (const FrameOptions& options : {FrameOptions{1, 16}, {3, 32}, {1, 16, 20}}) {
            Scene scene(options);
            const Inspection seen = scene.draw(mesh).draw(mesh, ThrowLeftAway{}).see(view.name);
            CHECK(hashOf(scene.target) == hashOf(plain.target));
            CHECK(seen.statistics.pixelsShaded == statistics.pixelsShaded);
            scene.frame.run();
            CHECK(hashOf(scene.target) == hashOf(plain.target));
            if (view.sight == Sight::time || view.sight == Sight::color) continue;
            const std::uint64_t hash = hashBytes(seen.values.data(), seen.values.size() * sizeof seen.values[0]);
            if (first == 0) first = hash;
            CHECK(hash == first);
        }
    }
}

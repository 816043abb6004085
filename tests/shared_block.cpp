// Quads of several blocks in one: they go there and back as they are, and no pixel depends on who shares its block.
#include "relief/pipeline/shared_block.h"

#include "pipeline_fixture.h"
#include "relief/leave_out.h"
#include "relief/pipeline/frame_storage.h"
#include "relief/texture/sampler.h"

using namespace fixture;

namespace {

constexpr RenderState kOver = {Compare::less, true, true, Cull::none, Blend::alpha};
constexpr RenderState kUsual = {Compare::less, true, true, Cull::none, Blend::off};

// A value of every kind that a fragment program can ask for.
struct EveryKind
{
    SV_POSITION position;
    TEXCOORD<0, float2> inSpace;
    noperspective<TEXCOORD<1, float2>> onScreen;
    nointerpolation<TEXCOORD<2, Int>> number;
    centroid<TEXCOORD<3, float2>> inside;
    SV_IsFrontFace isFront;
};

struct EveryKindFromPixels : FromPixels
{
    using FromPixels::FromPixels;
    EveryKind operator()(const TestVertexData& v) const
    {
        const Interpolated i = FromPixels::operator()(v);
        EveryKind result;
        result.position = i.position;
        result.inSpace = i.value.xy();
        result.onScreen = i.value.zw();
        result.number = truncateToInt(i.value.x * 1e6f);
        result.inside = i.value.xy() * 2.0f;
        return result;
    }
};

struct TwoTargets
{
    SV_Target<0> first;
    SV_Target<1> second;
};

// Asks for all of it, for neighbours' differences, and for texels of many levels.
struct Textured
{
    sampler2D map;

    TwoTargets operator()(const EveryKind& i) const
    {
        const float4 texel = tex2D(map, i.inSpace * 5.0f);
        const Float slope = abs(ddx(i.onScreen.x)) + abs(ddy(i.inside.y));
        TwoTargets result;
        result.first = float4(texel.x, i.position.x, i.position.z + i.position.w, frac(slope));
        result.second = float4(i.onScreen.y, i.inside.x, Float(i.number), select(i.isFront, Float(1.0f), i.position.y));
        return result;
    }
};
struct Plain
{
    TwoTargets operator()(const EveryKind& i) const
    {
        TwoTargets result;
        result.first = float4(i.inSpace.x, i.inSpace.y, i.onScreen.x, i.onScreen.y);
        result.second = float4(i.inside.x, i.inside.y, i.position.x, i.position.y);
        return result;
    }
};

// Triangles of all sizes, most of them of some pixels.
Mesh triangles(int count, int width, int height)
{
    Random random(61);
    Mesh mesh;
    for (int n = 0; n < count; ++n) {
        const float reach = random.chance(20) ? 60.0f : random.real(2.0f, 8.0f);
        const glm::vec2 middle = {random.real(0, static_cast<float>(width)),
                                  random.real(0, static_cast<float>(height))};
        TestVertex corner[3];
        for (TestVertex& vertex : corner) {
            const glm::vec2 at = middle + glm::vec2(random.real(-reach, reach), random.real(-reach, reach));
            vertex.position = {at, random.real(0, 1), random.real(0.5f, 4)};
            vertex.value = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
        }
        addTriangle(mesh, corner[0], corner[1], corner[2]);
    }
    return mesh;
}

Texture noise(int side)
{
    Random random(62);
    std::vector<float> texels(static_cast<std::size_t>(side * side) * 4);
    for (float& value : texels) value = random.real(0, 1);
    return *Texture::fromRgbaFloat(side, side, texels);
}

struct Drawn
{
    Framebuffer target;
    Statistics statistics;
};

template <class FragmentProgram>
Drawn draw(const FragmentProgram& program, const RenderState& state, int samples, bool mayShare)
{
    constexpr int width = 200, height = 150;
    const Attachment floats = {Format::rgba32f};
    Framebuffer target = *Framebuffer::create(width, height, {floats, floats, {Format::depth32f}}, samples);
    Frame frame(target, {1, 64});
    const Viewport viewport = exactViewport(width, height);
    frame.clear(glm::vec4(0.25f));
    frame.setViewport(viewport);
    const Mesh mesh = triangles(1500, width, height);
    REQUIRE(frame.draw(mesh, EveryKindFromPixels(viewport), program, state));
    Draw& recorded = frame.internals().draws.front();
    CHECK((recorded.programs->shadeShared != nullptr) == (kQuads > 1));
    Programs alone = *recorded.programs;
    alone.shadeShared = nullptr;
    if (!mayShare) recorded.programs = &alone;
    const Statistics statistics = frame.run();
    return {std::move(target), statistics};
}

}  // namespace

TEST_CASE("shared block: every set of quads goes to every place and back, and leaves the other lanes alone")
{
    Int number;
    for (int i = 0; i < kLanes; ++i) number.set(i, 100 + i);
    const Int others = -1;
    for (unsigned set = 1; set < 1u << kQuads; ++set) {
        unsigned quads = 0;
        for (int q = 0; q < kQuads; ++q) quads |= (set >> q & 1u) * (0xfu << 4 * q);
        for (int taken = 0; taken + countBits(quads) <= kLanes; taken += 4) {
            const WayOfQuads way(quads, taken);
            const Int shared = way.there(number, others);
            CHECK(way.lanes() == ((1u << countBits(quads)) - 1) << taken);
            const Float floats = way.there(Float(number), Float(others)), back = way.back(Float(shared));
            int place = taken;
            for (int i = 0; i < kLanes; ++i) {
                if ((quads >> i & 1u) == 0) continue;
                CHECK(shared[place++] == 100 + i);
                CHECK(back[i] == static_cast<float>(100 + i));
            }
            for (int i = 0; i < kLanes; ++i) {
                if (i < taken || i >= place) CHECK(shared[i] == -1);
                CHECK(floats[i] == static_cast<float>(shared[i]));
            }
        }
    }
}

TEST_CASE("shared block: the same bits and counts as if every block ran by itself, in fewer runs")
{
    const Texture texture = noise(64);
    for (const int samples : {1, 4}) {
        for (const RenderState& state : {kUsual, kOver}) {
            CAPTURE(samples);
            const Textured program = {{.texture = &texture}};
            const Drawn shared = draw(program, state, samples, true), alone = draw(program, state, samples, false);
            CHECK(shared.target.samePixels(alone.target));
            CHECK(shared.statistics.pixelsShaded == alone.statistics.pixelsShaded);
            CHECK(shared.statistics.quadsShaded == alone.statistics.quadsShaded);
            CHECK(shared.statistics.fetches == alone.statistics.fetches);
            if (leavesOut::emptyQuads && kQuads > 1) {
                CHECK(shared.statistics.blocksShaded * 100 < alone.statistics.blocksShaded * (kQuads > 2 ? 75 : 90));
            } else {
                CHECK(shared.statistics.blocksShaded == alone.statistics.blocksShaded);
            }
        }
    }
}

TEST_CASE("shared block: a program without textures runs on its own blocks")
{
    const Drawn shared = draw(Plain{}, kUsual, 1, true), alone = draw(Plain{}, kUsual, 1, false);
    CHECK(shared.target.samePixels(alone.target));
    CHECK(shared.statistics.blocksShaded == alone.statistics.blocksShaded);
}

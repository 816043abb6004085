// Clipping at planes of the vertex program's own: SV_ClipDistance.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "numbers.h"
#include "pipeline_fixture.h"
#include "relief/pipeline/clip.h"

using namespace fixture;

namespace {

// Distances to two planes, which are linear in clip space; and the same numbers to look at.
struct CutInterpolators
{
    SV_POSITION position;
    SV_ClipDistance<0, float2> distance;
    TEXCOORD<0, float2> copy;
};
struct CutVertices
{
    glm::vec4 planes[2];

    CutInterpolators operator()(const TestVertexData& v) const
    {
        const float4 p = FromClip{}(v).position;
        CutInterpolators o;
        o.position = p;
        const auto along = [&](const glm::vec4& plane) {
            return p.x * plane.x + p.y * plane.y + p.z * plane.z + p.w * plane.w;
        };
        o.distance = float2(along(planes[0]), along(planes[1]));
        o.copy = o.distance;
        return o;
    }
};
struct ShowDistance
{
    float4 operator()(const CutInterpolators& i) const { return float4(i.distance, i.copy); }
};
struct CountCut
{
    float4 operator()(const CutInterpolators&) const { return float4(Float(1.0f)); }
};

// The same without cutting.
struct UncutInterpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> distance;
};
struct UncutVertices
{
    CutVertices inner;
    UncutInterpolators operator()(const TestVertexData& v) const
    {
        const CutInterpolators i = inner(v);
        return {i.position, i.copy};
    }
};
struct ShowUncut
{
    float4 operator()(const UncutInterpolators& i) const { return float4(i.distance, 1.0f, 1.0f); }
};

constexpr float kNothing = -1000.0f;

template <class VertexProgram, class FragmentProgram>
Framebuffer draw(const Mesh& mesh, const VertexProgram& vertexProgram, const FragmentProgram& fragmentProgram,
                 const RenderState& state, float clear)
{
    Framebuffer target = makeTarget(64, 64);
    Frame frame(target, {1, 32});
    frame.clear(glm::vec4(clear));
    REQUIRE(frame.draw(mesh, vertexProgram, fragmentProgram, state));
    frame.run();
    return target;
}

glm::vec4 somePlane(Random& random)
{
    const auto number = [&] { return static_cast<float>(random.between(-100, 100)) / 100.0f; };
    return {number(), number(), number() * 0.3f, number() * 0.3f};
}

}  // namespace

TEST_CASE("clip distance: what is left is where the distance is not negative, also through the near plane")
{
    Random random(91);
    int wrong = 0, cut = 0, changed = 0, drawn = 0, added = 0;
    for (int trial = 0; trial < trials(800); ++trial) {
        const CutVertices program = {{somePlane(random), somePlane(random)}};
        Mesh mesh;
        std::array<TestVertex, 3> corner;
        for (TestVertex& v : corner) {
            const auto number = [&](int most) { return static_cast<float>(random.between(-most, most)) / 100.0f; };
            v.position = {number(200), number(200), number(100) + 0.6f, number(60) + (trial % 3 == 0 ? 0.4f : 1.0f)};
        }
        addTriangle(mesh, corner);
        const Framebuffer whole = draw(mesh, UncutVertices{program}, ShowUncut{}, kPaint, kNothing);
        const Framebuffer part = draw(mesh, program, ShowDistance{}, kPaint, kNothing);
        const auto least = [&](std::size_t at) { return std::min(whole.color32f()[at].x, whole.color32f()[at].y); };
        // Beside the cut a pixel's centre may fall to either side, as corners snap to 1/256 pixel.
        const auto isAwayFromCut = [&](std::size_t at) {
            const std::size_t x = at % 64, y = at / 64;
            bool same = x > 0 && x < 63 && y > 0 && y < 63;
            for (const std::size_t neighbour : {at - 1, at + 1, at - 64, at + 64})
                same = same && (least(neighbour) > 0.0f) == (least(at) > 0.0f) && least(neighbour) != kNothing;
            return same;
        };
        for (std::size_t i = 0; i < whole.color32f().size(); ++i) {
            const glm::vec4 before = whole.color32f()[i], after = part.color32f()[i];
            const bool wasDrawn = before.x != kNothing, isDrawn = after.x != kNothing;
            if (wasDrawn && isAwayFromCut(i)) {
                wrong += isDrawn != (least(i) > 0.0f);
                cut += !isDrawn;
            }
            drawn += isDrawn;
            added += isDrawn && !wasDrawn;  // an edge bends where its new corner snaps
            wrong += isDrawn && (after.x != after.z || after.y != after.w);
            changed += isDrawn && wasDrawn && std::abs(after.x - before.x) > 0.02f;
        }
    }
    CHECK(cut > 10000);
    measured("pixels on the wrong side of a plane", wrong, 0);
    measured("share of pixels that only what is cut covers", static_cast<double>(added) / drawn, 5e-5);
    measured("distances that the cut changed by more than 0.02", changed, 0);
}

TEST_CASE("clip distance: neighbours that are cut still meet")
{
    Random random(92);
    int twice = 0, missed = 0;
    for (int trial = 0; trial < trials(200); ++trial) {
        const CutVertices program = {{somePlane(random), glm::vec4(0, 0, 0, 1)}};
        const Viewport viewport = exactViewport(64, 64);
        const Grid grid(random.between(1, 9), 64, [&](Point p, int cell) { return jitter(random, p, cell); });
        Mesh mesh;
        grid.triangulate([&] { return random.chance(2); },
                         [&](const Corners& c) {
                             std::array<TestVertex, 3> v;
                             for (std::size_t k = 0; k < 3; ++k) v[k].position = clipPosition(c[k], viewport);
                             addTriangle(mesh, v);
                         });
        const Framebuffer counts = draw(mesh, program, CountCut{}, kCount, 0.0f);
        const Framebuffer distances = draw(mesh, UncutVertices{program}, ShowUncut{}, kPaint, kNothing);
        for (std::size_t i = 0; i < counts.color32f().size(); ++i) {
            twice += counts.color32f()[i].x > 1.0f;
            missed += counts.color32f()[i].x < 1.0f && distances.color32f()[i].x > 0.01f;
        }
    }
    measured("pixels hit twice", twice, 0);
    measured("pixels missed", missed, 0);
}

TEST_CASE("clip distance: infinities and NaN cut, or do not, and nothing breaks (S-209)")
{
    struct Given
    {
        float distance;
        CutInterpolators operator()(const TestVertexData& v) const
        {
            CutInterpolators o;
            o.position = FromClip{}(v).position;
            o.distance = float2(Float(distance), v.value.x);
            return o;
        }
    };
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, 0.5f, 1}, glm::vec4(1.0f)}, {{-1, 3, 0.5f, 1}, glm::vec4(kInfinity)},
                {{3, -1, 0.5f, 1}, glm::vec4(1e30f)});
    CHECK(pixelsNotEqualTo(draw(mesh, Given{1.0f}, CountCut{}, kCount, 0.0f), 1.0f) == 0);
    CHECK(pixelsNotEqualTo(draw(mesh, Given{0.0f}, CountCut{}, kCount, 0.0f), 1.0f) == 0);
    CHECK(pixelsNotEqualTo(draw(mesh, Given{kInfinity}, CountCut{}, kCount, 0.0f), 1.0f) == 0);
    CHECK(pixelsNotEqualTo(draw(mesh, Given{-1e-40f}, CountCut{}, kCount, 0.0f), 0.0f) == 0);
    CHECK(pixelsNotEqualTo(draw(mesh, Given{-kInfinity}, CountCut{}, kCount, 0.0f), 0.0f) == 0);
    CHECK(pixelsNotEqualTo(draw(mesh, Given{kNan}, CountCut{}, kCount, 0.0f), 0.0f) == 0);
}

TEST_CASE("clip distance: eight planes that all but coincide leave no more corners than there is room for")
{
    // Found by a search for many: each plane cuts off several corners that lie on the one before but for their
    // rounding.
    const glm::vec4 corners[3] = {{0x1.51fd22p+4f, -0x1.d5e5e6p+2f, 0x1.8c2ad2p+0f, -0x1.2d12e4p+6f},
                                  {0x1.d39176p+2f, 0x1.20b57ap+6f, 0x1.55a1d8p-3f, 0x1.022bc2p+2f},
                                  {0x1.125cc8p+6f, -0x1.63488ep+6f, -0x1.6d20bp+0f, 0x1.7d0cccp+6f}};
    const ClipLimits limits = {0.01f,
                               0.01f,
                               true,
                               {{0x1.9641e4p+0f, 0x1.4dcfa6p-1f, -0x1.b1f42ep+0f},
                                {0x1.9641e2p+0f, 0x1.4dcfb4p-1f, -0x1.b1f42ep+0f},
                                {0x1.9641e8p+0f, 0x1.4dcfacp-1f, -0x1.b1f434p+0f},
                                {0x1.964174p+0f, 0x1.4dceb2p-1f, -0x1.b1f342p+0f},
                                {0x1.9641dcp+0f, 0x1.4dcfcap-1f, -0x1.b1f428p+0f},
                                {0x1.9641e8p+0f, 0x1.4dcfaep-1f, -0x1.b1f434p+0f},
                                {0x1.9641e6p+0f, 0x1.4dcfaap-1f, -0x1.b1f432p+0f},
                                {0x1.9641dep+0f, 0x1.4dcfa8p-1f, -0x1.b1f42ap+0f}},
                               8};
    std::array<ClipVertex, kMaxClippedVertices> polygon;
    CHECK(clipTriangle(corners, limits, polygon) == kMaxClippedVertices);
}

TEST_CASE("clip distance: a line is cut, too")
{
    Mesh mesh;
    addTriangle(mesh, {{-1, 0.01f, 0.5f, 1}}, {{1, 0.01f, 0.5f, 1}}, {{1, 0.01f, 0.5f, 1}});
    mesh.indices = {0, 1};
    RenderState state = kPaint;
    state.primitive = Primitive::lines;
    const CutVertices program = {{{1, 0, 0, 0}, {0, 0, 0, 1}}};  // the right half
    const Framebuffer target = draw(mesh, program, CountCut{}, state, 0.0f);
    int left = 0, right = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) (x < 32 ? left : right) += pixel(target, x, y).x == 1.0f;
    }
    CHECK(left == 0);
    CHECK(right >= 31);
}

// Draws: what programs are given and what becomes of what they give, beyond what one step of the pipeline's tests show.
#include "relief/pipeline/draw.h"

#include "pipeline_fixture.h"
#include "relief/texture/sampler.h"

using namespace fixture;

namespace {

// Over the whole screen at any w, with the value's range across it.
Mesh screen(float depth = 0.5f, const glm::vec4& value = glm::vec4(1.0f))
{
    Mesh mesh;
    addTriangle(mesh, {{-1, -1, depth, 1}, value}, {{-1, 3, depth, 1}, value}, {{3, -1, depth, 1}, value});
    return mesh;
}

// A floor from behind the eye to far away: clipped at the near plane.
Mesh floorMesh(const glm::vec4& near, const glm::vec4& far)
{
    Mesh mesh;
    const TestVertex a = {{-30, -1, -5.1f, -5}, near}, b = {{30, -1, -5.1f, -5}, near};
    const TestVertex c = {{30, -1, 49.9f, 50}, far}, d = {{-30, -1, 49.9f, 50}, far};
    addTriangle(mesh, a, d, c);
    addTriangle(mesh, a, c, b);
    return mesh;
}

struct Affine
{
    SV_POSITION position;
    noperspective<TEXCOORD<0, float4>> value;
};
struct GiveAffine
{
    Affine operator()(const TestVertexData& v) const
    {
        return {float4(v.position.x, v.position.y, v.position.z, v.w.x), v.value};
    }
};
struct ShowAffine
{
    float4 operator()(const Affine& i) const { return i.value; }
};

}  // namespace

TEST_CASE("draw: a texture level that is made inside a block is made as anywhere, and counts nothing")
{
    // Level 0 samples another texture while it is made, each column of a block from another level; one pixel of the
    // block that asks for it is covered.
    const std::vector<std::uint8_t> white(16 * 16 * 4, 255);
    const Texture source = *Texture::fromRgba8(16, 16, white, ColorSpace::linear);
    const auto make = [&source](int level, const MipLevel*) {
        MipLevel made(TexelFormat::rgba8, 16 >> level, 16 >> level);
        for (int y = 0; y < made.height(); ++y) {
            for (int x = 0; x < made.width(); x += std::min(kLanes, made.width())) {
                const float2 uv = float2(Float(laneXs() + x), Float(laneYs() + y)) / 16.0f;
                const float4 c = tex2Dlod({.texture = &source}, float4(uv.x, uv.y, 0.0f, Float(laneXs())));
                for (int i = 0; i < std::min(kLanes, made.width()); ++i) {
                    for (int k = 0; k < 4; ++k)
                        made.texel<std::uint8_t>(x + i, y)[k] = static_cast<std::uint8_t>(c[k][i] * 255.0f);
                }
            }
        }
        made.fillFrame();
        return made;
    };
    struct Sample
    {
        sampler2D texture;
        float4 operator()(const Interpolated&) const { return tex2D(texture, float2(0.5f)); }
    };
    const Texture made = *Texture::fromLevels(TexelFormat::rgba8, 16, 16, make);
    Framebuffer target = makeTarget(8, 8);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(0.0f));
    frame.setScissor({2, 2, 3, 3});
    const Mesh mesh = screen();
    REQUIRE(frame.draw(mesh, FromClip{}, Sample{{.texture = &made, .mipmaps = false}}, kPaint).has_value());
    const Statistics statistics = frame.run();
    int black = 0;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) black += made.texel(x, y) != glm::vec4(1.0f);
    }
    measured("texels that are black", black, 0);
    CHECK(statistics.fetches.trilinear == 4);  // of the one quad
}

TEST_CASE("draw: a constant attribute keeps its bits in clipped triangles, too (S-402)")
{
    struct Differs
    {
        float4 constant;
        float4 operator()(const Interpolated& i) const
        {
            Mask same = true;
            for (int c = 0; c < 4; ++c) same &= i.value[c] == constant[c];
            return float4(select(same, Float(1.0f), Float(2.0f)));
        }
    };
    const glm::vec4 constant = {3.0f, 0.1f, 1e-30f, -7.77f};
    const Mesh mesh = floorMesh(constant, constant);
    Framebuffer target = makeTarget(200, 150);
    drawClip<kPaint>(target, mesh, Differs{broadcast(constant)});
    int wrong = 0, covered = 0;
    for (const glm::vec4& c : target.color32f()) {
        wrong += c.x == 2.0f;
        covered += c.x == 1.0f;
    }
    measured("pixels with other bits", wrong, 0);
    CHECK(covered > 5000);
}

TEST_CASE("draw: noperspective is linear on the screen, clipped or not")
{
    // Against the plane through the three corners on screen: with all w above 0 these are there.
    Random random(404);
    double worst = 0.0;
    int checked = 0, clipped = 0;
    for (int trial = 0; trial < trials(400); ++trial) {
        Mesh mesh;
        TestVertex v[3];
        glm::dvec3 plane[3];
        for (int k = 0; k < 3; ++k) {
            const float w = random.real(0.5f, 8.0f);
            v[k] = {{random.real(-2, 2) * w, random.real(-2, 2) * w, random.real(-0.3f, 1.5f) * w, w},
                    glm::vec4(random.real(0, 1))};
            plane[k] = {(static_cast<double>(v[k].position.x) / w + 1.0) * 24.0,
                        (1.0 - static_cast<double>(v[k].position.y) / w) * 24.0, v[k].value.x};
        }
        addTriangle(mesh, v[0], v[1], v[2]);
        Framebuffer target = makeTarget(48, 48);
        Frame frame(target, {1, 64});
        frame.clear(glm::vec4(-9.0f));
        REQUIRE(frame.draw(mesh, GiveAffine{}, ShowAffine{}, kPaint).has_value());
        clipped += frame.run().trianglesClipped > 0;
        const glm::dvec3 p = plane[1] - plane[0], q = plane[2] - plane[0];
        const double area = p.x * q.y - p.y * q.x;
        if (std::fabs(area) < 100.0) continue;  // of slivers, snapping moves the plane
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 48; ++x) {
                if (pixel(target, x, y).x == -9.0f) continue;
                const double dx = x + 0.5 - plane[0].x, dy = y + 0.5 - plane[0].y;
                const double b = (dx * q.y - dy * q.x) / area, c = (p.x * dy - p.y * dx) / area;
                worst = std::fmax(
                    worst, std::fabs(plane[0].z + b * p.z + c * q.z - static_cast<double>(pixel(target, x, y).x)));
                ++checked;
            }
        }
    }
    measured("error, of 1", worst, 0.02);  // corners move by up to 1/512 px in a plane that rises by 1 in some 10 px
    CHECK(checked > trials(400) * 50);
    CHECK(clipped > trials(400) / 4);
}

TEST_CASE("draw: an interpolator that nobody assigns is 0")
{
    struct Forgetful
    {
        Interpolated operator()(const TestVertexData& v) const
        {
            Interpolated i;
            i.position = float4(v.position.x, v.position.y, v.position.z, v.w.x);
            return i;
        }
    };
    Framebuffer target = makeTarget(8, 8);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(1.0f));
    const Mesh mesh = screen();
    REQUIRE(frame.draw(mesh, Forgetful{}, Value{}, kPaint).has_value());
    frame.run();
    CHECK(pixelsNotEqualTo(target, 0.0f) == 0);
}

TEST_CASE("draw: a vertex's neighbours do not depend on other draws")
{
    // HLSL has no ddx in vertex programs. Here it compares a vertex with its neighbours in fours, which must at least
    // be the same ones in every frame.
    struct Differences
    {
        Interpolated operator()(const TestVertexData& v) const
        {
            return {float4(v.position.x, v.position.y, v.position.z, v.w.x), float4(ddx(v.value.x))};
        }
    };
    Mesh mesh;
    for (int i = 0; i < 20; ++i) {
        const auto n = static_cast<float>(i * i);
        addTriangle(mesh, {{-1, -1, 0.5f, 1}, glm::vec4(n)}, {{-1, 3, 0.5f, 1}, glm::vec4(2 * n)},
                    {{3, -1, 0.5f, 1}, glm::vec4(n)});
    }
    std::uint64_t first = 0;
    int other = 0;
    for (const int before : {0, 1, 2, 3, 2045, 2046, 2047}) {
        Mesh earlier;
        earlier.positions.assign(static_cast<std::size_t>(before), glm::vec3(9.0f));
        earlier.normals.assign(static_cast<std::size_t>(before), glm::vec3(1.0f));
        earlier.tangents.assign(static_cast<std::size_t>(before), glm::vec4(1.0f));
        if (before > 0) earlier.indices = {0, 0, 0};
        Framebuffer target = makeTarget(16, 16);
        Frame frame(target, {1, 16});
        frame.clear(glm::vec4(0.0f));
        REQUIRE(frame.draw(earlier, FromClip{}, Value{}, kCount).has_value());
        REQUIRE(frame.draw(mesh, Differences{}, Value{}, kCount).has_value());
        frame.run();
        if (before == 0) first = hashOf(target);
        other += hashOf(target) != first;
    }
    measured("other hashes", other, 0);
}

TEST_CASE("draw: ddx of SV_POSITION.z is the plane's slope on edges, too")
{
    struct Slope
    {
        float4 operator()(const Interpolated& i) const { return float4(ddx(i.position.z)); }
    };
    // Depth rises by 1/124 from pixel to pixel. The nearest lie on the left edge, in the middle of quads.
    Mesh mesh;
    addTriangle(mesh, {{1, 0, 0.25f, 1}, {}}, {{63, 0, 0.75f, 1}, {}}, {{1, 62, 0.25f, 1}, {}});
    Framebuffer target = makeTarget(64, 64);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(-1.0f));
    REQUIRE(frame.draw(mesh, FromPixels({0, 0, 64, 64}), Slope{}, kPaint).has_value());
    frame.run();
    int wrong = 0, covered = 0;
    for (const glm::vec4& c : target.color32f()) {
        if (c.x == -1.0f) continue;
        ++covered;
        wrong += std::fabs(c.x - 1.0f / 124) > 1e-6f;
    }
    measured("pixels with another slope", wrong, 0);
    CHECK(covered > 1800);
}

TEST_CASE("draw: hidden pixels are not shaded by programs that discard either, and the picture is the same")
{
    struct Holes
    {
        float4 operator()(const Interpolated& i, Discard& discard) const
        {
            discard(floor(i.position.x / 3.0f) * 3.0f == i.position.x - 0.5f);
            return i.value;
        }
    };
    for (const bool frontFirst : {true, false}) {
        const Mesh front = screen(0.25f, glm::vec4(1.0f)), back = screen(0.75f, glm::vec4(2.0f));
        Framebuffer target = makeTarget(60, 40);
        Frame frame(target, {1, 16});
        frame.clear(glm::vec4(0.0f));
        REQUIRE(frame.draw(frontFirst ? front : back, FromClip{}, Holes{}, kDepthTested).has_value());
        REQUIRE(frame.draw(frontFirst ? back : front, FromClip{}, Value{}, kDepthTested).has_value());
        const Statistics statistics = frame.run();
        for (int x = 0; x < 60; ++x) REQUIRE(pixel(target, x, 20).x == (frontFirst && x % 3 == 0 ? 2.0f : 1.0f));
        CHECK(statistics.pixelsShaded == (frontFirst ? 60 * 40 + 20 * 40 : 2 * 60 * 40));
        CHECK(statistics.pixelsHidden == (frontFirst ? 40 * 40 : 0));

        // The other way round: the one behind has the holes.
        Frame second(target, {1, 16});
        second.clear(glm::vec4(0.0f));
        REQUIRE(second.draw(frontFirst ? front : back, FromClip{}, Value{}, kDepthTested).has_value());
        REQUIRE(second.draw(frontFirst ? back : front, FromClip{}, Holes{}, kDepthTested).has_value());
        CHECK(second.run().pixelsShaded == (frontFirst ? 60 * 40 : 2 * 60 * 40));
    }
}

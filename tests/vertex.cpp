// The vertex stage: snapping, codes, screen positions, and what a vertex program gets to read.
#include "relief/pipeline/vertex.h"

#include "numbers.h"
#include "pipeline_fixture.h"
#include "relief/pipeline/viewport_transform.h"

using namespace fixture;

namespace {

struct AllStreams
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct AllOut
{
    TEXCOORD<0, float4> tangent;
    SV_POSITION position;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float2> uv;
    TEXCOORD<3, Float> w;
};

struct TakeAll
{
    float4 operator()(const AllOut& i) const { return i.tangent; }
};

struct PassOn
{
    AllOut operator()(const AllStreams& v) const { return {v.tangent, v.position, v.normal, v.uv, v.position.w}; }
};

}  // namespace

TEST_CASE("vertex: snapping rounds to the nearest 1/256, ties to even, on both sides of zero (S-313)")
{
    Random random(30);
    int wrong = 0;
    for (int trial = 0; trial < trials(1000000) / kLanes; ++trial) {
        float pixels[kLanes];
        for (float& p : pixels) {
            const int code = random.between(-kGuardBand * 256, kGuardBand * 256);
            switch (random.between(0, 4)) {
                case 0:
                    p = static_cast<float>(code % 8192) / 256.0f + 1.0f / 512.0f;
                    break;  // a tie
                case 1:
                    p = std::nextafter(static_cast<float>(code % 8192) / 256.0f + 1.0f / 512.0f, 0.0f);
                    break;
                case 2:
                    p = static_cast<float>(code) / 256.0f;
                    break;
                case 3:
                    p = random.real(-70.0f, 70.0f);
                    break;
                default:
                    p = random.real(-32767.0f, 32767.0f);
                    break;
            }
        }
        const Int snapped = ViewportTransform::snap(Float::load(pixels));
        for (int lane = 0; lane < kLanes; ++lane) {
            wrong += snapped[lane] != static_cast<int>(std::nearbyint(static_cast<double>(pixels[lane]) * 256.0));
        }
    }
    measured("positions off", wrong, 0);

    const auto snap = [](float p) { return ViewportTransform::snap(p)[0]; };
    CHECK(snap(-0.0f) == 0);
    CHECK(snap(1.0f / 512.0f) == 0);
    CHECK(snap(-1.0f / 512.0f) == 0);
    CHECK(snap(3.0f / 512.0f) == 2);
    CHECK(snap(-3.0f / 512.0f) == -2);
    CHECK(snap(std::nextafter(1.0f / 512.0f, 1.0f)) == 1);
    CHECK(snap(std::nextafter(-1.0f / 512.0f, -1.0f)) == -1);
}

TEST_CASE("vertex: no coordinate leaves the guard band (S-314)")
{
    const int limit = kGuardBand * 256;
    for (const float p : {32767.0f, 32768.0f, 2147483648.0f, 3e9f, 1e30f, 3.4e38f, kInfinity}) {
        CHECK(ViewportTransform::snap(p)[0] == limit);
        CHECK(ViewportTransform::snap(-p)[0] == -limit);
    }
    const int nan = ViewportTransform::snap(kNan)[0];
    CHECK(nan >= -limit);
    CHECK(nan <= limit);
}

TEST_CASE("vertex: screen positions of the viewport's corners and centre")
{
    for (const Viewport& v : {Viewport{0, 0, 64, 32}, Viewport{-7, 5, 33, 17}, Viewport{1000, -2000, 16384, 1}}) {
        FrontEnd frontEnd({{-1, 1, 0, 1}, {1, -1, 1, 1}, {0, 0, 0.25f, 1}, {2, 2, 1, 4}, {-4, 4, 0, 4}}, {}, v);
        frontEnd.project();
        const auto& s = frontEnd.screen;
        CHECK(s[0].x == v.x * 256);
        CHECK(s[0].y == v.y * 256);
        CHECK(s[1].x == (v.x + v.width) * 256);
        CHECK(s[1].y == (v.y + v.height) * 256);
        CHECK(s[2].x == v.x * 256 + v.width * 128);
        CHECK(s[2].y == v.y * 256 + v.height * 128);
        CHECK(s[3].x == v.x * 256 + v.width * 192);
        CHECK(s[3].y == v.y * 256 + v.height * 64);
        CHECK(s[4].x == s[0].x);
        CHECK(s[4].y == s[0].y);
        CHECK(s[0].z == 0.0f);
        CHECK(s[1].z == 1.0f);
        CHECK(s[2].z == 0.25f);
        CHECK(s[3].z == 0.25f);
        CHECK(s[3].invW == 0.25f);
    }
}

TEST_CASE("vertex: codes say on which side of what a position lies, limits included in the inside (S-204, S-208)")
{
    using namespace vertex_code;
    struct Case
    {
        glm::vec4 position;
        int expected;
    };
    const Case cases[] = {
        {{0, 0, 0.5f, 1}, 0},
        {{-1, -1, 0, 1}, 0},
        {{1, 1, 1, 1}, 0},
        {{-1.0000001f, 0, 0, 1}, outsideLeft},
        {{1.0000001f, 0, 0, 1}, outsideRight},
        {{0, -1.0000001f, 0, 1}, outsideBottom},
        {{0, 1.0000001f, 0, 1}, outsideTop},
        {{0, 0, -1e-45f, 1}, outsideNear},
        {{0, 0, 1.0000001f, 1}, outsideFar},
        {{0, 0, -0.0f, 1}, 0},
        {{5000, 0, 0, 1}, outsideRight | beyondGuardBand},
        {{0, -5000, 0, 1}, outsideBottom | beyondGuardBand},
        {{500, 0, 0, 1}, outsideRight},
        {{0, 0, 0, 0}, smallW | 0},
        {{0, 0, 0, 1e-40f}, smallW},
        {{0, 0, 0, 1.17549435e-38f}, smallW},
        {{0, 0, 0, 1e-30f}, 0},
        {{0, 0, 0, -1},
         smallW | beyondGuardBand | outsideLeft | outsideRight | outsideBottom | outsideTop | outsideFar},
        {{3.4e34f, 0, 0, 3.4e34f}, 0},
    };
    for (const Case& c : cases) {
        CAPTURE(c.position.x);
        CAPTURE(c.position.y);
        CAPTURE(c.position.z);
        CAPTURE(c.position.w);
        FrontEnd frontEnd({c.position}, {}, {0, 0, 16, 16});
        frontEnd.project();
        CHECK(frontEnd.codes[0] == c.expected);
    }
    for (int i = 0; i < 4; ++i) {
        glm::vec4 p = {0, 0, 0.5f, 1};
        for (const float bad : {kNan, kInfinity, -kInfinity}) {
            p[i] = bad;
            FrontEnd frontEnd({p}, {}, {0, 0, 16, 16});
            frontEnd.project();
            CHECK((frontEnd.codes[0] & (vertex_code::nan | infinite)) ==
                  (std::isnan(bad) ? vertex_code::nan : infinite));
        }
    }

    // Without depth clipping near and far are no planes.
    FrontEnd frontEnd({{0, 0, -2, 1}, {0, 0, 2, 1}}, {}, {0, 0, 16, 16});
    frontEnd.draw.depthClip = false;
    frontEnd.project();
    CHECK(frontEnd.codes[0] == 0);
    CHECK(frontEnd.codes[1] == 0);
}

TEST_CASE("vertex: a program reads the mesh's streams, and its results are stored vertex by vertex")
{
    Mesh mesh;
    const int count = 3 * kLanes + 5;
    for (int i = 0; i < count; ++i) {
        const auto v = static_cast<float>(i);
        mesh.positions.emplace_back(v / 100, 0.01f, 0.02f);
        mesh.normals.emplace_back(v + 0.1f, v + 0.2f, v + 0.3f);
        mesh.tangents.emplace_back(v + 1000, v + 2000, v + 3000, v + 4000);
        mesh.uvs.emplace_back(-v, v * 2);
    }
    mesh.indices = {0, 1, 2};
    const PassOn passOn;
    const TakeAll takeAll;
    Expected<Draw> draw = makeDraw(detail::kPrograms<PassOn, TakeAll>, &passOn, &takeAll, mesh, {}, {});
    REQUIRE(draw.has_value());
    DrawGeometry& g = draw->geometry;
    CHECK(g.componentCount == 10);
    CHECK(g.componentStride == 12);
    FrontEnd frontEnd(std::vector<glm::vec4>(static_cast<std::size_t>(count)), {}, {0, 0, 16, 16});
    std::vector<float> components(static_cast<std::size_t>(count) * 12, -7.0f);
    g.clip = frontEnd.clip.data();
    g.screen = frontEnd.screen.data();
    g.codes = frontEnd.codes.data();
    g.components = components.data();
    g.viewport = {0, 0, 16, 16};

    // Only a part, which begins and ends within a block of lanes.
    const int first = 2, last = count - 2;
    shadeVertices(*draw, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first));
    int wrong = 0;
    for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const float* c = components.data() + at * 12;
        if (i < first || i >= last) {
            for (int k = 0; k < 12; ++k) wrong += c[k] != -7.0f;
            continue;
        }
        for (int k = 0; k < 4; ++k) wrong += c[k] != mesh.tangents[at][k];
        for (int k = 0; k < 3; ++k) wrong += c[4 + k] != mesh.normals[at][k];
        for (int k = 0; k < 2; ++k) wrong += c[7 + k] != mesh.uvs[at][k];
        wrong += c[9] != 1.0f;  // a position's w
        wrong += frontEnd.clip[at] != glm::vec4(mesh.positions[at], 1.0f);
    }
    CHECK(wrong == 0);
}

TEST_CASE("vertex: every vertex of a mesh of several chunks is shaded once (S-112)")
{
    // 5000 vertices in two draws; every vertex makes a triangle with the two beside it, one pixel high.
    Framebuffer target = makeTarget(64, 64);
    Mesh mesh;
    for (int i = 0; i < 2 * static_cast<int>(kVerticesPerChunk) + 900; ++i) {
        const int x = i % 64, y = i / 64 % 64;
        mesh.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.5f);
        mesh.normals.emplace_back(1.0f, 0.0f, 0.0f);
        mesh.tangents.emplace_back(static_cast<float>(i), 0.0f, 0.0f, 1.0f);
    }
    Frame frame(target, {3, 64});
    frame.clear(glm::vec4(0.0f));
    mesh.indices = {0, 63, 64 * 63};
    frame.draw(mesh, FromPixels({0, 0, 64, 64}), One{}, kCount);
    frame.draw(mesh, FromPixels({0, 0, 64, 64}), One{}, kCount);
    const Statistics statistics = frame.run();
    CHECK(statistics.verticesShaded == 2 * mesh.positions.size());
    checkInvariants(target, statistics);
    checkRunsAgain(frame, target);
}

TEST_CASE("vertex: a million equal vertices, and none (S-112)")
{
    Framebuffer target = makeTarget(16, 16);
    Mesh mesh;
    const auto count = static_cast<std::size_t>(trials(1000000, 1000000));
    mesh.positions.assign(count, glm::vec3(3.0f, 3.0f, 0.5f));
    mesh.normals.assign(count, glm::vec3(1.0f, 0.0f, 0.0f));
    for (std::uint32_t i = 0; i + 3 <= count; ++i) mesh.indices.push_back(i);
    const Statistics same = drawPixels(target, mesh);
    CHECK(same.culledFacing == same.trianglesSubmitted);
    CHECK(pixelsNotEqualTo(target, 0.0f) == 0);

    Mesh empty;
    empty.indices = {0, 1, 2};
    const Statistics none = drawPixels(target, empty);
    CHECK(none.verticesShaded == 0);
    CHECK(none.rasterised == 0);
    checkInvariants(target, none);
    CHECK(pixelsNotEqualTo(target, 0.0f) == 0);
}

// Vertex streams: what a draw finds in a mesh, and what it says where it does not; parts of a mesh, and instances.
#include "relief/mesh/vertex_stream.h"

#include "pipeline_fixture.h"
#include "relief/pipeline/vertex.h"

using namespace fixture;

namespace {

struct Everything
{
    POSITION position;
    TEXCOORD<0, float4> uv;
    TEXCOORD<1, float2> secondUv;
    COLOR<0, float4> color;
    TEXCOORD<2, Int> material;
    SV_VertexID vertex;
    SV_InstanceID instance;
};

struct Out
{
    SV_POSITION position;
    COLOR<0, float4> a;
    COLOR<1, float4> b;
    nointerpolation<TEXCOORD<0, Int>> number;
};

// Shows one thing or another as a colour.
struct ShowA
{
    float4 operator()(const Out& i) const { return i.a; }
};
struct ShowB
{
    float4 operator()(const Out& i) const { return i.b; }
};
struct ShowNumber
{
    float4 operator()(const Out& i) const { return float4(Float(static_cast<const Int&>(i.number))); }
};

struct PassOn
{
    Out operator()(Everything v) const
    {
        Out o;
        o.position = v.position;
        o.a = float4(v.uv);
        o.b = float4(v.secondUv.x, v.secondUv.y, v.color.x, Float(static_cast<const Int&>(v.material)));
        o.number = static_cast<const Int&>(v.vertex) + 100 * static_cast<const Int&>(v.instance);
        return o;
    }
};

// A triangle over the whole screen.
Mesh screen()
{
    Mesh mesh;
    mesh.name = "screen";
    mesh.positions = {{-1, -1, 0.5f}, {-1, 3, 0.5f}, {3, -1, 0.5f}};
    mesh.uvs.assign(3, {0.25f, 0.5f});
    mesh.colors.assign(3, {0.75f, 0, 0, 1});
    mesh.streams.push_back({"TEXCOORD", 1, 2, {3, 4, 3, 4, 3, 4}, {}, false});
    mesh.streams.push_back({"TEXCOORD", 2, 1, {}, {7, 7, 7}, false});
    mesh.indices = {0, 1, 2};
    return mesh;
}

template <class FragmentProgram>
glm::vec4 drawn(const Mesh& mesh, const FragmentProgram& fragment, const MeshPart& part = {})
{
    Framebuffer target = makeTarget(9, 9);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(-1.0f));
    REQUIRE(frame.draw(mesh, PassOn{}, fragment, kPaint, part).has_value());
    frame.run();
    return pixel(target, 4, 4);
}

std::string errorOf(const Mesh& mesh, const MeshPart& part = {}, const RenderState& state = {})
{
    Framebuffer target = makeTarget(9, 9);
    Frame frame(target, {1, 16});
    frame.clear(glm::vec4(0.0f));
    const Expected<void> result = frame.draw(mesh, PassOn{}, ShowA{}, state, part);
    frame.run();
    CHECK(frame.problem() == (result ? "" : result.error().message));
    return result ? "" : result.error().message;
}

bool names(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("vertex streams: what a stream does not hold is (0, 0, 0, 1), as in Direct3D")
{
    CHECK(drawn(screen(), ShowA{}) == glm::vec4(0.25f, 0.5f, 0.0f, 1.0f));
}

TEST_CASE("vertex streams: colours, a second uv set, and integers")
{
    CHECK(drawn(screen(), ShowB{}) == glm::vec4(3.0f, 4.0f, 0.75f, 7.0f));
}

TEST_CASE("vertex streams: any number of vertices, whole lanes or not, to the last word of a stream")
{
    for (const std::size_t count : {std::size_t{3}, std::size_t{kLanes}, std::size_t{3 * kLanes + 1}}) {
        for (std::size_t components = 1; components <= 4; ++components) {
            // The words lie at the end of their memory: reading beyond it would be seen by the address sanitizer.
            std::vector<std::uint32_t> words(count * components);
            for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint32_t>(i + 1);
            const StreamView stream = {"TEXCOORD", 0, static_cast<int>(components), true, false, words.data(), count};
            int wrong = 0;
            for (std::size_t first = 0; first < count; first += kLanes) {
                const auto n = static_cast<std::uint32_t>(std::min<std::size_t>(kLanes, count - first));
                std::uint32_t element[kLanes] = {};
                for (std::uint32_t i = 0; i < n; ++i) element[i] = static_cast<std::uint32_t>(first) + i;
                Float lanes[4];
                readStream(stream, element, n, lanes);
                for (std::uint32_t i = 0; i < n; ++i) {
                    for (std::size_t c = 0; c < 4; ++c) {
                        const int expected =
                            c < components ? static_cast<int>((first + i) * components + c + 1) : c == 3;
                        wrong += asInt(lanes[c])[static_cast<int>(i)] != expected;
                    }
                }
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("vertex streams: a mesh without what VertexData asks for is one sentence")
{
    Mesh mesh = screen();
    CHECK(errorOf(mesh).empty());
    mesh.colors.clear();
    CHECK(errorOf(mesh) ==
          "draw of mesh 'screen': it has no COLOR0, which VertexData asks for; give the mesh that stream, or take the "
          "field out");
    mesh = screen();
    mesh.uvs.pop_back();
    CHECK(names(errorOf(mesh), "its TEXCOORD0 holds 2 elements for 3 vertices"));
    mesh = screen();
    mesh.streams[1] = {"TEXCOORD", 2, 1, {7, 7, 7}, {}, false};
    CHECK(names(errorOf(mesh), "its TEXCOORD2 holds floats"));
    mesh = screen();
    mesh.streams[0].perInstance = true;
    CHECK(errorOf(mesh, {.instances = 3}).empty());
    CHECK(names(errorOf(mesh, {.instances = 4}), "3 elements for 4 instances"));
    CHECK(names(errorOf(mesh, {.first = 1, .count = 3}), "is not within its 3 indices"));
    CHECK(names(errorOf(mesh, {.first = 4}), "the part from index 4 on is not within its 3 indices; choose"));
    CHECK(names(errorOf(mesh, {}, {.lineWidth = 3}), "1 or 2 pixels wide"));
    mesh = screen();
    CHECK(names(errorOf(mesh, {.instances = 0x7fffffff}), "more than 2^31"));
    mesh.streams.push_back(mesh.streams[1]);
    CHECK(names(errorOf(mesh), "it has two streams TEXCOORD2; take one of them out"));
    mesh = screen();
    mesh.streams.push_back({"TEXCOORD", 0, 2, {3, 4, 3, 4, 3, 4}, {}, false});
    CHECK(names(errorOf(mesh), "it has two streams TEXCOORD0"));  // one of them is mesh.uvs
    for (const int components : {0, 5}) {
        mesh = screen();
        mesh.streams[0].components = components;
        CHECK(
            names(errorOf(mesh), "its stream TEXCOORD1 has " + std::to_string(components) + " components; give it 1"));
    }
}

TEST_CASE("vertex streams: a part of a mesh draws its indices alone, and shades their vertices alone")
{
    // Three triangles, one above the other, of nine vertices.
    Mesh mesh;
    for (int i = 0; i < 3; ++i) {
        const auto depth = 0.25f * static_cast<float>(i);
        addTriangle(mesh, {{-1, -1, depth, 1}, glm::vec4(depth)}, {{-1, 3, depth, 1}, glm::vec4(depth)},
                    {{3, -1, depth, 1}, glm::vec4(depth)});
    }
    Framebuffer target = makeTarget(9, 9);
    for (std::uint32_t i = 0; i < 3; ++i) {
        Frame frame(target, {1, 16});
        frame.clear(glm::vec4(-1.0f));
        REQUIRE(frame.draw(mesh, FromClip{}, Value{}, kPaint, {.first = 3 * i, .count = 3}).has_value());
        const Statistics statistics = frame.run();
        CHECK(statistics.verticesShaded == 3);
        CHECK(statistics.trianglesSubmitted == 1);
        CHECK(pixelsNotEqualTo(target, 0.25f * static_cast<float>(i)) == 0);
    }
}

TEST_CASE("vertex streams: instances are drawn one after the other, each with its number and its elements")
{
    struct Instanced
    {
        POSITION position;
        TEXCOORD<0, float2> place;
        SV_InstanceID instance;
    };
    struct Place
    {
        Out operator()(Instanced v) const
        {
            Out o;
            o.position = float4(v.position.x + v.place.x, v.position.y + v.place.y, 0.5f, 1.0f);
            o.number = static_cast<const Int&>(v.instance) + 1;
            return o;
        }
    };
    // A pixel for each instance, in a row of 100.
    constexpr int count = 100;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 2, 0}, {0.02f, 2, 0}, {0.02f, 0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    VertexStream places = {"TEXCOORD", 0, 2, {}, {}, true};
    for (int i = 0; i < count; ++i) {
        places.floats.push_back(-1.0f + 0.02f * static_cast<float>(i));
        places.floats.push_back(-1.0f);
    }
    mesh.streams.push_back(places);
    Framebuffer target = makeTarget(count, 3);
    Frame frame(target, {3, 16});
    frame.clear(glm::vec4(0.0f));
    REQUIRE(frame.draw(mesh, Place{}, ShowNumber{}, kPaint, {.instances = count}).has_value());
    const Statistics statistics = frame.run();
    CHECK(statistics.verticesShaded == 4 * count);
    CHECK(statistics.trianglesSubmitted == 2 * count);
    int wrong = 0;
    for (int x = 0; x < count; ++x) wrong += pixel(target, x, 1).x != static_cast<float>(x + 1);
    CHECK(wrong == 0);
}

TEST_CASE("vertex streams: nointerpolation is the first vertex's, bit for bit, however a triangle is clipped (S-408)")
{
    struct Flat
    {
        SV_POSITION position;
        nointerpolation<TEXCOORD<0, Int>> number;
    };
    struct Vertices
    {
        POSITION position;
        NORMAL w;
        SV_VertexID vertex;
        TEXCOORD<0, Int> number;
    };
    struct Give
    {
        Flat operator()(Vertices v) const
        {
            return {float4(v.position.x, v.position.y, v.position.z, v.w.x), v.number};
        }
    };
    struct Show
    {
        Int first;
        float4 operator()(const Flat& i) const
        {
            return float4(select(static_cast<const Int&>(i.number) == first, Float(1.0f), Float(2.0f)));
        }
    };
    Random random(88);
    int wrong = 0, covered = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        Mesh mesh;
        for (int k = 0; k < 3; ++k) {
            mesh.positions.emplace_back(random.real(-4, 4), random.real(-4, 4), random.real(-1, 2));
            mesh.normals.emplace_back(random.real(-1, 2), 0.0f, 0.0f);  // w, behind the eye too
        }
        // Any bits: a signalling NaN's, a subnormal's, negative ones.
        const std::int32_t numbers[] = {0x7f800001, 1, -5, 0x7fbfffff, 0, 12345};
        const std::int32_t first = numbers[random.between(0, 5)];
        mesh.streams.push_back({"TEXCOORD", 0, 1, {}, {first, first ^ 77, first ^ 78}, false});
        mesh.indices = {0, 1, 2};
        Framebuffer target = makeTarget(32, 32);
        Frame frame(target, {1, 16});
        frame.clear(glm::vec4(0.0f));
        REQUIRE(frame.draw(mesh, Give{}, Show{first}, kPaint).has_value());
        frame.run();
        for (const glm::vec4& c : target.color32f()) {
            wrong += c.x == 2.0f;
            covered += c.x == 1.0f;
        }
    }
    measured("pixels with another vertex's number", wrong, 0);
    CHECK(covered > trials(300) * 10);
}

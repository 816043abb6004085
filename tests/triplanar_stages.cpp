// The stages of the triplanar chapter as pictures: each listing against its method, planes that are not sampled, meshes
// of all kinds, and derivatives at silhouettes (stability cases S-657, S-658, S-710, S-711).
#include <algorithm>
#include <array>
#include <cmath>

#include "common/render.h"
#include "common/triplanar_methods.h"
#include "pipeline_fixture.h"
#include "relief/file.h"
#include "relief/shading/cotangent_frame.h"
#include "relief/shading/triplanar.h"
#include "temporary_folder.h"

using namespace fixture;
using namespace relief::samples;

namespace {

struct Picture
{
    Framebuffer target;
    Statistics statistics;
};

Picture rendered(const PreparedStage& stage)
{
    Picture picture = {makeTarget(240, 135), {}};
    Frame frame(picture.target, {1, kDefaultTileSize});
    stage.record(frame, 240, 135);
    picture.statistics = frame.run();
    return picture;
}

PreparedStage prepared(const Stage& stage, const std::vector<std::string>& settings = {}, const InputFiles& files = {})
{
    Expected<PreparedStage> result = PreparedStage::prepare(stage, settings, files);
    REQUIRE(result.has_value());
    return std::move(*result);
}

Picture rendered(const std::string& id, const std::string& mesh, const std::vector<std::string>& settings = {})
{
    InputFiles files;
    files.mesh = mesh;
    return rendered(prepared(**findStage(id), settings, files));
}

float largestDifference(const Framebuffer& a, const Framebuffer& b)
{
    float largest = 0.0f;
    for (std::size_t i = 0; i < a.color32f().size(); ++i) {
        for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(a.color32f()[i][c] - b.color32f()[i][c]));
    }
    return largest;
}

// --- the stages' program, with a method in place of the listing ---

struct VertexData
{
    POSITION position;
    NORMAL normal;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> worldNormal;
};

struct VertexProgram : Uniforms
{
    Interpolators operator()(VertexData v) const
    {
        return {UnityObjectToClipPos(object, v.position), mul(object.worldFromObject, v.position).xyz(),
                UnityObjectToWorldNormal(object, v.normal)};
    }
};

template <class Method, bool always = false>
struct FragmentProgram : TriplanarMaterial
{
    // Where the stages leave out what has no weight, `always` samples it.
    static Triplanar<float4> sample(const sampler2D& s, const Triplanar<float2>& uv, const float3& weights)
    {
        if constexpr (!always) return tex2DTriplanar(s, uv, weights);
        const auto where = [](Float weight, const float4& color) { return select(weight > 0.0f, color, float4(0.0f)); };
        return {where(weights.x, tex2D(s, uv.x)), where(weights.y, tex2D(s, uv.y)), where(weights.z, tex2D(s, uv.z))};
    }

    float4 operator()(Interpolators i) const
    {
        i.worldNormal = normalize(i.worldNormal);
        const Triplanar<float2> uv = TriplanarUV(i.worldPos);
        const float3 blend = TriplanarBlendOffset(i.worldNormal, 0.2f);
        const Triplanar<float4> texel = sample(normalMap, uv, blend), color = sample(mainTex, uv, blend);
        const Triplanar<float3> bumps = {UnpackScaleNormal(texel.x, 1.0f), UnpackScaleNormal(texel.y, 1.0f),
                                         UnpackScaleNormal(texel.z, 1.0f)};
        const float3 normal = TriplanarNormal(bumps, i.worldNormal, blend, Method());
        const float3 albedo = (color.x * blend.x + color.y * blend.y + color.z * blend.z).rgb();
        return float4(albedo * (light.color * saturate(dot(normal, light.dir)) + ambient), 1);
    }
};

template <class Method, bool always = false>
Picture withMethod(const std::string& mesh)
{
    Stage stage = **findStage("4.05");
    stage.draw = [](const Scene& s) {
        for (const Object& o : s.objects) s.draw<VertexProgram, FragmentProgram<Method, always>>(o);
    };
    InputFiles files;
    files.mesh = mesh;
    return rendered(prepared(stage, {}, files));
}

}  // namespace

TEST_CASE("triplanar stages: each listing is its method")
{
    using namespace triplanar;
    for (const char* mesh : {"sphere", "cube", "terrain"}) {
        CHECK(largestDifference(rendered("4.03", mesh).target, withMethod<Swizzle>(mesh).target) <= 1e-5f);
        CHECK(largestDifference(rendered("4.04", mesh).target, withMethod<Udn>(mesh).target) <= 1e-5f);
        CHECK(largestDifference(rendered("4.05", mesh).target, withMethod<Whiteout>(mesh).target) <= 1e-5f);
        CHECK(largestDifference(rendered("4.07", mesh).target, withMethod<Reoriented>(mesh).target) <= 1e-5f);
        CHECK(largestDifference(rendered("4.10", mesh).target, withMethod<CrossProducts>(mesh).target) <= 1e-5f);
    }
    // The differences that are there to be found.
    CHECK(largestDifference(rendered("4.05", "sphere").target, withMethod<Udn>("sphere").target) > 0.01f);
    CHECK(largestDifference(rendered("4.07", "sphere").target, withMethod<CrossProducts>("sphere").target) > 0.01f);
}

TEST_CASE("triplanar stages: S-711 GPU Gems 3 draws UDN's picture")
{
    for (const char* mesh : {"sphere", "cube", "terrain"}) {
        measured("difference of a colour",
                 largestDifference(rendered("4.06", mesh, {"show=1"}).target, rendered("4.04", mesh).target), 1e-6f);
        const Picture enlarged = rendered("4.06", mesh, {"show=2", "exaggeration=1"});
        for (const glm::vec4& c : enlarged.target.color32f()) {
            if (c.w == 1.0f && c.x < 0.03f) CHECK(std::max({c.x, c.y, c.z}) <= 3e-7f);
        }
    }
}

TEST_CASE("triplanar stages: S-658 S-710 on a cube swizzle, whiteout, RNM, cotangent frame and cross products agree")
{
    const Picture swizzle = rendered("4.03", "cube");
    for (const char* id : {"4.05", "4.07", "4.08", "4.10"}) {
        CAPTURE(id);
        measured("difference of a colour", largestDifference(rendered(id, "cube").target, swizzle.target), 1e-5f);
    }
    CHECK(largestDifference(rendered("4.04", "cube").target, swizzle.target) > 1e-3f);  // UDN does not
}

TEST_CASE("triplanar stages: S-1104 planes without weight are not sampled, and the others have the same derivatives")
{
    const Picture cube = rendered("4.05", "cube");
    CHECK(cube.statistics.fetches.trilinear == 2 * 4 * cube.statistics.quadsShaded);  // colour and bumps, one plane

    const Picture sphere = rendered("4.05", "sphere");
    const std::uint64_t lanes = 4 * sphere.statistics.quadsShaded;
    CHECK(sphere.statistics.fetches.trilinear > 2 * lanes);
    CHECK(sphere.statistics.fetches.trilinear < 5 * lanes);

    for (const char* mesh : {"sphere", "terrain"}) {
        const Picture some = withMethod<triplanar::Whiteout>(mesh), all = withMethod<triplanar::Whiteout, true>(mesh);
        CHECK(relief::hashOf(some.target) == relief::hashOf(all.target));
        CHECK(all.statistics.fetches.trilinear == 6 * 4 * all.statistics.quadsShaded);
    }
}

TEST_CASE("triplanar stages: S-1103 a mesh without uv stays without uv and tangents, but for the naive method")
{
    const TemporaryFolder folder;
    const std::string obj = "v 0 1 0\nv 1 -1 -1\nv -1 -1 -1\nv 0 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    InputFiles files;
    files.mesh = (folder.path / "tetrahedron.obj").string();
    REQUIRE(writeFileAtomically(files.mesh, {reinterpret_cast<const std::uint8_t*>(obj.data()), obj.size()}));
    for (const Stage& stage : allStages()) {
        if (stage.folder != "triplanar") continue;
        CAPTURE(stage.id);
        const PreparedStage ready = prepared(stage, {}, files);
        const Picture picture = rendered(ready);
        CHECK(picture.statistics.pixelsShaded > 1000);
        const bool naive = stage.id == "4.02" || stage.id == "4.13";
        CHECK(ready.inputs->objects[0].mesh->uvs.empty());
        CHECK(ready.inputs->objects[0].mesh->tangents.empty());
        CHECK(ready.log->uvs.empty());  // tangents bring their own uv
        CHECK(ready.log->tangents.empty() == !naive);
    }
    // A stage of another chapter gets uv, once, when it reads any.
    const PreparedStage other = prepared(**findStage("1.19"), {}, files);
    CHECK(rendered(other).statistics.pixelsShaded > 1000);
    CHECK(other.log->uvs.size() == 1);
    CHECK(other.log->tangents.empty());
}

TEST_CASE("triplanar stages: no invalid colour on any shape, but for the offset that is too large")
{
    for (const Stage& stage : allStages()) {
        if (stage.folder != "triplanar" || stage.id == "4.11") continue;
        for (const char* mesh : {"quad", "cube", "sphere", "low-sphere", "terrain"}) {
            CAPTURE(stage.id);
            CAPTURE(mesh);
            CHECK(rendered(stage.id, mesh).statistics.invalidColors == 0);
        }
    }
    for (int kind = 1; kind <= 9; ++kind) {
        const Picture picture = rendered("4.11", "sphere", {"weights=" + std::to_string(kind)});
        CHECK((picture.statistics.invalidColors > 0) == (kind == 9));
    }
}

// --- derivatives at silhouettes ---

namespace {

// The normals of a bumpy plane, by a cotangent frame.
struct CotangentProgram
{
    float4 operator()(Interpolators i) const
    {
        const float3 bump = normalize(float3(0.3f, -0.4f, 1.0f));
        return float4(perturb_normal(bump, i.worldNormal, i.worldPos, i.worldPos.xy()), 1);
    }
};

// Triangles of the plane z = 4 + 0.5 x - 0.3 y with their corners at these places.
Mesh onPlane(const std::vector<glm::vec2>& places)
{
    Mesh mesh;
    const float length = std::sqrt(1.0f + 0.25f + 0.09f);
    for (const glm::vec2& p : places) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back({p.x, p.y, 4.0f + 0.5f * p.x - 0.3f * p.y});
        mesh.normals.push_back({0.5f / length, -0.3f / length, -1.0f / length});
    }
    return mesh;
}

Framebuffer normalsOf(const Mesh& mesh)
{
    Framebuffer target = makeTarget(128, 128);
    Frame frame(target, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    const glm::mat4 clipFromWorld = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 1.0f, 1}, {0, 0, -0.1f, 0}};
    const Uniforms uniforms = {
        .source = nullptr, .object = {clipFromWorld, glm::mat4(1.0f)}, .worldSpaceCameraPos = {}};
    frame.draw(mesh, VertexProgram(uniforms), CotangentProgram(), RenderState{.cull = Cull::none});
    frame.run();
    return target;
}

}  // namespace

TEST_CASE("triplanar stages: S-657 a quad over the silhouette takes its derivatives from its own triangle")
{
    // One large triangle, and a thousand of a pixel or two on the same plane.
    std::vector<glm::vec2> large = {{-3, -3}, {0, 4}, {4, -3}}, small;
    Random random(657);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec2 p = {random.real(-1.5f, 1.5f), random.real(-1.5f, 1.5f)};
        small.insert(small.end(), {p, p + glm::vec2(0.02f, 0.06f), p + glm::vec2(0.05f, 0.0f)});
    }
    const Framebuffer whole = normalsOf(onPlane(large)), pieces = normalsOf(onPlane(small));
    int compared = 0;
    double largest = 0.0;
    for (std::size_t i = 0; i < whole.color32f().size(); ++i) {
        const glm::vec4 a = whole.color32f()[i], b = pieces.color32f()[i];
        if (a.w == 0.0f || b.w == 0.0f) continue;
        ++compared;
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(static_cast<double>(a[c] - b[c])));
    }
    CHECK(compared > 500);
    measured("difference of a normal", largest, 2e-3);  // a tenth of a degree
}

TEST_CASE("triplanar stages: the cross product of two differences is the triangle's normal, towards the viewer")
{
    const float3 normal = normalize(float3(0.5f, -0.3f, -1.0f));
    const Float x = Float(laneXs()) * 0.01f, y = Float(laneYs()) * -0.01f;
    const float3 position = {x, y, 4.0f + 0.5f * x - 0.3f * y};
    const float3 faceted = normalize(cross(ddx(position), ddy(position)));
    for (int c = 0; c < 3; ++c) CHECK(faceted[c][0] == doctest::Approx(normal[c][0]).epsilon(1e-3));
}

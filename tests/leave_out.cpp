// What a draw does not need is not in its code: each feature off gives the bits of the feature on with nothing to do,
// in every pair of features, and counters show that it was left out (stability cases S-1101 to S-1107).
#include <memory>
#include <utility>

#include "common/render.h"
#include "numbers.h"
#include "pipeline_fixture.h"
#include "relief/leave_out.h"
#include "relief/mesh/primitives.h"
#include "relief/pipeline/instruments.h"
#include "relief/shading/lights.h"

using namespace fixture;
using namespace relief::samples;

namespace {

// Two rows of triangles that do not overlap, all facing the viewer, inside the view and in front of the cleared depth:
// none of the features has anything to do. (In FromPixels' coordinates; front is clockwise.)
Mesh separateTriangles()
{
    Mesh mesh;
    Random random(1101);
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 7; ++x) {
            const auto corner = [&](int dx, int dy) -> TestVertex {
                const Point p = {(x * 16 + dx) * 256 + random.between(0, 255),
                                 (y * 16 + dy) * 256 + random.between(0, 255)};
                const float w = random.real(0.5f, 2.0f);
                return {pixelPosition(p, random.real(0.1f, 0.9f), w),
                        {random.real(0.1f, 1), random.real(0.1f, 1), random.real(0.1f, 1), 1.0f}};
            };
            const TestVertex a = corner(1, 1), b = corner(14, 3), c = corner(4, 14);
            addTriangle(mesh, a, b, c);
        }
    }
    return mesh;
}

// --- the features: each adds something to a draw that changes nothing here ---

enum Feature : unsigned
{
    testsDepth = 1,     // against a cleared depth
    writesDepth = 2,    // nothing is drawn behind
    clipsDepth = 4,     // nothing sticks out
    culls = 8,          // nothing faces away
    blends = 16,        // alpha is 1
    discards = 32,      // never
    interpolates = 64,  // four components that nobody looks at
    samples = 128       // a white texture
};
constexpr int kFeatures = 8;

struct MoreInterpolated
{
    SV_POSITION position;
    TEXCOORD<0, float4> value;
    TEXCOORD<1, float4> more;
};

template <bool more>
struct VertexProgram
{
    FromPixels base;

    auto operator()(const TestVertexData& v) const
    {
        const Interpolated i = base(v);
        if constexpr (more) {
            return MoreInterpolated{i.position, i.value, float4(i.value.w, i.value.z, i.value.y, i.value.x)};
        } else {
            return i;
        }
    }
};

template <unsigned features>
struct FragmentProgram
{
    using Input = std::conditional_t<(features & interpolates) != 0, MoreInterpolated, Interpolated>;
    sampler2D white;

    float4 color(const Input& i) const
    {
        float4 c = i.value;
        if constexpr ((features & samples) != 0) c *= tex2D(white, i.value.xy());
        return float4(c.xyz(), 1.0f);
    }
    float4 operator()(const Input& i) const requires((features & discards) == 0) { return color(i); }
    float4 operator()(const Input& i, Discard& discard) const requires((features & discards) != 0)
    {
        discard(i.value.x < 0.0f);
        return color(i);
    }
};

template <unsigned features>
std::uint64_t pictureWith(const Mesh& mesh, Format format)
{
    constexpr RenderState kState = {
        .depthTest = (features & testsDepth) != 0 ? Compare::less : Compare::always,
        .depthWrite = (features & writesDepth) != 0,
        .depthClip = (features & clipsDepth) != 0,
        .cull = (features & culls) != 0 ? Cull::back : Cull::none,
        .blend = (features & blends) != 0 ? Blend::alpha : Blend::off,
    };
    Framebuffer target = makeTarget(112, 80, format);
    const Viewport viewport = exactViewport(112, 80);
    Frame frame(target, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    frame.setViewport(viewport);
    frame.draw(mesh, VertexProgram<(features & interpolates) != 0>{FromPixels(viewport)},
               FragmentProgram<features>{{.texture = &Texture::white()}}, kState);
    const Statistics statistics = frame.run();
    checkInvariants(target, statistics);
    CHECK(statistics.rasterised == mesh.indices.size() / 3);
    return fixture::hashOf(target);
}

// Every pair, each alone, and all together.
template <int first, int second>
int differing(const Mesh& mesh, Format format, std::uint64_t expected)
{
    return pictureWith<1u << first | 1u << second>(mesh, format) != expected;
}
template <int first, int... second>
int differingFrom(const Mesh& mesh, Format format, std::uint64_t expected, std::integer_sequence<int, second...>)
{
    return (differing<first, first + second>(mesh, format, expected) + ...);
}
template <int... first>
int differingPairs(const Mesh& mesh, Format format, std::uint64_t expected, std::integer_sequence<int, first...>)
{
    return (differingFrom<first>(mesh, format, expected, std::make_integer_sequence<int, kFeatures - first>()) + ...);
}

struct Picture
{
    Framebuffer target;
    Statistics statistics;
};

// A stage with an object's uvs replaced by garbage.
Picture stageWithUvs(const std::string& id, const std::string& meshName, float garbage)
{
    InputFiles files;
    files.mesh = meshName;
    const auto stage = findStage(id);
    REQUIRE(stage.has_value());
    auto prepared = PreparedStage::prepare(**stage, {}, files);
    REQUIRE(prepared.has_value());
    Mesh mesh = *prepared->inputs->objects[0].mesh;
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(garbage);
    for (glm::vec4& tangent : mesh.tangents) tangent = glm::vec4(garbage);
    prepared->inputs->objects[0].mesh = &mesh;
    Picture picture = {makeTarget(160, 90), {}};
    Frame frame(picture.target, {1, kDefaultTileSize});
    prepared->record(frame, 160, 90);
    picture.statistics = frame.run();
    return picture;
}

// --- light ---

struct LitInterpolators
{
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
    TEXCOORD<1, float3> normal;
};

struct LitVertexData
{
    POSITION position;
    NORMAL normal;
};

struct LitVertexProgram
{
    ObjectTransform object;
    LitInterpolators operator()(LitVertexData v) const
    {
        return {UnityObjectToClipPos(object, v.position), mul(object.worldFromObject, v.position).xyz(),
                UnityObjectToWorldNormal(object, v.normal)};
    }
};

template <class Light, bool ambient>
struct LitFragmentProgram
{
    Light source;
    VertexLights lamps;
    SphericalHarmonics surroundings;

    float4 operator()(LitInterpolators i) const
    {
        i.normal = normalize(i.normal);
        const UnityLight light = CreateLight(source, i.worldPos);
        const float3 viewDir = normalize(float3(0, 0, -3) - i.worldPos);
        float3 color = UNITY_BRDF_PBS({0.8f, 0.7f, 0.6f}, {0.04f, 0.04f, 0.04f}, 0.5f, i.normal, viewDir, light).xyz();
        if constexpr (ambient) {
            color += Shade4PointLights(lamps, i.worldPos, i.normal);
            color += ShadeSH9(surroundings, i.normal);
        }
        return float4(color, std::is_same_v<Light, PointLight> ? 0.0f : 1.0f);  // an additive pass adds no alpha
    }
};

}  // namespace

TEST_CASE("leave out: S-1101 every pair of features that have nothing to do gives the bits of the draw without them")
{
    const Mesh mesh = separateTriangles();
    int pairs = 0, wrong = 0;
    for (const Format format : {Format::rgba32f, Format::rgba8Srgb}) {
        const std::uint64_t plain = pictureWith<0>(mesh, format);
        wrong += differingPairs(mesh, format, plain, std::make_integer_sequence<int, kFeatures>());
        wrong += pictureWith<(1u << kFeatures) - 1>(mesh, format) != plain;
        pairs += kFeatures * (kFeatures + 1) / 2 + 1;
    }
    measured("draws with other bits", wrong, 0);
    stability::noted("pairs, features alone and all together", pairs);
}

TEST_CASE("leave out: S-1101 every set of pictures that are constants gives the bits of the stage without them")
{
    // A stage leaves out what it has no picture for. Here it gets one, of 4x4 texels of the very constant.
    const auto spread = [](const Texture& constant) {
        const glm::vec4 texel = constant.texel(0, 0);
        std::vector<float> texels;
        for (int i = 0; i < 16; ++i) texels.insert(texels.end(), {texel.x, texel.y, texel.z, texel.w});
        return std::make_shared<const Texture>(*Texture::fromRgbaFloat(4, 4, texels));
    };
    int wrong = 0, pictures = 0;
    for (const char* id : {"1.18", "1.25"}) {
        const auto stage = findStage(id);
        REQUIRE(stage.has_value());
        auto prepared = PreparedStage::prepare(**stage);
        REQUIRE(prepared.has_value());
        auto& map = prepared->inputs->textures;
        std::uint64_t without = 0;
        for (unsigned given = 0; given < 16; ++given) {
            map[TextureSlot::albedo] = (given & 1) != 0 ? spread(Texture::white()) : nullptr;
            map[TextureSlot::detail] = (given & 2) != 0 ? spread(Texture::grey()) : nullptr;
            map[TextureSlot::normal] = (given & 4) != 0 ? spread(Texture::flatNormal()) : nullptr;
            map[TextureSlot::detailNormal] = (given & 8) != 0 ? spread(Texture::flatNormal()) : nullptr;
            Framebuffer target = makeTarget(96, 54, Format::rgba32f, Store::keep);
            Frame frame(target, {1, kDefaultTileSize});
            prepared->record(frame, 96, 54);
            const Statistics statistics = frame.run();
            checkInvariants(target, statistics);
            const FetchCounters& f = statistics.fetches;
            const std::uint64_t fetched = f.fetched();
            if (given == 0) {
                without = fixture::hashOf(target);
                measured("texels fetched without any picture", fetched, 0);
            } else {
                CHECK(fetched > 0);
            }
            wrong += fixture::hashOf(target) != without;
            ++pictures;
        }
    }
    measured("stages with other bits", wrong, 0);
    stability::noted("sets of pictures", pictures);
}

TEST_CASE("leave out: S-1102 without a normal map nothing is sampled, and tangents and uvs are not even read")
{
    Mesh sphere = makeSphere(24, 12);
    const ObjectTransform object({{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 1.1f, 1}, {0, 0, 2.2f, 3}}, glm::mat4(1.0f));
    const DirectionalLight sun = {{1.0f, 1.0f, 1.0f}, normalize(float3(0.3f, 0.8f, -0.5f))};
    const auto draw = [&](int& components) {
        Picture picture = {makeTarget(96, 64), {}};
        Frame frame(picture.target, {1, kDefaultTileSize});
        frame.clear(glm::vec4(0.0f));
        frame.draw(sphere, LitVertexProgram{object}, LitFragmentProgram<DirectionalLight, false>{sun, {}, {}});
        picture.statistics = frame.run();
        components = *componentCount(frame, 0);
        return picture;
    };
    int components = 0;
    const Picture with = draw(components);
    for (glm::vec4& tangent : sphere.tangents) tangent = glm::vec4(kNan);
    for (glm::vec2& uv : sphere.uvs) uv = glm::vec2(kNan);
    const Picture garbage = draw(components);
    sphere.tangents.clear();
    sphere.uvs.clear();
    const Picture without = draw(components);
    measured("components beyond position and normal", components - 6, 0);
    const FetchCounters& f = with.statistics.fetches;
    measured("texture fetches", f.samples(), 0);
    CHECK(with.target.samePixels(garbage.target));
    CHECK(with.target.samePixels(without.target));
    CHECK(with.statistics.pixelsShaded > 500);
}

TEST_CASE("leave out: S-1103 triplanar stages draw the same picture with garbage for uvs and tangents")
{
    for (const char* id : {"4.03", "4.05", "4.07", "4.08", "4.10"}) {
        for (const char* mesh : {"sphere", "cube"}) {
            CAPTURE(id);
            CAPTURE(mesh);
            const Picture own = stageWithUvs(id, mesh, 0.25f), garbage = stageWithUvs(id, mesh, kNan);
            CHECK(own.statistics.pixelsShaded > 500);
            CHECK(garbage.statistics.invalidColors == 0);
            CHECK(own.target.samePixels(garbage.target));
        }
    }
}

TEST_CASE("leave out: S-1106 what is behind is not shaded, and a draw of depth alone interpolates nothing")
{
    struct PositionOnly
    {
        SV_POSITION position;
    };
    struct PositionProgram
    {
        PositionOnly operator()(const TestVertexData& v) const
        {
            return {float4(v.position.x, v.position.y, v.position.z, v.w.x)};
        }
    };
    struct Black
    {
        float4 operator()(const PositionOnly&) const { return float4(Float(0.0f)); }
    };
    Mesh near, far;
    for (const auto& [mesh, z] : {std::pair{&near, 0.25f}, {&far, 0.75f}}) {
        addTriangle(*mesh, {{-1, -1, z, 1}, glm::vec4(1.0f)}, {{-1, 3, z, 1}, glm::vec4(1.0f)},
                    {{3, -1, z, 1}, glm::vec4(1.0f)});
    }
    Framebuffer target = makeTarget(64, 48, Format::rgba32f, Store::keep);
    Frame frame(target, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    frame.draw(near, PositionProgram{}, Black{}, kDepthTested);  // depth first
    const Statistics depthAlone = frame.run();
    measured("components of depth alone", *componentCount(frame, 0), 0);
    frame.draw(far, FromClip{}, Value{}, kDepthTested);
    const Statistics both = frame.run();
    measured("pixels shaded behind", both.pixelsShaded - depthAlone.pixelsShaded, 0);
    CHECK(both.pixelsHidden == 64 * 48);
    CHECK(both.pixelsColorless == 0);
    measured("texture fetches", both.fetches.trilinear + both.fetches.bilinear + both.fetches.nearest, 0);
}

TEST_CASE("leave out: a program is not run where no target keeps its colours, and is where it decides what is drawn")
{
    struct HalfOfIt
    {
        float4 operator()(const Interpolated& i, Discard& discard) const
        {
            discard(i.value.x < 0.5f);
            return i.value;
        }
    };
    Mesh whole;
    addTriangle(whole, {{-1, -1, 0.5f, 1}, glm::vec4(1.0f)}, {{-1, 3, 0.5f, 1}, glm::vec4(1.0f)},
                {{3, -1, 0.5f, 1}, glm::vec4(1.0f)});
    Framebuffer depth = *Framebuffer::create(64, 48, {{Format::depth32f}});
    Frame frame(depth, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    frame.draw(whole, FromClip{}, Value{}, kDepthTested);
    CHECK_FALSE(factsOf(frame, 0)->program);
    const Statistics alone = frame.run();
    CHECK(alone.pixelsShaded == 64 * 48);
    // Builds that can put it back run the program nevertheless.
    CHECK(alone.pixelsColorless == (leavesOut::colors ? 64 * 48 : 0));
    CHECK((alone.blocksShaded == 0) == leavesOut::colors);
    frame.reset();
    frame.clear(glm::vec4(0.0f));
    frame.draw(whole, FromClip{}, HalfOfIt{}, kDepthTested);
    CHECK(factsOf(frame, 0)->program);
    CHECK(factsOf(frame, 0)->colors == 0);
    const Statistics decided = frame.run();
    CHECK(decided.pixelsColorless == 0);
    CHECK(decided.blocksShaded > 0);
}

TEST_CASE("leave out: a program that ends where it has thrown all of a block away draws the same, and fetches less")
{
    struct ThrowsAway
    {
        bool ends;
        float until;  // this x nothing is left
        sampler2D texture = {.texture = &Texture::white()};

        float4 operator()(const Interpolated& i, Discard& discard) const
        {
            discard(i.position.x < until);
            if (ends && discard.all()) return 0.0f;
            return tex2D(texture, i.value.xy()) * i.value;
        }
    };
    Mesh whole;
    addTriangle(whole, {{-1, -1, 0.5f, 1}, glm::vec4(0.25f)}, {{-1, 3, 0.5f, 1}, glm::vec4(0.5f)},
                {{3, -1, 0.5f, 1}, glm::vec4(1.0f)});
    const auto draw = [&](const ThrowsAway& program) {
        Framebuffer target = makeTarget(64, 48);
        Frame frame(target, {1, kDefaultTileSize});
        frame.clear(glm::vec4(0.0f));
        frame.draw(whole, FromClip{}, program);
        const std::uint64_t fetches = frame.run().fetches.trilinear;
        return std::pair(fixture::hashOf(target), fetches);
    };
    const auto [toTheEnd, allFetches] = draw({false, 32.0f});
    const auto [early, fetches] = draw({true, 32.0f});
    CHECK(early == toTheEnd);
    CHECK(allFetches == 64 * 48);
    CHECK(fetches == (leavesOut::discarded ? 32 * 48 : 64 * 48));
    // One pixel of a block is enough for all of them.
    const auto [oddToTheEnd, oddAll] = draw({false, 31.0f});
    const auto [oddEarly, oddFetches] = draw({true, 31.0f});
    CHECK(oddEarly == oddToTheEnd);
    CHECK(oddAll == 64 * 48);
    CHECK(oddFetches == (leavesOut::discarded ? (64 - 32 + kBlockWidth) * 48 : 64 * 48));
}

TEST_CASE("leave out: what is left of a block are the lanes that the program runs for")
{
    const ShadingScope scope;
    Discard discard;
    CHECK_FALSE(discard.all());
    discard(Mask::fromBits(0xeu & kAllLanes));
    CHECK_FALSE(discard.all());
    shading.activeLanes = 0xfu;
    CHECK_FALSE(discard.all());
    discard(Mask::fromBits(0x1u));
    CHECK(discard.all() == leavesOut::discarded);
    shading.activeLanes |= kWatched;  // no shortcut while somebody watches
    CHECK_FALSE(discard.all());
}

TEST_CASE("leave out: S-1107 a light that does not reach needs no pass, and lights that are off change no bit")
{
    const Mesh sphere = makeSphere(24, 12);
    const ObjectTransform object({{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 1.1f, 1}, {0, 0, 2.2f, 3}}, glm::mat4(1.0f));
    const DirectionalLight sun = {{1.0f, 0.9f, 0.8f}, normalize(float3(0.3f, 0.8f, -0.5f))};
    constexpr RenderState kAdditive = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};
    const PointLight far = {{4.0f, 4.0f, 4.0f}, {3.0f, 0.5f, -1.0f}, 1.5f},
                     off = {{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, -1.0f}, 9.0f};
    VertexLights dark{};
    dark.attenSq = float4(Float(1.0f));
    for (float3& color : dark.color) color = float3(0.0f);
    const auto draw = [&](const PointLight* lamp, bool ambient, int& draws) {
        Framebuffer target = makeTarget(96, 64);
        Frame frame(target, {1, kDefaultTileSize});
        frame.clear(glm::vec4(0.0f));
        if (ambient) {
            frame.draw(sphere, LitVertexProgram{object},
                       LitFragmentProgram<DirectionalLight, true>{
                           sun, dark, gradientSurroundings(glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f))});
        } else {
            frame.draw(sphere, LitVertexProgram{object}, LitFragmentProgram<DirectionalLight, false>{sun, dark, {}});
        }
        if (lamp != nullptr) {
            frame.draw(sphere, LitVertexProgram{object}, LitFragmentProgram<PointLight, false>{*lamp, dark, {}},
                       kAdditive);
        }
        draws = static_cast<int>(frame.run().draws);
        return target;
    };
    int draws = 0, ignored = 0, other = 0;
    const Framebuffer one = draw(nullptr, false, draws);
    measured("draws for one light", draws, 1);
    CHECK_FALSE(lightReaches(far, boundsOf(sphere)));
    other += !one.samePixels(draw(&far, false, ignored));
    other += !one.samePixels(draw(&off, false, ignored));
    other += !one.samePixels(draw(nullptr, true, ignored));
    measured("pictures with other bits", other, 0);
}

TEST_CASE("leave out: the passes of lights that do not reach are counted, anew for each picture")
{
    // Three objects under three lights: the lamp of 0.07 does not reach one of them.
    for (const auto& [id, leftOut] : {std::pair{"0.07", 1}, {"1.25", 0}}) {
        const auto prepared = PreparedStage::prepare(**findStage(id));
        REQUIRE(prepared.has_value());
        Framebuffer target = makeTarget(32, 18);
        Frame frame(target, {1, kDefaultTileSize});
        for (int round = 0; round < 2; ++round) {  // a second picture counts anew
            prepared->record(frame, 32, 18);
            CHECK(prepared->log->passesLeftOut == leftOut);
            CHECK(frame.run().draws == static_cast<std::uint64_t>(9 - leftOut));
        }
    }
}

TEST_CASE("leave out: RELIEF_GENERIC holds whole names, and an unknown one is an error that names it")
{
    CHECK(leavesOut::putsBack("alpha clipping", "clipping"));
    CHECK(leavesOut::putsBack("  alpha", "alpha"));
    CHECK(leavesOut::putsBack("all", "tiles"));
    CHECK_FALSE(leavesOut::putsBack("alpha clipping", "tiles"));
    CHECK_FALSE(leavesOut::putsBack("tilesX", "tiles"));
    CHECK_FALSE(leavesOut::putsBack("", "tiles"));

    CHECK(leavesOut::checkGeneric("").has_value());
    CHECK(leavesOut::checkGeneric(" all ").has_value());
    std::string every;
    for (const leavesOut::LeftOut& left : leavesOut::kAll) every += std::string(left.name) + " ";
    CHECK(leavesOut::checkGeneric(every).has_value());
    for (const char* words : {"clip", "tiles clip", "clip all", "  clip tiles"}) {
        CAPTURE(words);
        const Expected<void> checked = leavesOut::checkGeneric(words);
        REQUIRE_FALSE(checked.has_value());
        CHECK(checked.error().message ==
              "RELIEF_GENERIC: nothing named clip is left out; use words of: " + every + "all");
    }
}

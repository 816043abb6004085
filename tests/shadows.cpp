// Shadow filters: the pictures of stage 5.06, means of comparisons, and light that grazes.
#include "relief/shading/shadows.h"

#include "common/render.h"
#include "numbers.h"
#include "pipeline_fixture.h"
#include "relief/pipeline/target_texture.h"
#include "relief/shading/camera.h"
#include "relief/shading/object_transform.h"

using namespace fixture;
using namespace relief::samples;

namespace {

struct PositionOnly
{
    POSITION position;
};
struct DepthInterpolators
{
    SV_POSITION position;
};
struct DepthVertexProgram
{
    ObjectTransform object;
    DepthInterpolators operator()(PositionOnly v) const { return {UnityObjectToClipPos(object, v.position)}; }
};
struct NoColor
{
    float4 operator()(DepthInterpolators) const { return float4(0.0f); }
};

// As SampleCmp by its texels, in double: a sum of taps * taps.
double meanOf(const Texture& texture, int taps, double u, double v, float depth)
{
    double sum = 0.0;
    for (int k = 0; k < taps * taps; ++k) {
        const double x = u * texture.width() - 0.5 + k % taps - (taps - 1) * 0.5,
                     y = v * texture.height() - 0.5 + k / taps - (taps - 1) * 0.5;
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
        const auto passes = [&](int a, int b) {
            const bool isInside = a >= 0 && b >= 0 && a < texture.width() && b < texture.height();
            return depth <= (isInside ? texture.texel(a, b).x : 1.0f) ? 1.0 : 0.0;
        };
        const double s = x - i, t = y - j;
        sum += (passes(i, j) * (1.0 - s) + passes(i + 1, j) * s) * (1.0 - t) +
               (passes(i, j + 1) * (1.0 - s) + passes(i + 1, j + 1) * s) * t;
    }
    return sum / (taps * taps);
}

Texture randomDepths(int width, int height)
{
    Random random(91);
    std::vector<float> red;
    for (int i = 0; i < width * height; ++i) red.push_back(random.real(0.0f, 1.0f));
    return *Texture::fromRed(width, height, red);
}

// --- a floor alone, in light that comes in at so many degrees above it ---

struct Floor
{
    Mesh mesh;
    glm::mat4 lightFromWorld;
};

Floor floorIn(double degrees, double turn)
{
    const double a = degrees * 3.14159265358979324 / 180.0;
    const glm::vec3 light(std::cos(a) * std::cos(turn), std::sin(a), std::cos(a) * std::sin(turn));
    Floor floor;
    floor.mesh.name = "floor";
    // So large that every row of the map sees it, as low as the light may be.
    constexpr float kReach = 1900.0f;
    floor.mesh.positions = {{-kReach, 0, -kReach}, {kReach, 0, -kReach}, {kReach, 0, kReach}, {-kReach, 0, kReach}};
    floor.mesh.indices = {0, 2, 1, 0, 3, 2};
    floor.lightFromWorld = orthographic(4.0f, 4.0f, 1.0f, 3999.0f) * lookAt(light * 2000.0f, glm::vec3(0.0f));
    return floor;
}

Texture mapOf(const Floor& floor, int side, const DepthBias& bias)
{
    Framebuffer map = *Framebuffer::create(side, side, {{Format::depth32f}});
    Frame frame(map, {.threads = 1});
    frame.clearDepth();
    frame.draw(floor.mesh, DepthVertexProgram{ObjectTransform(floor.lightFromWorld, glm::mat4(1.0f))}, NoColor{},
               {.cull = Cull::none, .depthBias = bias});
    frame.run();
    return *textureOf(map, map.depthIndex());
}

// How many of the points of a floor that nothing shades a filter of so many taps has in the dark, at all.
template <int TAPS>
int darkPoints(const Floor& floor, const Texture& map, float offset, int points)
{
    Random random(92);
    int dark = 0;
    const float4x4 lightFromWorld = broadcast(floor.lightFromWorld);
    for (int i = 0; i < points; ++i) {
        const float x = random.real(-1.9f, 1.9f), z = random.real(-1.9f, 1.9f);
        const float4 p = mul(lightFromWorld, float4(Float(x), Float(offset), Float(z), Float(1.0f)));
        dark += filteredShadow<TAPS>({&map}, p.xy() * 0.5f + 0.5f, p.z)[0] < 1.0f ? 1 : 0;
    }
    return dark;
}

// --- stage 5.06 ---

struct StageVertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};
struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
};
struct StageVertexProgram : Uniforms
{
    Interpolators operator()(StageVertexData v) const
    {
        return {UnityObjectToClipPos(object, v.position), v.uv, UnityObjectToWorldNormal(object, v.normal),
                float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w),
                mul(object.worldFromObject, v.position).xyz()};
    }
};

struct StageMaterial : Uniforms
{
    float4 tint = rgba("tint", {0.8f, 0.78f, 0.74f, 1.0f}, "");
    sampler2D normalMap = normals("marble-heights.png");
    Float bumpScale = number("bumpScale", 1.0f, {-32, 32}, "");
    float3 ambient = rgb("ambient", glm::vec3(0.08f), "");
    UnityLight light = sun(38.0f, -50.0f);
    Float slopeBias = number("slopeBias", 1.5f, {0, 16}, "");
    Float normalOffset = number("normalOffset", 0.04f, {0, 0.5f}, "");
};

template <int TAPS>
struct StageFragmentProgram : StageMaterial
{
    float4x4 lightFromWorld = {};
    sampler2D depths = {};

    float4 operator()(Interpolators i) const
    {
        float3 normal = normalize(i.normal);
        const float4 p = mul(lightFromWorld, float4(i.worldPos + normal * normalOffset, 1));
        const float2 uv = p.xy() * 0.5f + 0.5f;
        Float shadow;
        if constexpr (TAPS == 0)
            shadow = shadowOfOneTexel(depths, uv, p.z);
        else
            shadow = filteredShadow<TAPS>({depths.texture}, uv, p.z);
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
        const Float diffuse = saturate(dot(normal, light.dir)) * shadow;
        return float4(tint.rgb() * (light.color * diffuse + ambient), 1);
    }
};

template <int TAPS>
void drawColumn(const Scene& s, int column, const glm::mat4& lightFromWorld, const sampler2D& map)
{
    s.cutCell(column, 4);
    for (const Object& o : s.objects) {
        StageFragmentProgram<TAPS> fragment = s.uniforms(o.worldFromObject);
        fragment.lightFromWorld = broadcast(lightFromWorld);
        fragment.depths = map;
        s.draw(*o.mesh, StageVertexProgram(s.uniforms(o.worldFromObject)), fragment);
    }
}

}  // namespace

TEST_CASE("shadows: the filters draw the picture of stage 5.06, bit for bit")
{
    const auto found = findStage("5.06");
    REQUIRE(found.has_value());
    const Expected<PreparedStage> stage = PreparedStage::prepare(**found);
    REQUIRE(stage.has_value());
    constexpr int kWidth = 192, kHeight = 72;
    Framebuffer its = makeTarget(kWidth, kHeight), ours = makeTarget(kWidth, kHeight);
    {
        Frame frame(its);
        stage->record(frame, kWidth, kHeight);
        frame.run();
    }
    Frame frame(ours);
    frame.clear(kBackground);
    stage->log->clear();
    const Scene s = stage->scene(frame, kWidth, kHeight, stage->camera());
    const StageMaterial material = s.uniforms();
    const glm::mat4 lightFromWorld =
        orthographic(4.4f, 4.4f, 1.0f, 6.0f) * lookAt(firstLane(material.light.dir) * 3.5f, glm::vec3(0));
    const DepthBias bias = {0.0f, material.slopeBias[0], 0.0f};
    Framebuffer map = *Framebuffer::create(128, 128, {{Format::depth32f}});
    Frame mapFrame(map);
    mapFrame.clearDepth();
    for (const Object& o : s.objects)
        mapFrame.draw(*o.mesh, DepthVertexProgram{ObjectTransform(lightFromWorld, o.worldFromObject)}, NoColor{},
                      {.depthBias = bias});
    mapFrame.run();
    const Texture depths = *textureOf(map, map.depthIndex());
    const sampler2D nearest = {.texture = &depths,
                               .filter = Filter::nearest,
                               .u = AddressMode::clamp,
                               .v = AddressMode::clamp,
                               .mipmaps = false};
    drawColumn<0>(s, 0, lightFromWorld, nearest);
    drawColumn<1>(s, 1, lightFromWorld, nearest);
    drawColumn<3>(s, 2, lightFromWorld, nearest);
    drawColumn<5>(s, 3, lightFromWorld, nearest);
    frame.run();
    CHECK(its.samePixels(ours));
}

TEST_CASE("shadows: a filter is the mean of its comparisons")
{
    const Texture map = randomDepths(13, 9);
    Random random(93);
    double largest = 0.0;
    for (int i = 0; i < trials(2000); ++i) {
        // Multiples of 1/64 of a texel: positions are exact.
        const float u = static_cast<float>(random.between(-200, 64 * 13 + 200)) / (64.0f * 13.0f);
        const float v = static_cast<float>(random.between(-200, 64 * 9 + 200)) / (64.0f * 9.0f);
        const float depth = random.real(0.0f, 1.0f);
        const float2 uv = {Float(u), Float(v)};
        const auto compare = [&](Float share, int taps) {
            largest = std::fmax(largest, std::abs(static_cast<double>(share[0]) - meanOf(map, taps, u, v, depth)));
        };
        compare(filteredShadow<1>({&map}, uv, depth), 1);
        compare(filteredShadow<2>({&map}, uv, depth), 2);
        compare(filteredShadow<3>({&map}, uv, depth), 3);
        compare(filteredShadow<5>({&map}, uv, depth), 5);
    }
    // A position that rounds to the next 1/4096 of a texel moves a weight by that much.
    measured("share of the light off", largest, 2.0 / 4096.0);
}

TEST_CASE("shadows: light that grazes a floor alone leaves no point of it dark (S-924)")
{
    const int points = trials(2000);
    int dark = 0, unbiased = 0;
    double steepest = 0.0;
    for (const double degrees : {60.0, 20.0, 5.0, 1.0, 0.3, 0.1}) {
        for (const double turn : {0.0, 0.4, 0.785, 1.3}) {
            const Floor floor = floorIn(degrees, turn);
            // The sum of both slopes is at most twice the larger one; up to half a texel, and the filter's own reach.
            const auto judge = [&]<int TAPS>(float reach) {
                const Texture map = mapOf(floor, 64, {0.0f, 2.0f * reach, 0.0f});
                dark += darkPoints<TAPS>(floor, map, 0.0f, points);
            };
            judge.operator()<1>(1.5f);
            judge.operator()<3>(2.5f);
            judge.operator()<5>(3.5f);
            // Along the normal: as far as the reach goes across texels, whatever the angle.
            dark += darkPoints<3>(floor, mapOf(floor, 64, {}), 2.5f * 1.42f * 4.0f / 64.0f, points);
            unbiased += darkPoints<1>(floor, mapOf(floor, 64, {}), 0.0f, points) > points / 4 ? 1 : 0;
            steepest = std::fmax(steepest, 1.0 / std::tan(degrees * 3.14159265358979324 / 180.0));
        }
    }
    measured("points of the floor that are dark", dark, 0);
    stability::noted("steepest slope, depth by distance", steepest);
    CHECK(unbiased == 24);  // without a bias every one of these floors is striped
}

TEST_CASE("shadows: points that the map does not hold, and that are no numbers (S-925)")
{
    const Texture map = *Texture::fromRed(4, 4, std::vector<float>(16, 0.5f));
    int wrong = 0, outOfRange = 0;
    const float places[] = {-0.6f, 1.6f, -1e30f, 1e30f, kInfinity, -kInfinity};
    for (const float place : places) {
        for (const float2& uv : {float2(Float(place), Float(0.5f)), float2(Float(0.5f), Float(place))}) {
            wrong += filteredShadow<3>({&map}, uv, 0.9f)[0] != 1.0f;  // beyond the map: lit, as its border is 1
            wrong += filteredShadow<3>({&map}, uv, 1.5f)[0] != 0.0f;  // and beyond the far plane
        }
    }
    const float numbers[] = {0.5f, 0.0f, -1.0f, 2.0f, 3e38f, kNan, kInfinity, -kInfinity, 0x1p-149f};
    for (int i = 0; i < 9 * 9 * 9; ++i) {
        const float2 uv = {Float(numbers[i % 9]), Float(numbers[i / 9 % 9])};
        const Float depth = numbers[i / 81];
        for (const Float share :
             {filteredShadow<1>({&map}, uv, depth), filteredShadow<5>({&map}, uv, depth),
              shadowOfOneTexel({.texture = &map, .filter = Filter::nearest, .mipmaps = false}, uv, depth)})
            outOfRange += share[0] >= 0.0f && share[0] <= 1.0f ? 0 : 1;
    }
    wrong += filteredShadow<1>({&map}, float2(0.5f), Float(kNan))[0] != 0.0f;
    wrong += filteredShadow<5>({}, float2(0.5f), 0.75f)[0] != 1.0f;  // no map: lit
    measured("shares wrong", wrong, 0);
    measured("shares that are not 0 to 1", outOfRange, 0);
}

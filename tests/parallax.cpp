// Parallax functions: the pictures of the stages that show them, surfaces whose answer is known, and directions and
// heights that break the obvious form.
#include "relief/shading/parallax.h"

#include "common/render.h"
#include "numbers.h"
#include "shading_fixture.h"

using namespace fixture;
using namespace relief::samples;

namespace {

enum class Method
{
    offset,
    limited,
    steep,
    occlusion,
    relief
};

// With the uniforms' defaults of the stages.
template <class HeightAt>
float2 offsetBy(Method method, const float3& viewDir, Float strength, Float steps, const HeightAt& heightAt)
{
    const auto height = [&] { return (heightAt(float2(0.0f)) - 0.5f) * strength; };
    switch (method) {
        case Method::offset:
            return parallaxOffset(viewDir, height());
        case Method::limited:
            return limitedParallaxOffset(viewDir, height(), 0.42f);
        case Method::steep:
            return steepParallaxOffset(viewDir, strength, steps, heightAt);
        case Method::occlusion:
            return occlusionParallaxOffset(viewDir, strength, steps, heightAt);
        default:
            return reliefParallaxOffset(viewDir, strength, steps, 5, heightAt);
    }
}
constexpr Method kMethods[] = {Method::offset, Method::limited, Method::steep, Method::occlusion, Method::relief};

// --- the stages' scene ---

struct VertexData
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
    TEXCOORD<1, float3> viewDir;   // tangent space
    TEXCOORD<2, float3> lightDir;  // tangent space
};

struct StageVertexProgram : ParallaxMaterial
{
    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = v.uv;
        const float3 normal = UnityObjectToWorldNormal(object, v.normal);
        const float3 tangent = UnityObjectToWorldDir(object, v.tangent.xyz());
        const float3 binormal = CreateBinormal(normal, tangent, v.tangent.w, object.unity_WorldTransformParams.w);
        const float3 view = worldSpaceCameraPos - mul(object.worldFromObject, v.position).xyz();
        i.viewDir = float3(dot(view, tangent), dot(view, binormal), dot(view, normal));
        i.lightDir = float3(dot(light.dir, tangent), dot(light.dir, binormal), dot(light.dir, normal));
        return i;
    }
};

struct StageFragmentProgram : ParallaxMaterial
{
    Method method = {};

    float4 operator()(Interpolators i) const
    {
        const float2 dx = ddx(i.uv), dy = ddy(i.uv), uv = i.uv;
        const auto heightAt = [&](const float2& aside) { return tex2Dgrad(heightMap, uv + aside, dx, dy).x; };
        i.uv += offsetBy(method, i.viewDir, parallaxStrength, 10.0f, heightAt);
        const float3 albedo = tex2Dgrad(mainTex, i.uv, dx, dy).rgb();
        const float3 normal = normalize(UnpackScaleNormal(tex2Dgrad(normalMap, i.uv, dx, dy), bumpScale));
        const Float diffuse = saturate(dot(normal, normalize(i.lightDir)));
        return float4(albedo * (light.color * diffuse + ambient), 1);
    }
};

PreparedStage prepared(const char* id)
{
    const auto stage = findStage(id);
    REQUIRE(stage.has_value());
    Expected<PreparedStage> result = PreparedStage::prepare(**stage);
    REQUIRE(result.has_value());
    return std::move(*result);
}

constexpr int kWidth = 160, kHeight = 90;

Framebuffer stagePicture(const PreparedStage& stage, const Camera& camera)
{
    Framebuffer target = *Framebuffer::create(kWidth, kHeight, Format::rgba32f);
    Frame frame(target);
    stage.record(frame, kWidth, kHeight, camera);
    REQUIRE(stage.problem(frame).empty());
    frame.run();
    return target;
}

Framebuffer ownPicture(const PreparedStage& stage, Method method)
{
    Framebuffer target = *Framebuffer::create(kWidth, kHeight, Format::rgba32f);
    Frame frame(target);
    frame.clear(kBackground);
    stage.log->clear();
    const Scene s = stage.scene(frame, kWidth, kHeight, stage.camera());
    const Object o = s.lying();
    StageFragmentProgram fragment = s.uniforms(o.worldFromObject);
    fragment.method = method;
    s.draw(*o.mesh, StageVertexProgram(s.uniforms(o.worldFromObject)), fragment);
    frame.run();
    return target;
}

}  // namespace

TEST_CASE("parallax: the functions draw the pictures of stages 5.10 to 5.14, bit for bit")
{
    const char* const ids[] = {"5.10", "5.11", "5.12", "5.13", "5.14"};
    for (std::size_t k = 0; k < 5; ++k) {
        CAPTURE(ids[k]);
        const PreparedStage stage = prepared(ids[k]);
        const Framebuffer its = stagePicture(stage, stage.camera());
        int background = 0;
        for (const glm::vec4& c : its.color32f()) background += c == kBackground;
        CHECK(background < kWidth * kHeight * 3 / 4);
        CHECK(its.samePixels(ownPicture(stage, kMethods[k])));
    }
}

TEST_CASE("parallax: on a level surface and on a ramp the answer is known")
{
    // Level, at height h: every march ends at 1 - h below the top, within a step; the straight line finds it.
    const float3 viewDir = {Float(0.6f), Float(-0.3f), Float(0.5f)};
    const auto level = [](const float2&) { return Float(0.35f); };
    const double down = 0.65 * 0.1;
    for (const int steps : {4, 10, 100}) {
        const float2 steep = steepParallaxOffset(viewDir, 0.1f, static_cast<float>(steps), level);
        const float2 line = occlusionParallaxOffset(viewDir, 0.1f, static_cast<float>(steps), level);
        const float2 halved = reliefParallaxOffset(viewDir, 0.1f, static_cast<float>(steps), 8, level);
        CHECK(static_cast<double>(steep.x[0]) <= -1.2 * down + 1e-6);
        CHECK(static_cast<double>(steep.x[0]) >= -1.2 * (down + 0.1 / steps) - 1e-6);
        CHECK(static_cast<double>(line.x[0]) == doctest::Approx(-1.2 * down).epsilon(1e-5));
        CHECK(static_cast<double>(line.y[0]) == doctest::Approx(0.6 * down).epsilon(1e-5));
        CHECK(std::abs(static_cast<double>(halved.x[0]) + 1.2 * down) <= 1.2 * 0.1 / steps / 256.0 + 1e-6);
    }
    // A ramp that rises against the ray, h = 0.5 + 4 u: the ray is at 1 - u / 0.12, from which u = 0.5 / (4 + 1 /
    // 0.12).
    const auto ramp = [](const float2& offset) { return 0.5f - 4.0f * offset.x; };
    const double u = 0.5 / (4.0 + 1.0 / 0.12);
    CHECK(static_cast<double>(occlusionParallaxOffset(viewDir, 0.1f, 7.0f, ramp).x[0]) ==
          doctest::Approx(-u).epsilon(1e-5));
    // From the flat surface: the height times the tangent; limited: divided by z + bias.
    CHECK(parallaxOffset(viewDir, 0.05f).x[0] == doctest::Approx(0.06).epsilon(1e-6));
    const double length = std::sqrt(0.36 + 0.09 + 0.25);
    CHECK(limitedParallaxOffset(viewDir, 0.05f, 0.42f).x[0] ==
          doctest::Approx(0.6 / length / (0.5 / length + 0.42) * 0.05).epsilon(1e-6));
}

TEST_CASE("parallax: along the horizon, below it, and directions that are none (S-921)")
{
    const float numbers[] = {0.0f,  -0.0f,  1.0f, -1.0f, 1e-20f,    0x1p-149f, -0x1p-149f,
                             3e38f, -3e38f, 0.3f, kNan,  kInfinity, -kInfinity};
    constexpr int kNumbers = 13;
    constexpr float kStrength = 0.06f;
    const auto heights = [](const float2& offset) { return frac(offset.x * 3.7f + offset.y * 1.9f + 0.4f); };
    int notFinite = 0, moved = 0, endless = 0;
    double longest = 0.0;
    for (int i = 0; i < kNumbers * kNumbers * kNumbers; ++i) {
        const float x = numbers[i % kNumbers], y = numbers[i / kNumbers % kNumbers],
                    z = numbers[i / kNumbers / kNumbers];
        for (const Method method : kMethods) {
            int looks = 0;
            const float2 offset = offsetBy(method, {Float(x), Float(y), Float(z)}, kStrength, 10.0f,
                                           [&](const float2& aside) { return ++looks, heights(aside); });
            const double length =
                std::fmax(std::abs(static_cast<double>(offset.x[0])), std::abs(static_cast<double>(offset.y[0])));
            notFinite += std::isfinite(offset.x[0]) && std::isfinite(offset.y[0]) ? 0 : 1;
            longest = std::fmax(longest, length);
            moved += !(z > 0.0f) && length > 0.0 ? 1 : 0;
            endless += looks > 10 + 2 + 5 ? 1 : 0;
        }
    }
    measured("offsets NaN or infinite", notFinite, 0);
    measured("offsets from along or below the surface", moved, 0);
    // 11 steps, as 10 tenths need not add up to 1.
    measured("longest offset, in times the strength", longest / static_cast<double>(kStrength), 1.1001e6);
    measured("marches that go on beyond their steps", endless, 0);
}

TEST_CASE("parallax: steps and heights that are no numbers, and no surface at all (S-922)")
{
    const float3 viewDir = {Float(0.6f), Float(-0.3f), Float(0.5f)};
    int notFinite = 0, tooMany = 0;
    for (const float steps : {10.0f, 0.0f, -0.0f, 0.5f, -3.0f, 1e9f, 1e38f, kNan, kInfinity, -kInfinity}) {
        for (const float height : {0.5f, 0.0f, 1.0f, -1.0f, 2.0f, -3e38f, 3e38f, kNan, kInfinity, -kInfinity}) {
            for (const Method method : {Method::steep, Method::occlusion, Method::relief}) {
                int looks = 0;
                const float2 offset =
                    offsetBy(method, viewDir, 0.06f, steps, [&](const float2&) { return ++looks, Float(height); });
                notFinite += std::isfinite(offset.x[0]) && std::isfinite(offset.y[0]) ? 0 : 1;
                const double wanted = steps >= 1.0f ? std::fmin(static_cast<double>(steps), 1024.0) : 1.0;
                tooMany += looks > wanted + 2.0 + 5.0 ? 1 : 0;
            }
        }
    }
    measured("offsets NaN or infinite", notFinite, 0);
    measured("marches that go on beyond their steps", tooMany, 0);
}

TEST_CASE("parallax: the stages from the surface's own height, and from just above and below it (S-923)")
{
    int notFinite = 0, drawnFromBelow = 0, drawn = 0;
    for (const char* const id : {"5.10", "5.11", "5.12", "5.13", "5.14", "5.15"}) {
        CAPTURE(id);
        const PreparedStage stage = prepared(id);
        for (const float height : {1e-2f, 1e-4f, 1e-6f, 0.0f, -1e-6f, -0.2f}) {
            Camera camera = stage.camera();
            camera.position.y = height;
            camera.target.y = 0.0f;
            camera.nearPlane = 1e-3f;
            const Framebuffer picture = stagePicture(stage, camera);
            for (const glm::vec4& c : picture.color32f()) {
                notFinite += std::isfinite(c.x + c.y + c.z + c.w) ? 0 : 1;
                (height < 0.0f ? drawnFromBelow : drawn) += c != kBackground;
            }
        }
    }
    measured("pixels NaN or infinite", notFinite, 0);
    measured("pixels drawn from below", drawnFromBelow, 0);
    CHECK(drawn > 0);
}

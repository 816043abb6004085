// 5.16 Displacement: Cook 1984
// New: the relief as geometry, and how far from it each of 5.10 to 5.15 is: in distance, and in angle.
// Was: methods that move a picture on a flat quad (5.15).
#include "common/false_color.h"
#include "common/parallax_methods.h"
#include "common/screen_quad.h"
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> viewDir;   // tangent space, not of unit length
    TEXCOORD<2, float3> lightDir;  // tangent space
    TEXCOORD<3, float3> normal;    // tangent space
};

struct Relief : ParallaxMaterial {
    sampler2D normalMap = normals("bricks-heights.png", normalMapSettings(0.06f));  // as steep as the geometry
    Float cells = number("cells", 256.0f, {1, 1024}, "of the geometry, along each side");
    Float maximumDistance = number("maximumDistance", 0.1f, {0.001f, 1}, "red, in widths of the quad");
    Float maximumAngle = number("maximumAngle", 60.0f, {1, 180}, "red, degrees");
};

// Flat, or with every vertex moved down from the quad to where the surface is.
template <bool DISPLACED>
struct MyVertexProgram : Relief {
    Float HeightAt(const float2& uv) const { return tex2Dlod(heightMap, float4(uv, 0, 0)).x; }

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        float3 position = v.position.xyz();
        i.normal = float3(0, 0, 1);
        if constexpr (DISPLACED) {
            position += v.normal * ((HeightAt(v.uv) - 1.0f) * parallaxStrength);
            const float2 du = {texelSize(heightMap).x, 0.0f}, dv = {0.0f, texelSize(heightMap).y};
            const Float slopeU = (HeightAt(v.uv + du) - HeightAt(v.uv - du)) / (2.0f * du.x);
            const Float slopeV = (HeightAt(v.uv + dv) - HeightAt(v.uv - dv)) / (2.0f * dv.y);
            i.normal = normalize(float3(-slopeU * parallaxStrength, -slopeV * parallaxStrength, 1.0f));
        }
        i.position = UnityObjectToClipPos(object, float4(position, 1));
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

// A picture; or which point of the relief is seen, as its uv, and the normal there. uv begins at 1: 0 is nothing.
template <ParallaxMethod METHOD, bool PICTURE>
struct MyFragmentProgram : Relief {
    Float parallaxBias = number("parallaxBias", 0.42f, {0, 1}, "of 5.11");
    Float steps = number("steps", 10.0f, {1, 128}, "layers of 5.12 to 5.15");

    float4 operator()(Interpolators i) const {
        // Errors are those of the methods, not of filters: of the finest level.
        const float2 dx = PICTURE ? ddx(i.uv) : float2(0.0f), dy = PICTURE ? ddy(i.uv) : float2(0.0f);
        const auto heightAt = [&](const float2& by) { return tex2Dgrad(heightMap, i.uv + by, dx, dy).x; };
        i.uv += ParallaxOffset<METHOD>(i.viewDir, parallaxStrength, parallaxBias, steps, heightAt);
        float3 normal = normalize(UnpackScaleNormal(tex2Dgrad(normalMap, i.uv, dx, dy), bumpScale));
        if constexpr (METHOD == ParallaxMethod::none) normal = normalize(i.normal);
        if constexpr (!PICTURE) return float4(i.uv + 1.0f, normal.xy());
        const float3 albedo = tex2Dgrad(mainTex, i.uv, dx, dy).rgb();
        Float diffuse = saturate(dot(normal, normalize(i.lightDir)));
        if constexpr (METHOD == ParallaxMethod::selfShadow)
            diffuse *= SelfShadow(i.lightDir, parallaxStrength, steps, heightAt);
        return float4(albedo * (light.color * diffuse + ambient), 1);
    }
};

template <bool ANGLE>
struct ShowError : Relief {
    sampler2D seen = {}, truth = {};

    float3 PointAt(const float2& uv) const {
        return float3(uv, tex2Dlod(heightMap, float4(uv, 0, 0)).x * parallaxStrength);
    }
    float4 operator()(ScreenInterpolators i, Discard& discard) const {
        const float4 a = tex2D(seen, i.uv), b = tex2D(truth, i.uv);
        discard(a.x == 0.0f);
        const auto normal = [](const float2& n) { return float3(n, sqrt(saturate(1.0f - dot(n, n)))); };
        const Float part = ANGLE ? degreesBetween(normal(a.zw()), normal(b.zw())) / maximumAngle
                                 : length(PointAt(a.xy() - 1.0f) - PointAt(b.xy() - 1.0f)) / maximumDistance;
        return float4(select(b.x == 0.0f, float3(0.3f), falseColor(part)), 1);  // grey: the geometry is not there
    }
};

struct ShowScale {
    float4 operator()(ScreenInterpolators i) const { return float4(falseColor(i.uv.x), 1); }
};

template <ParallaxMethod METHOD, bool PICTURE>
void DrawRelief(const Scene& s) {
    const Relief relief = s.uniforms();
    const float down = BeginsInTheMiddle(METHOD) ? -0.5f * relief.parallaxStrength[0] : 0.0f;
    const Uniforms its = s.uniforms(translation({0, down, 0}) * s.lying().worldFromObject);
    const int side = static_cast<int>(relief.cells[0]);
    const Mesh& mesh = METHOD == ParallaxMethod::none ? s.keep(makeGrid(side, side)) : s.mesh;
    s.draw(mesh, MyVertexProgram<METHOD == ParallaxMethod::none>(its), MyFragmentProgram<METHOD, PICTURE>(its));
}

template <ParallaxMethod METHOD>
sampler2D SeenBy(const Scene& s) {
    const Attachment depth = {Format::depth32f, Store::discard};
    const Framebuffer& seen = s.pass(*Framebuffer::create(s.width, s.height, {{Format::rgba32f}, depth}),
                                     [](const Scene& p) { DrawRelief<METHOD, false>(p); });
    sampler2D nearest = s.sampled(seen, seen.colorIndex());
    nearest.filter = Filter::nearest;
    return nearest;
}

template <ParallaxMethod METHOD>
void DrawRow(const Scene& s, const char* name, const sampler2D& truth) {
    constexpr int row = static_cast<int>(METHOD);
    s.cutCell(0, 3, row, kParallaxMethods);
    DrawRelief<METHOD, true>(s);
    s.label(name);
    if constexpr (METHOD == ParallaxMethod::none) return;
    const sampler2D seen = SeenBy<METHOD>(s);
    ShowError<false> distance = s.uniforms();
    ShowError<true> angle = s.uniforms();
    distance.seen = angle.seen = seen;
    distance.truth = angle.truth = truth;
    s.cutCell(1, 3, row, kParallaxMethods);
    s.draw(primitive("quad"), ScreenVertexProgram{}, distance);
    s.cutCell(2, 3, row, kParallaxMethods);
    s.draw(primitive("quad"), ScreenVertexProgram{}, angle);
}

}  // namespace

Stage beyond_16_displacement() {
    return {.title = "Displacement",
            .section = "Cook 1984",
            .news = "The relief as geometry, and the distance and the angle to it of 5.10 to 5.15.",
            .uniforms = declared<MyFragmentProgram<ParallaxMethod::relief, true>>(),
            .camera = {.position = {-0.76f, 1.36f, -3.24f}, .target = {0.05f, -0.03f, 0.0f}, .fieldOfView = 46.0f},
            .draw = [](const Scene& s) {
                const sampler2D truth = SeenBy<ParallaxMethod::none>(s);
                const Relief relief = s.uniforms();
                DrawRow<ParallaxMethod::none>(s, "geometry", truth);
                DrawRow<ParallaxMethod::parallax>(s, "5.10 parallax", truth);
                DrawRow<ParallaxMethod::limited>(s, "5.11 limited", truth);
                DrawRow<ParallaxMethod::steep>(s, "5.12 steep", truth);
                DrawRow<ParallaxMethod::occlusion>(s, "5.13 occlusion", truth);
                DrawRow<ParallaxMethod::relief>(s, "5.14 relief", truth);
                DrawRow<ParallaxMethod::selfShadow>(s, "5.15 self shadow", truth);
                s.cutCell(1, 3, 0, kParallaxMethods);
                s.draw(primitive("quad"), ScreenVertexProgram{0.28f, 0.05f}, ShowScale{});
                s.label("distance, 0 to " + shortNumber(relief.maximumDistance[0]));
                s.cutCell(2, 3, 0, kParallaxMethods);
                s.draw(primitive("quad"), ScreenVertexProgram{0.28f, 0.05f}, ShowScale{});
                s.label("angle, 0 to " + shortNumber(relief.maximumAngle[0]) + " degrees");
            }};
}

}  // namespace relief::samples

// 5.06 Soft shadow edges: Reeves et al. 1987
// New: several comparisons, and their mean.
// Was: one comparison of 2x2 texels (5.05).
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
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = v.uv;
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        return i;
    }
};

struct DepthInterpolators {
    SV_POSITION position;
};

// From the light only where a surface is counts.
struct DepthVertexProgram : Uniforms {
    DepthInterpolators operator()(VertexData v) const { return {UnityObjectToClipPos(object, v.position)}; }
};
struct NoColor {
    float4 operator()(DepthInterpolators) const { return float4(0.0f); }
};

// TAPS x TAPS comparisons of 2x2 texels each; 0: one texel, and yes or no.
template <int TAPS>  // new
struct MyFragmentProgram : StoneMaterial {
    float4x4 lightFromWorld = {};
    SamplerComparisonState shadowMap = {};
    sampler2D depths = {};  // new
    Float offset = 0.0f;    // along the surface's own normal, not the bump's  // new

    // The share of light that arrives.
    Float Shadow(const float3& worldPos) const {
        const float4 p = mul(lightFromWorld, float4(worldPos, 1));
        const float2 uv = p.xy() * 0.5f + 0.5f;                                                        // new
        if constexpr (TAPS == 0) return select(p.z <= tex2D(depths, uv).x, Float(1.0f), Float(0.0f));  // new
        const float2 texel = texelSize(depths).xy();                                                   // new
        Float sum = 0.0f;                                                                              // new
        for (int y = 0; y < TAPS; ++y) {                                                               // new
            for (int x = 0; x < TAPS; ++x) {                                                           // new
                const float2 aside = {Float(static_cast<float>(x)), Float(static_cast<float>(y))};     // new
                sum += SampleCmp(shadowMap, uv + (aside - (TAPS - 1) * 0.5f) * texel, p.z);            // new
            }
        }
        return sum / static_cast<float>(TAPS * TAPS);  // new
    }

    float4 operator()(Interpolators i) const {
        float3 normal = normalize(i.normal);
        const Float shadow = Shadow(i.worldPos + normal * offset);
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
        const Float diffuse = saturate(dot(normal, light.dir)) * shadow;
        return float4(tint.rgb() * (light.color * diffuse + ambient), 1);
    }
};

struct Lamp : StoneMaterial {
    Float mapSize = number("mapSize", 128.0f, {16, 2048}, "side of the shadow map, texels");  // new
    Float slopeBias = number("slopeBias", 1.5f, {0, 16}, "of what depth changes by from a texel to the next");
    Float normalOffset = number("normalOffset", 0.04f, {0, 0.5f}, "how far a point is moved off its surface");  // new
};

glm::mat4 LightFromWorld(const Lamp& lamp) {
    return orthographic(4.4f, 4.4f, 1.0f, 6.0f) * lookAt(firstLane(lamp.light.dir) * 3.5f, glm::vec3(0));
}

// The depth of everything that the light sees.
sampler2D ShadowMap(const Scene& s, const Lamp& lamp, const RenderState& state = {}) {
    const int side = static_cast<int>(lamp.mapSize[0]);
    const Framebuffer& map = s.pass(*Framebuffer::create(side, side, {{Format::depth32f}}), LightFromWorld(lamp),
                                    [&state](const Scene& fromLight) {
                                        for (const Object& o : fromLight.objects)
                                            fromLight.draw<DepthVertexProgram, NoColor>(o, state);
                                    });
    return s.sampled(map, map.depthIndex());
}

// In one column of the picture.
template <int TAPS>                                                             // new
void DrawColumn(const Scene& s, int column, const Lamp& lamp, sampler2D map) {  // new
    map.filter = Filter::nearest;                                               // new
    s.cutCell(column, 4);
    for (const Object& o : s.objects) {
        MyFragmentProgram<TAPS> fragment = s.uniforms(o.worldFromObject);  // new
        fragment.lightFromWorld = broadcast(LightFromWorld(lamp));
        fragment.shadowMap = {map.texture};
        fragment.depths = map;                // new
        fragment.offset = lamp.normalOffset;  // new
        s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment);
    }
}

}  // namespace

Stage beyond_06_soft_shadow_edges() {
    return {.title = "Soft shadow edges",
            .section = "Reeves et al. 1987",
            .news = "One texel, 2x2 weighted, 3x3 and 5x5 of those: the edge goes from steps to soft.",
            .uniforms = declared<MyFragmentProgram<1>, Lamp>(),
            .mesh = "cube+sphere+quad",
            .camera = {.position = {0.0f, 1.2f, -3.3f}, .target = {0.0f, -0.1f, 0.0f}},
            .draw = [](const Scene& s) {
                const Lamp lamp = s.uniforms();
                const sampler2D map = ShadowMap(s, lamp, {.depthBias = {0.0f, lamp.slopeBias[0], 0.0f}});
                DrawColumn<0>(s, 0, lamp, map);
                DrawColumn<1>(s, 1, lamp, map);
                DrawColumn<3>(s, 2, lamp, map);
                DrawColumn<5>(s, 3, lamp, map);
                s.labelColumns({"one texel", "2x2, weighted", "3x3 of them", "5x5 of them"});
            }};
}

}  // namespace relief::samples

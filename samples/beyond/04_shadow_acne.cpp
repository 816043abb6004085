// 5.04 Shadow acne: Rendering 7
// New: a surface asks the map whether it is lit, and often meets itself.
// Was: a map that nobody asked (5.03).
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

template <bool BUMPS>
struct MyFragmentProgram : StoneMaterial {
    float4x4 lightFromWorld = {};
    SamplerComparisonState shadowMap = {};

    // The share of light that arrives: what is no farther from the light than the surface that it saw there.
    Float Shadow(const float3& worldPos) const {
        const float4 p = mul(lightFromWorld, float4(worldPos, 1));
        return SampleCmp(shadowMap, p.xy() * 0.5f + 0.5f, p.z);
    }

    float4 operator()(Interpolators i) const {
        float3 normal = normalize(i.normal);
        if constexpr (BUMPS) {
            const float3 binormal =
                CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
            const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
            normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
        }
        const Float diffuse = saturate(dot(normal, light.dir)) * Shadow(i.worldPos);
        return float4(tint.rgb() * (light.color * diffuse + ambient), 1);
    }
};

struct Lamp : StoneMaterial {
    Float mapSize = number("mapSize", 256.0f, {16, 2048}, "side of the shadow map, texels");
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

template <bool BUMPS>
void DrawLit(const Scene& s, const Lamp& lamp, const sampler2D& map) {
    for (const Object& o : s.objects) {
        MyFragmentProgram<BUMPS> fragment = s.uniforms(o.worldFromObject);
        fragment.lightFromWorld = broadcast(LightFromWorld(lamp));
        fragment.shadowMap = {map.texture};
        s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment);
    }
}

}  // namespace

Stage beyond_04_shadow_acne() {
    return {.title = "Shadow acne",
            .section = "Rendering 7",
            .news = "Wrong on purpose: no bias. Surfaces shadow themselves in stripes, and bumps make it worse.",
            .uniforms = declared<MyFragmentProgram<true>, Lamp>(),
            .mesh = "cube+sphere+quad",
            .camera = {.position = {0.0f, 1.2f, -3.3f}, .target = {0.0f, -0.1f, 0.0f}},
            .draw = [](const Scene& s) {
                const Lamp lamp = s.uniforms();
                const sampler2D map = ShadowMap(s, lamp);
                s.cutCell(0, 2);
                DrawLit<false>(s, lamp, map);
                s.cutCell(1, 2);
                DrawLit<true>(s, lamp, map);
                s.labelColumns({"wrong: smooth", "wrong: with bumps"});
            }};
}

}  // namespace relief::samples

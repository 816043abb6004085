// 5.05 Shadow bias: D3D 11.3 15.10; Rendering 7
// New: depths are moved away from the light, or points off their surface.
// Was: surfaces that shadow themselves (5.04).
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
    Float offset = 0.0f;  // along the surface's own normal, not the bump's  // new

    // The share of light that arrives: what is no farther from the light than the surface that it saw there.
    Float Shadow(const float3& worldPos) const {
        const float4 p = mul(lightFromWorld, float4(worldPos, 1));
        return SampleCmp(shadowMap, p.xy() * 0.5f + 0.5f, p.z);
    }

    float4 operator()(Interpolators i) const {
        float3 normal = normalize(i.normal);
        const Float shadow = Shadow(i.worldPos + normal * offset);  // new
        if constexpr (BUMPS) {
            const float3 binormal =
                CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
            const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
            normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
        }
        const Float diffuse = saturate(dot(normal, light.dir)) * shadow;  // new
        return float4(tint.rgb() * (light.color * diffuse + ambient), 1);
    }
};

struct Lamp : StoneMaterial {
    Float mapSize = number("mapSize", 256.0f, {16, 2048}, "side of the shadow map, texels");
    Float constantBias = number("constantBias", 60000.0f, {0, 1e6f}, "steps of a float that depths are moved away");
    Float slopeBias = number("slopeBias", 1.5f, {0, 16}, "of what depth changes by from a texel to the next");  // new
    Float normalOffset = number("normalOffset", 0.03f, {0, 0.5f}, "how far a point is moved off its surface");  // new
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

// With a map that is drawn with a bias, in one column of the picture.
template <bool BUMPS>
void DrawColumn(const Scene& s, int column, const Lamp& lamp, const DepthBias& bias, Float offset = 0.0f) {  // new
    const sampler2D map = ShadowMap(s, lamp, {.depthBias = bias});                                           // new
    s.cutCell(column, 4);                                                                                    // new
    for (const Object& o : s.objects) {
        MyFragmentProgram<BUMPS> fragment = s.uniforms(o.worldFromObject);
        fragment.lightFromWorld = broadcast(LightFromWorld(lamp));
        fragment.shadowMap = {map.texture};
        fragment.offset = offset;  // new
        s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment);
    }
}

}  // namespace

Stage beyond_05_shadow_bias() {
    return {.title = "Shadow bias",
            .section = "D3D 11.3 15.10; Rendering 7",
            .news = "Constant, by slope, along the normal; and too much, where shadows let go of their objects.",
            .uniforms = declared<MyFragmentProgram<true>, Lamp>(),
            .mesh = "cube+sphere+quad",
            .camera = {.position = {0.0f, 1.2f, -3.3f}, .target = {0.0f, -0.1f, 0.0f}},
            .draw = [](const Scene& s) {
                const Lamp lamp = s.uniforms();
                const float constant = lamp.constantBias[0], slope = lamp.slopeBias[0];
                DrawColumn<true>(s, 0, lamp, {constant, 0.0f, 0.0f});
                DrawColumn<true>(s, 1, lamp, {0.0f, slope, 0.0f});
                DrawColumn<true>(s, 2, lamp, {}, lamp.normalOffset);
                DrawColumn<true>(s, 3, lamp, {constant * 80.0f, slope, 0.0f});
                s.labelColumns({"constant", "by slope", "along the normal", "too much"});
            }};
}

}  // namespace relief::samples

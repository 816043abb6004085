// 1.04 Forward difference: Rendering 6 "Bumpiness", section 1.3-1.4
// New: the slope along u, from this texel and the next; the tangent is used as if it were the normal.
// Was: the height alone (1.03).
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> worldPos;
};

struct MyVertexProgram : LitMaterial {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.uv = TRANSFORM_TEX(v.uv, mainTex_ST);
        return i;
    }
};

struct MyFragmentProgram : LitMaterial {
    sampler2D heightMap = heights("marble-heights.png");
    float4 heightMap_TexelSize = texelSize(heightMap);  // new

    void InitializeFragmentNormal(Interpolators& i) const {
        const float2 delta = float2(heightMap_TexelSize.x, 0);  // new
        const Float h1 = tex2D(heightMap, i.uv).x;              // new
        const Float h2 = tex2D(heightMap, i.uv + delta).x;      // new
        i.normal = float3(delta.x, h2 - h1, 0);                 // new
        i.normal = normalize(i.normal);
    }

    float4 operator()(Interpolators i) const {
        InitializeFragmentNormal(i);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv).xyz() * tint.xyz();
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, light);
    }
};

}  // namespace

Stage bumpiness_04_forward_difference() {
    return {.title = "Forward difference",
            .section = "1.3-1.4",
            .news = "Wrong on purpose: the tangent of a very steep height field, used as its normal.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

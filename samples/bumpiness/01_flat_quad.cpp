// 1.01 Flat quad: Rendering 6 "Bumpiness", section 1
// New: a quad has four normals, and they are all the same: nothing to see.
// Was: the lit surface of Rendering 5.
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
    float4 operator()(Interpolators i) const {
        i.normal = normalize(i.normal);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv).xyz() * tint.xyz();
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, light);
    }
};

}  // namespace

Stage bumpiness_01_flat_quad() {
    return {.title = "Flat quad",
            .section = "1",
            .news = "One quad, four equal normals: whatever the light, it looks flat.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

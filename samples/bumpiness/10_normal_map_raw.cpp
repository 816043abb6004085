// 1.10 Normal map, raw: Rendering 6 "Bumpiness", section 2.1
// New: a normal map, made from the heights when it is loaded; one fetch instead of four. Wrong: it is not RGB.
// Was: normals from four heights (1.09).
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
    sampler2D normalMap = normals("marble-heights.png");  // new

    void InitializeFragmentNormal(Interpolators& i) const {
        i.normal = tex2D(normalMap, i.uv).xyz() * 2.0f - 1.0f;  // new
        i.normal = i.normal.xzy();                              // new
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

Stage bumpiness_10_normal_map_raw() {
    return {.title = "Normal map, raw",
            .section = "2.1",
            .news = "Wrong on purpose: a DXT5nm normal map, read as if x, y and z were in red, green and blue.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

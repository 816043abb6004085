// 1.14 Detail albedo: Rendering 6 "Bumpiness", section 3
// New: a detail texture, whose uv travel in the other half of the same TEXCOORD.
// Was: one texture, without and with bumps (1.13).
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
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw  // new
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> worldPos;
};

struct MyMaterial : LitMaterial {                                                                           // new
    sampler2D mainTex = albedo("marble-albedo.png");                                                        // new
    sampler2D normalMap = normals("marble-heights.png");                                                    // new
    Float bumpScale = number("bumpScale", 0.5f, {-32, 32}, "the bumps' strength; 1: as the map was made");  // new
    sampler2D detailTex = detail("marble-detail.png", kFadedOut);                                           // new
    float4 detailTex_ST = vector("detailTex_ST", {3, 3, 0, 0}, {-64, 64}, "tiling and offset of both detail textures");
};

struct MyVertexProgram : MyMaterial {  // new
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));  // new
        return i;
    }
};

struct MyFragmentProgram : MyMaterial {  // new
    void InitializeFragmentNormal(Interpolators& i) const {
        i.normal = UnpackScaleNormal(tex2D(normalMap, i.uv.xy()), bumpScale);  // new
        i.normal = i.normal.xzy();
        i.normal = normalize(i.normal);
    }

    float4 operator()(Interpolators i) const {
        InitializeFragmentNormal(i);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv.xy()).xyz() * tint.xyz();          // new
        albedo *= tex2D(detailTex, i.uv.zw()).xyz() * unity_ColorSpaceDouble;  // new
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, light);
    }
};

}  // namespace

Stage bumpiness_14_detail_albedo() {
    return {.title = "Detail albedo",
            .section = "3",
            .news = "A finer grain over the marble's colours; it fades out in the distance.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

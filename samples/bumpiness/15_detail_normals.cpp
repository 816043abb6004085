// 1.15 Detail normals: Rendering 6 "Bumpiness", section 3.1
// New: a normal map of the detail, made from the same grey picture; it alone is shown.
// Was: the detail in the colours only (1.14).
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
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> worldPos;
};

struct MyMaterial : LitMaterial {
    sampler2D normalMap = normals("marble-heights.png");
    Float bumpScale = number("bumpScale", 0.5f, {-32, 32}, "the bumps' strength; 1: as the map was made");
    sampler2D detailTex = detail(kNone, kFadedOut);  // new
    float4 detailTex_ST = vector("detailTex_ST", {3, 3, 0, 0}, {-64, 64}, "tiling and offset of both detail textures");
    sampler2D detailNormalMap = detailNormals("marble-detail.png", normalMapSettings(0.1f, true));  // new
    Float detailBumpScale = number("detailBumpScale", 0.5f, {-32, 32}, "the bumps' strength; 1: as the map was made");
};

struct MyVertexProgram : MyMaterial {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

struct MyFragmentProgram : MyMaterial {
    void InitializeFragmentNormal(Interpolators& i) const {
        i.normal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);  // new
        i.normal = i.normal.xzy();
        i.normal = normalize(i.normal);
    }

    float4 operator()(Interpolators i) const {
        InitializeFragmentNormal(i);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv.xy()).xyz() * tint.xyz();
        albedo *= tex2D(detailTex, i.uv.zw()).xyz() * unity_ColorSpaceDouble;
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, light);
    }
};

}  // namespace

Stage bumpiness_15_detail_normals() {
    return {.title = "Detail normals",
            .section = "3.1",
            .news = "The grain as bumps, by itself: they fade to flat where the colours fade to grey.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

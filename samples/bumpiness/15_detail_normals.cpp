// 1.15 Detail normals: Rendering 6 "Bumpiness", section 3.1
// New: a normal map of the detail, made from the same grey picture; it alone is shown.
// Was: the detail in the colours only (1.14).
#include "common/stage.h"

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> worldPos;
};

struct MyVertexProgram
{
    ObjectTransform object;
    float4 mainTex_ST, detailTex_ST;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

struct MyFragmentProgram
{
    float4 tint;
    Float metallic, smoothness;
    float3 worldSpaceCameraPos;
    UnityLight light;
    sampler2D mainTex, detailTex;
    sampler2D normalMap, detailNormalMap;
    Float bumpScale, detailBumpScale;

    void InitializeFragmentNormal(Interpolators& i) const
    {
        i.normal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        i.normal = i.normal.xzy();
        i.normal = normalize(i.normal);
    }

    float4 operator()(Interpolators i) const
    {
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

Stage bumpiness_15_detail_normals()
{
    return {.title = "Detail normals",
            .section = "3.1",
            .news = "The grain as bumps, by itself: they fade to flat where the colours fade to grey.",
            .properties = litProperties({mapScaleProperty("bumpScale", 0.5f), detailTilingProperty(),
                                         mapScaleProperty("detailBumpScale", 0.5f)}),
            .inputs = {.mesh = "quad",
                       .albedo = kNone,
                       .normal = "marble-heights.png",
                       .detail = kNone,
                       .detailNormal = "marble-detail.png",
                       .detailImport = {.fadeOutMips = true, .fadeFirst = 2, .fadeLast = 5},
                       .detailNormalImport = normalMapSettings(0.1f, true)},
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) {
                s.draw(s.mesh, MyVertexProgram{s.lying(), s.vector("mainTex_ST"), s.vector("detailTex_ST")},
                       MyFragmentProgram{s.vector("tint"), s.number("metallic"), s.number("smoothness"),
                                         s.worldSpaceCameraPos, s.light, s.mainTex, s.detailTex, s.normalMap,
                                         s.detailNormalMap, s.number("bumpScale"), s.number("detailBumpScale")});
            }};
}

}  // namespace relief::samples

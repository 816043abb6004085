// 5.17 Complex material: Rendering 9 and 10
// New: metallic, smoothness, occlusion, emission and where detail is, all from maps.
// Was: one number for all of a surface (1.25).
#include "common/stage.h"
#include "relief/shading/environment.h"

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
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
};

struct Inlay : DetailedMaterial {
    sampler2D mainTex = albedo("inlay-albedo.png");
    float4 mainTex_ST = vector("mainTex_ST", {2, 1, 0.1f, 0}, {-16, 16}, "tiling in x and y, offset in z and w");
    sampler2D normalMap = normals("bricks-heights.png", normalMapSettings(0.04f));
    sampler2D detailTex = detail("marble-detail.png", kFadedOut);
    sampler2D detailNormalMap = detailNormals("marble-detail.png", normalMapSettings(0.1f, true));
    float4 detailTex_ST = vector("detailTex_ST", {4, 4, 0, 0}, {-64, 64}, "tiling and offset of both detail textures");
    Float detailBumpScale = number("detailBumpScale", 1.0f, {-32, 32}, "the bumps' strength; 1: as the map was made");
    sampler2D maskMap = mask("inlay-mask.png");
    sampler2D emissionMap = emission("inlay-emission.png");
    Float smoothness = number("smoothness", 0.5f, {0, 1}, "where there is no map; 0 matte, 1 polished");
    Float occlusionStrength = number("occlusionStrength", 1.0f, {0, 1}, "0: none, 1: as the map has it");
    float3 emissionColor = rgb("emissionColor", glm::vec3(1.0f), "what the emission map is multiplied by");
    Float exposure = number("exposure", 1.1f, {0, 8}, "what all light is multiplied by");
    UnityLight light = sun(40.0f, 55.0f);
    samplerCUBE environment = reflections();
    SphericalHarmonics surroundingLight = irradiance();
};

struct MyVertexProgram : Inlay {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        return i;
    }
};

// With the first few of the maps; 5 are all.
template <int MAPS>
struct MyFragmentProgram : Inlay {
    Float GetMetallic(const float4& mask) const { return MAPS >= 1 ? mask.r : metallic; }
    Float GetSmoothness(const float4& mask) const { return MAPS >= 2 ? mask.a : smoothness; }
    Float GetOcclusion(const float4& mask) const {
        return MAPS >= 3 ? lerp(Float(1.0f), mask.g, occlusionStrength) : Float(1.0f);
    }
    float3 GetEmission(const Interpolators& i) const {
        return MAPS >= 4 ? tex2D(emissionMap, i.uv.xy()).rgb() * emissionColor : float3(0.0f);
    }
    Float GetDetailMask(const float4& mask) const { return MAPS >= 5 ? mask.b : Float(1.0f); }

    float3 GetAlbedo(const Interpolators& i, Float detailMask) const {
        const float3 albedo = tex2D(mainTex, i.uv.xy()).rgb() * tint.rgb();
        const float3 details = tex2D(detailTex, i.uv.zw()).rgb() * unity_ColorSpaceDouble;
        return lerp(albedo, albedo * details, detailMask);
    }

    float3 GetNormal(const Interpolators& i, Float detailMask) const {
        const float3 mainNormal = UnpackScaleNormal(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        const float3 bump = BlendNormals(mainNormal, lerp(float3(0, 0, 1), detailNormal, detailMask));
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        return TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
    }

    float4 operator()(Interpolators i) const {
        const float4 mask = tex2D(maskMap, i.uv.xy());
        const float3 normal = GetNormal(i, GetDetailMask(mask));
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);
        float3 specular;
        Float oneMinusReflectivity;
        const float3 diffuse = DiffuseAndSpecularFromMetallic(GetAlbedo(i, GetDetailMask(mask)), GetMetallic(mask),
                                                              specular, oneMinusReflectivity);
        const Float smooth = GetSmoothness(mask), roughness = 1.0f - smooth;
        float3 color = UNITY_BRDF_PBS_Exact(diffuse, specular, smooth, normal, viewDir, light).rgb();

        // The light from everywhere, which alone is kept out of corners.
        const Float level =
            levelOfRoughness(roughness, environment.texture != nullptr ? environment.texture->levelCount() : 1);
        const float3 mirrored = texCUBElod(environment, float4(reflect(-viewDir, normal), level)).rgb();
        const Float grazing = saturate(smooth + 1.0f - oneMinusReflectivity);
        const float3 fresnel = lerp(specular, float3(grazing), Pow5(1.0f - saturate(dot(normal, viewDir))));
        const float3 indirect = diffuse * ShadeSH9(surroundingLight, normal) +
                                mirrored * fresnel / (roughness * roughness * roughness * roughness + 1.0f);
        color += indirect * GetOcclusion(mask) + GetEmission(i);
        return float4(color * exposure, 1);
    }
};

template <int MAPS>
void DrawCell(const Scene& s) {
    s.cutCell(MAPS % 3, 3, MAPS / 3, 2);
    for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram<MAPS>>(o);
}

}  // namespace

Stage beyond_17_complex_material() {
    return {.title = "Complex material",
            .section = "Rendering 9 and 10",
            .news = "Bricks with brass in them, map by map: metallic, smoothness, occlusion, emission, detail mask.",
            .uniforms = declared<MyVertexProgram>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.0f, -3.4f}},
            .draw = [](const Scene& s) {
                DrawCell<0>(s);
                DrawCell<1>(s);
                DrawCell<2>(s);
                DrawCell<3>(s);
                DrawCell<4>(s);
                DrawCell<5>(s);
                s.labelColumns({"no maps", "+ metallic", "+ smoothness"}, 0, 2);
                s.labelColumns({"+ occlusion", "+ emission", "+ detail mask"}, 1, 2);
            }};
}

}  // namespace relief::samples

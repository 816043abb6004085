// 1.25 Lit scene: Rendering 6 "Bumpiness", section 4.4
// New: all of it, under three lights: a base pass, and an additive pass for every further light.
// Was: one light (1.24).
#include "common/stage.h"

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

template <bool BINORMAL_PER_FRAGMENT>
struct Interpolators;

template <>
struct Interpolators<true>
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<4, float3> worldPos;
};

template <>
struct Interpolators<false>
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> tangent;
    TEXCOORD<3, float3> binormal;
    TEXCOORD<4, float3> worldPos;
};

template <bool BINORMAL_PER_FRAGMENT>
struct MyVertexProgram
{
    ObjectTransform object;
    float4 mainTex_ST, detailTex_ST;

    Interpolators<BINORMAL_PER_FRAGMENT> operator()(VertexData v) const
    {
        Interpolators<BINORMAL_PER_FRAGMENT> i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        const float3 tangent = UnityObjectToWorldDir(object, v.tangent.xyz());
        if constexpr (BINORMAL_PER_FRAGMENT) {
            i.tangent = float4(tangent, v.tangent.w);
        } else {
            i.tangent = tangent;
            i.binormal = CreateBinormal(i.normal, tangent, v.tangent.w, object.unity_WorldTransformParams.w);
        }
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

template <bool BINORMAL_PER_FRAGMENT, class Light>
struct MyFragmentProgram
{
    float4 tint;
    Float metallic, smoothness;
    float3 worldSpaceCameraPos;
    Light source;
    sampler2D mainTex, detailTex;
    sampler2D normalMap, detailNormalMap;
    float4 unity_WorldTransformParams;
    Float bumpScale, detailBumpScale;

    void InitializeFragmentNormal(Interpolators<BINORMAL_PER_FRAGMENT>& i) const
    {
        const float3 mainNormal = UnpackScaleNormal(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        const float3 tangentSpaceNormal = BlendNormals(mainNormal, detailNormal);

        const float3 tangent = i.tangent.xyz();
        float3 binormal;
        if constexpr (BINORMAL_PER_FRAGMENT) {
            binormal = CreateBinormal(i.normal, tangent, i.tangent.w, unity_WorldTransformParams.w);
        } else {
            binormal = i.binormal;
        }
        i.normal = normalize(tangent * tangentSpaceNormal.x + binormal * tangentSpaceNormal.y +
                             i.normal * tangentSpaceNormal.z);
    }

    float4 operator()(Interpolators<BINORMAL_PER_FRAGMENT> i) const
    {
        InitializeFragmentNormal(i);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv.xy()).xyz() * tint.xyz();
        albedo *= tex2D(detailTex, i.uv.zw()).xyz() * unity_ColorSpaceDouble;
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        const UnityLight light = CreateLight(source, i.worldPos);
        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, light);
    }
};

// The base pass fills the depth buffer; an additive pass adds its light where that very depth is seen.
constexpr RenderState kBasePass = {};
constexpr RenderState kAdditivePass = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};

template <bool BINORMAL_PER_FRAGMENT, class Light>
void drawPass(const Scene& s, const Object& o, const Light& light, const RenderState& pass)
{
    const ObjectTransform object = s.object(o.worldFromObject);
    s.draw(*o.mesh, MyVertexProgram<BINORMAL_PER_FRAGMENT>{object, s.vector("mainTex_ST"), s.vector("detailTex_ST")},
           MyFragmentProgram<BINORMAL_PER_FRAGMENT, Light>{
               s.vector("tint"), s.number("metallic"), s.number("smoothness"), s.worldSpaceCameraPos, light, s.mainTex,
               s.detailTex, s.normalMap, s.detailNormalMap, object.unity_WorldTransformParams, s.number("bumpScale"),
               s.number("detailBumpScale")},
           pass);
}

template <bool BINORMAL_PER_FRAGMENT>
void drawObject(const Scene& s, const Object& o)
{
    const Float strength = s.number("lightStrength");
    const DirectionalLight sun = {s.light.color * s.number("sunStrength"), s.light.dir};
    const PointLight lamp = {float3(0.25f, 0.5f, 1.0f) * strength, {-0.7f, 0.9f, -0.9f}, 1.6f};
    const SpotLight spot = {float3(1.0f, 0.5f, 0.15f) * strength,
                            {1.7f, 1.7f, -0.9f},
                            4.0f,
                            normalize(float3(-0.47f, -0.75f, 0.43f)),
                            0.9f,
                            0.97f};
    drawPass<BINORMAL_PER_FRAGMENT>(s, o, sun, kBasePass);
    if (s.reaches("the lamp", lamp, o)) drawPass<BINORMAL_PER_FRAGMENT>(s, o, lamp, kAdditivePass);
    if (s.reaches("the spot", spot, o)) drawPass<BINORMAL_PER_FRAGMENT>(s, o, spot, kAdditivePass);
}

}  // namespace

Stage bumpiness_25_lit_scene()
{
    return {.title = "Lit scene",
            .section = "4.4",
            .news = "Cube, sphere and quad under three lights: a base pass and additive passes.",
            .properties = detailedProperties({binormalPerFragmentProperty(kBinormalPerFragment ? 1.0f : 0.0f),
                                              {"sunStrength", glm::vec4(0.5f), 0.0f, 16.0f, 1, "base pass"},
                                              {"lightStrength", glm::vec4(8.0f), 0.0f, 64.0f, 1, "of lamp and spot"}}),
            .inputs = detailedMarble("cube+sphere+quad"),
            .camera = {.position = {0.0f, 1.1f, -2.7f}, .target = {0.0f, -0.1f, 0.0f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) {
                    s.number("binormalPerFragment")[0] != 0.0f ? drawObject<true>(s, o) : drawObject<false>(s, o);
                }
            }};
}

}  // namespace relief::samples

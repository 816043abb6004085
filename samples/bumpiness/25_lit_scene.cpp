// 1.25 Lit scene: Rendering 6 "Bumpiness", section 4.4
// New: all of it, under three lights: a base pass, and an additive pass for every further light.
// Was: one light (1.24).
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

template <bool BINORMAL_PER_FRAGMENT>
struct Interpolators;

template <>
struct Interpolators<true> {
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<4, float3> worldPos;
};

template <>
struct Interpolators<false> {
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main in xy, detail in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> tangent;
    TEXCOORD<3, float3> binormal;
    TEXCOORD<4, float3> worldPos;
};

template <bool BINORMAL_PER_FRAGMENT>
struct MyVertexProgram : DetailedMarble {
    Interpolators<BINORMAL_PER_FRAGMENT> operator()(VertexData v) const {
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

template <bool BINORMAL_PER_FRAGMENT, class Light>  // new
struct MyFragmentProgram : DetailedMarble {
    Light source = {};  // new

    void InitializeFragmentNormal(Interpolators<BINORMAL_PER_FRAGMENT>& i) const {
        const float3 mainNormal = UnpackScaleNormal(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        const float3 tangentSpaceNormal = BlendNormals(mainNormal, detailNormal);

        const float3 tangent = i.tangent.xyz();
        float3 binormal;
        if constexpr (BINORMAL_PER_FRAGMENT) {
            binormal = CreateBinormal(i.normal, tangent, i.tangent.w, object.unity_WorldTransformParams.w);
        } else {
            binormal = i.binormal;
        }
        i.normal = normalize(tangent * tangentSpaceNormal.x + binormal * tangentSpaceNormal.y +
                             i.normal * tangentSpaceNormal.z);
    }

    float4 operator()(Interpolators<BINORMAL_PER_FRAGMENT> i) const {
        InitializeFragmentNormal(i);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv.xy()).xyz() * tint.xyz();
        albedo *= tex2D(detailTex, i.uv.zw()).xyz() * unity_ColorSpaceDouble;
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, CreateLight(source, i.worldPos));
    }
};

// The base pass fills the depth buffer; an additive pass adds its light where that very depth is seen.
constexpr RenderState kBasePass = {};  // new
constexpr RenderState kAdditivePass = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};

struct Lights : Uniforms {  // new
    bool binormalPerFragment = choice("binormalPerFragment", kBinormalPerFragment, {"per vertex", "per fragment"},
                                      "where the binormal is computed") != 0;          // new
    UnityLight light = sun(35.0f, -20.0f);                                             // new
    Float sunStrength = number("sunStrength", 0.5f, {0, 16}, "base pass");             // new
    Float lightStrength = number("lightStrength", 8.0f, {0, 64}, "of lamp and spot");  // new
};

template <bool BINORMAL_PER_FRAGMENT, class Light>                                             // new
void drawPass(const Scene& s, const Object& o, const Light& light, const RenderState& pass) {  // new
    const MyVertexProgram<BINORMAL_PER_FRAGMENT> vertex = s.uniforms(o.worldFromObject);       // new
    MyFragmentProgram<BINORMAL_PER_FRAGMENT, Light> fragment = s.uniforms(o.worldFromObject);  // new
    fragment.source = light;                                                                   // new
    s.draw(*o.mesh, vertex, fragment, pass);                                                   // new
}

template <bool BINORMAL_PER_FRAGMENT>                                                                        // new
void drawObject(const Scene& s, const Object& o, const Lights& lights) {                                     // new
    const DirectionalLight sun = {lights.light.color * lights.sunStrength, lights.light.dir};                // new
    const PointLight lamp = {float3(0.25f, 0.5f, 1.0f) * lights.lightStrength, {-0.7f, 0.9f, -0.9f}, 1.6f};  // new
    const SpotLight spot = {float3(1.0f, 0.5f, 0.15f) * lights.lightStrength,                                // new
                            {1.7f, 1.7f, -0.9f},                                                             // new
                            4.0f,                                                                            // new
                            normalize(float3(-0.47f, -0.75f, 0.43f)),                                        // new
                            0.9f,                                                                            // new
                            0.97f};                                                                          // new
    drawPass<BINORMAL_PER_FRAGMENT>(s, o, sun, kBasePass);                                                   // new
    if (s.reaches("the lamp", lamp, o)) drawPass<BINORMAL_PER_FRAGMENT>(s, o, lamp, kAdditivePass);          // new
    if (s.reaches("the spot", spot, o)) drawPass<BINORMAL_PER_FRAGMENT>(s, o, spot, kAdditivePass);          // new
}

}  // namespace

Stage bumpiness_25_lit_scene() {
    return {.title = "Lit scene",
            .section = "4.4",
            .news = "Cube, sphere and quad under three lights: a base pass and additive passes.",
            .uniforms = declared<MyFragmentProgram<true, PointLight>, Lights>(),
            .mesh = "cube+sphere+quad",
            .camera = {.position = {0.0f, 1.1f, -2.7f}, .target = {0.0f, -0.1f, 0.0f}},
            .draw = [](const Scene& s) {
                const Lights lights = s.uniforms();
                for (const Object& o : s.objects) {
                    lights.binormalPerFragment ? drawObject<true>(s, o, lights) : drawObject<false>(s, o, lights);
                }
            }};
}

}  // namespace relief::samples

// 1.19 Wrong on cube and sphere: Rendering 6 "Bumpiness", section 4
// New: other shapes. Wrong: the bumps of a floor on every side.
// Was: a quad on the ground (1.18).
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

struct MyVertexProgram : DetailedMarble {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

struct MyFragmentProgram : DetailedMarble {
    void InitializeFragmentNormal(Interpolators& i) const {
        const float3 mainNormal = UnpackScaleNormal(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        i.normal = BlendNormals(mainNormal, detailNormal);
        i.normal = i.normal.xzy();
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

Stage bumpiness_19_wrong_on_cube_and_sphere() {
    return {.title = "Wrong on cube and sphere",
            .section = "4",
            .news = "Wrong on purpose: the mesh's own normals are ignored, and every side is lit as a floor.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "cube+sphere",
            .camera = {.position = {0.0f, 0.8f, -2.5f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            }};
}

}  // namespace relief::samples

// 1.25a Make it look wet: the answer of an exercise. The lines between the marks are what the learner writes.
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
    sampler2D mainTex = albedo("marble-albedo.png");
    sampler2D normalMap = normals("marble-heights.png");
    UnityLight light = sun(32.0f, 170.0f);
    Float bumpScale = number("bumpScale", 0.5f, {-32, 32}, "the bumps' strength; 1: as the map was made");

    void InitializeFragmentNormal(Interpolators& i) const {
        i.normal = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        i.normal = i.normal.xzy();
        i.normal = normalize(i.normal);
    }

    float4 operator()(Interpolators i) const {
        InitializeFragmentNormal(i);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv).xyz() * tint.xyz();
        Float wetSmoothness = smoothness;
        // your turn: what water changes
        albedo *= albedo;
        wetSmoothness = 0.9f;
        i.normal = normalize(i.normal + float3(0, 1, 0));
        // end of your turn
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        return UNITY_BRDF_PBS(albedo, specularTint, wetSmoothness, i.normal, viewDir, light);
    }
};

}  // namespace

Stage exercise_1_25a() {
    return {.title = "Make it look wet",
            .section = "",
            .news = "An exercise of stage 1.25.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.2f, 0.55f, -0.85f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

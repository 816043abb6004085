// 1.12a Steeper, but still a normal: the answer of an exercise. The lines between the marks are what the learner
// writes.
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
    sampler2D normalMap = normals("marble-heights.png");
    Float bumpScale = number("bumpScale", 1.6f, {-32, 32}, "the bumps' strength; 1: as the map was made");

    void InitializeFragmentNormal(Interpolators& i) const {
        float2 xy = tex2D(normalMap, i.uv).wy() * 2.0f - 1.0f;
        // your turn: the normal, with its bumps scaled
        xy *= bumpScale;
        i.normal = float3(xy, sqrt(1.0f - saturate(dot(xy, xy))));
        // end of your turn
        i.normal = i.normal.xzy();
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

Stage exercise_1_12a() {
    return {.title = "Steeper, but still a normal",
            .section = "",
            .news = "An exercise of stage 1.12.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

// 1.09a Slopes in both directions: the answer of an exercise. The lines between the marks are what the learner writes.
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
    sampler2D heightMap = heights("marble-heights.png");
    float4 heightMap_TexelSize = texelSize(heightMap);
    Float bumpScale = number("bumpScale", 5.0f, {-32, 32}, "texels that the height map's whole range is high");

    void InitializeFragmentNormal(Interpolators& i) const {
        const float2 du = float2(heightMap_TexelSize.x * 0.5f, 0);
        const Float u1 = tex2D(heightMap, i.uv - du).x;
        const Float u2 = tex2D(heightMap, i.uv + du).x;

        const float2 dv = float2(0, heightMap_TexelSize.y * 0.5f);
        const Float v1 = tex2D(heightMap, i.uv - dv).x;
        const Float v2 = tex2D(heightMap, i.uv + dv).x;

        // your turn: two tangents, and the normal that stands on both
        const float3 tu = float3(1, (u2 - u1) * bumpScale, 0);
        const float3 tv = float3(0, (v2 - v1) * bumpScale, 1);
        i.normal = cross(tv, tu);
        // end of your turn
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

Stage exercise_1_09a() {
    return {.title = "Slopes in both directions",
            .section = "",
            .news = "An exercise of stage 1.09.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

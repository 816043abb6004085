// 1.12 Bump scale: Rendering 6 "Bumpiness", section 2.3
// New: x and y are scaled before z is found; UnpackScaleNormal does it all.
// Was: the map as it is (1.11).
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
    Float bumpScale = number("bumpScale", 0.5f, {-32, 32}, "the bumps' strength; 1: as the map was made");  // new

    void InitializeFragmentNormal(Interpolators& i) const {
        i.normal = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);  // new
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

Stage bumpiness_12_bump_scale() {
    return {.title = "Bump scale",
            .section = "2.3",
            .news = "x and y scaled before z is found: the bumps of a finished map made flatter.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

// 1.03 Heights as normals: Rendering 6 "Bumpiness", section 1.2
// New: the height becomes the normal's y; normalising undoes it, and leaves nothing where the height is 0.
// Was: the height as a colour (1.02).
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

    void InitializeFragmentNormal(Interpolators& i) const {  // new
        const Float h = tex2D(heightMap, i.uv).x;            // new
        i.normal = float3(0, h, 0);                          // new
        i.normal = normalize(i.normal);
    }

    float4 operator()(Interpolators i) const {  // new
        InitializeFragmentNormal(i);            // new
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tex2D(mainTex, i.uv).xyz() * tint.xyz();
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, light);
    }
};

}  // namespace

Stage bumpiness_03_heights_as_normals() {
    return {.title = "Heights as normals",
            .section = "1.2",
            .news = "Wrong on purpose: (0, h, 0) normalised is (0, 1, 0) again, and black where h is 0.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

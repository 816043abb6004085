// 1.09 Both dimensions: Rendering 6 "Bumpiness", section 1.6
// New: both slopes together; (-fu, 1, -fv) is what the cross product of the two tangents gives.
// Was: the slope along v alone (1.08).
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
    bool crossProduct = toggle("crossProduct", false, "1: by cross product; the same bits");  // new

    void InitializeFragmentNormal(Interpolators& i) const {
        const float2 du = float2(heightMap_TexelSize.x * 0.5f, 0);  // new
        const Float u1 = tex2D(heightMap, i.uv - du).x;             // new
        const Float u2 = tex2D(heightMap, i.uv + du).x;             // new

        const float2 dv = float2(0, heightMap_TexelSize.y * 0.5f);
        const Float v1 = tex2D(heightMap, i.uv - dv).x;
        const Float v2 = tex2D(heightMap, i.uv + dv).x;

        if (crossProduct) {                                                      // new
            const float3 tu = float3(1, (u2 - u1) * bumpScale, 0);               // new
            const float3 tv = float3(0, (v2 - v1) * bumpScale, 1);               // new
            i.normal = cross(tv, tu);                                            // new
        } else {                                                                 // new
            i.normal = float3((u1 - u2) * bumpScale, 1, (v1 - v2) * bumpScale);  // new
        }
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

Stage bumpiness_09_both_dimensions() {
    return {.title = "Both dimensions",
            .section = "1.6",
            .news = "Both slopes at once: complete normals from a height map.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.9f, -0.75f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.lying()); }};
}

}  // namespace relief::samples

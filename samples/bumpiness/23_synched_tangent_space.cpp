// 1.23 Synched tangent space: Rendering 6 "Bumpiness", section 4.3
// New: a map baked from a detailed mesh, decoded with the tangents that it was baked with, and with others.
// Was: maps made of heights, which fit any surface (1.22).
#include "common/baked_sphere.h"
#include "common/stage.h"

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

struct MyVertexProgram : DetailedMaterial {  // new
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

struct MyFragmentProgram : DetailedMaterial {  // new
    bool renormalise = false;                  // new

    void InitializeFragmentNormal(Interpolators& i) const {
        const float3 mainNormal = UnpackScaleNormal(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = UnpackScaleNormal(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        const float3 tangentSpaceNormal = BlendNormals(mainNormal, detailNormal);

        float3 tangent = i.tangent.xyz();                    // new
        if (renormalise) Orthonormalise(i.normal, tangent);  // new
        const float3 binormal = cross(i.normal, tangent) * (i.tangent.w * object.unity_WorldTransformParams.w);
        i.normal = normalize(tangent * tangentSpaceNormal.x + binormal * tangentSpaceNormal.y +
                             i.normal * tangentSpaceNormal.z);
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

Stage bumpiness_23_synched_tangent_space() {
    return {.title = "Synched tangent space",
            .section = "4.3",
            .news = "A detailed sphere, and a coarse one with its map: synched, with other tangents, renormalised.",
            .uniforms = declared<MyFragmentProgram>(),
            .camera = {.position = {0.0f, 0.4f, -3.7f}},
            .draw = [](const Scene& s) {
                const BakedSphere& baked = bakedSphere();
                const MyVertexProgram vertex = s.uniforms();
                MyFragmentProgram fragment = s.uniforms();
                fragment.bumpScale = fragment.detailBumpScale = 1.0f;
                s.cutCell(0, 4);
                s.draw(baked.high, vertex, fragment);
                fragment.normalMap = s.samplerOf(baked.normalMap);
                s.cutCell(1, 4);
                s.draw(baked.low, vertex, fragment);
                s.cutCell(2, 4);
                s.draw(baked.otherTangents, vertex, fragment);
                fragment.renormalise = true;
                s.cutCell(3, 4);
                s.draw(baked.low, vertex, fragment);
                for (const std::string& line : baked.measured) s.note(line);
            }};
}

}  // namespace relief::samples

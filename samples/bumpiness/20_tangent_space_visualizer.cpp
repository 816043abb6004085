// 1.20 Tangent space visualizer: Rendering 6 "Bumpiness", section 4.1
// New: lines along the normal (green), the tangent (red) and the binormal (blue) of every vertex.
// Was: bumps that know nothing of the shape (1.19).
#include "common/stage.h"
#include "common/tangent_space_visualizer.h"

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

struct MyVertexProgram : DetailedMaterial {  // new
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

struct MyFragmentProgram : DetailedMaterial {  // new
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

struct Lines : Uniforms {                                                             // new
    float offset = number("offset", 0.01f, {0, 1}, "of the lines from the surface");  // new
    float scale = number("scale", 0.1f, {0, 2}, "the lines' length");                 // new
};

}  // namespace

Stage bumpiness_20_tangent_space_visualizer() {
    return {.title = "Tangent space visualizer",
            .section = "4.1",
            .news = "The directions that a mesh brings along: normals green, tangents red, binormals blue.",
            .uniforms = declared<MyFragmentProgram, Lines>(),
            .mesh = "cube+sphere",
            .camera = {.position = {0.0f, 0.8f, -2.5f}},
            .draw = [](const Scene& s) {
                const Lines lines = s.uniforms();
                for (const Object& o : s.objects) {
                    s.draw<MyVertexProgram, MyFragmentProgram>(o);
                    TangentSpaceVisualizer{lines.offset, lines.scale}.ShowTangentSpace(s, *o.mesh, o.worldFromObject);
                }
            }};
}

}  // namespace relief::samples

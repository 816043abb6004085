// 0.06 First light: the metallic workflow, and the lighting model of everything that follows
// New: light. A colour is split between diffuse and specular, and the GGX model says how much of each is seen.
// Was: colours alone (0.05).
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> worldPos;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        return i;
    }
};

struct MyFragmentProgram : Uniforms {
    float4 tint = rgba("tint", {1.0f, 0.72f, 0.32f, 1.0f}, "the material's colour, linear");
    Float metallic = 0.0f;
    Float smoothness = number("smoothness", 1.0f, {0, 1}, "of the last column; the first has 0.1");
    bool exact = toggle("exact", false, "1: the model without Unity's epsilons");
    UnityLight light = sun(35.0f, -20.0f);

    float4 operator()(Interpolators i) const {
        i.normal = normalize(i.normal);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tint.xyz();
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        if (exact) return UNITY_BRDF_PBS_Exact(albedo, specularTint, smoothness, i.normal, viewDir, light);
        return UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, light);
    }
};

}  // namespace

Stage basics_06_first_light() {
    return {.title = "First light",
            .section = "parts 4 and 5",
            .news = "Metals (above) and dielectrics (below) under one light, from matte to polished.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.0f, -4.8f}},
            .draw = [](const Scene& s) {
                for (int column = 0; column < 5; ++column) {
                    for (int row = 0; row < 2; ++row) {
                        const float x = 1.1f * static_cast<float>(column - 2),
                                    y = 1.1f * static_cast<float>(row) - 0.55f;
                        const float part = static_cast<float>(column) / 4.0f;
                        const Uniforms uniforms = s.uniforms(translation({x, y, 0.0f}));
                        MyFragmentProgram fragment = uniforms;
                        fragment.metallic = static_cast<float>(row);
                        fragment.smoothness = 0.1f + (fragment.smoothness - 0.1f) * part;
                        s.draw(s.mesh, MyVertexProgram(uniforms), fragment);
                    }
                }
            }};
}

}  // namespace relief::samples

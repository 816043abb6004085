// 0.06a Diffuse light and a highlight: the answer of an exercise. The lines between the marks are what the learner
// writes.
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
    Float shininess = number("shininess", 40.0f, {1, 1000}, "exponent of the highlight: larger is smaller");
    UnityLight light = sun(35.0f, -60.0f);

    float4 operator()(Interpolators i) const {
        i.normal = normalize(i.normal);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);
        // your turn: two kinds of light
        const Float diffuse = saturate(dot(i.normal, light.dir));
        const float3 halfVector = normalize(light.dir + viewDir);
        const Float highlight = pow(saturate(dot(i.normal, halfVector)), shininess);
        // end of your turn
        return float4(light.color * (tint.xyz() * diffuse + 0.5f * highlight), 1);
    }
};

}  // namespace

Stage exercise_0_06a() {
    return {.title = "Diffuse light and a highlight",
            .section = "",
            .news = "An exercise of stage 0.06.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.3f, -1.8f}},
            .draw = [](const Scene& s) {
                for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            }};
}

}  // namespace relief::samples

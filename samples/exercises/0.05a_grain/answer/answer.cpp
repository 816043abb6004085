// 0.05a A grain for the marble: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main texture in xy, detail texture in zw
};

struct MyVertexProgram : Uniforms {
    float4 mainTex_ST = vector("mainTex_ST", {1, 1, 0, 0}, {-16, 16}, "tiling in x and y, offset in z and w");
    float4 detailTex_ST = vector("detailTex_ST", {10, 10, 0, 0}, {-64, 64}, "the same for the detail texture");

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

struct MyFragmentProgram : Uniforms {
    float4 tint = rgba("tint", glm::vec4(1.0f), "colour that the texture is multiplied by");
    sampler2D mainTex = albedo("marble-albedo.png");
    sampler2D detailTex = detail("marble-detail.png");

    float4 operator()(Interpolators i) const {
        // your turn: the main texture, and the grain over it
        float4 color = tex2D(mainTex, i.uv.xy()) * tint;
        color *= tex2D(detailTex, i.uv.zw()) * unity_ColorSpaceDouble;
        // end of your turn
        return color;
    }
};

}  // namespace

Stage exercise_0_05a() {
    return {.title = "A grain for the marble",
            .section = "",
            .news = "An exercise of stage 0.05.",
            .uniforms = declared<MyFragmentProgram, MyVertexProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.0f, -1.2f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.objects[0]); }};
}

}  // namespace relief::samples

// 0.04a Tiling and offset: the answer of an exercise. The lines between the marks are what the learner writes.
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
    float4 mainTex_ST = vector("mainTex_ST", {2, 3, 0.25f, 0.1f}, {-16, 16}, "tiling in x and y, offset in z and w");
    float4 detailTex_ST = vector("detailTex_ST", {8, 8, 0, 0}, {-64, 64}, "the same for the detail texture");

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        // your turn: uv of the main texture
        const float2 uv = v.uv * mainTex_ST.xy() + mainTex_ST.zw();
        // end of your turn
        i.uv = float4(uv, v.uv * detailTex_ST.xy() + detailTex_ST.zw());
        return i;
    }
};

struct MyFragmentProgram : Uniforms {
    float4 tint = rgba("tint", glm::vec4(1.0f), "colour that the texture is multiplied by");
    sampler2D mainTex = albedo("marble-albedo.png");
    sampler2D detailTex = detail("marble-detail.png");

    float4 operator()(Interpolators i) const {
        float4 color = tex2D(mainTex, i.uv.xy()) * tint;
        color *= tex2D(detailTex, i.uv.zw()) * unity_ColorSpaceDouble;
        return color;
    }
};

}  // namespace

Stage exercise_0_04a() {
    return {.title = "Tiling and offset",
            .section = "",
            .news = "An exercise of stage 0.04.",
            .uniforms = declared<MyFragmentProgram, MyVertexProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.0f, -1.2f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.objects[0]); }};
}

}  // namespace relief::samples

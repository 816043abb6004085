// 0.02a Perspective by hand: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    noperspective<TEXCOORD<1, float3>> linear;  // interpolated as if the screen were the surface
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        const float4 clip = UnityObjectToClipPos(object, v.position);
        i.position = clip;
        i.uv = v.uv;
        // your turn: what the vertex hands over
        i.linear = float3(v.uv / clip.w, 1.0f / clip.w);
        // end of your turn
        return i;
    }
};

struct MyFragmentProgram : Uniforms {
    Float squares = number("squares", 8.0f, {1, 64}, "squares of the board along a side");
    bool byHand = false;

    float4 operator()(Interpolators i) const {
        const float3 linear = i.linear;
        float2 uv = i.uv;
        if (byHand) {
            // your turn: uv at this pixel
            uv = linear.xy() / linear.z;
            // end of your turn
        }

        // A chessboard: the parity of the square's column and row.
        const float2 square = floor(uv * squares);
        const Float dark = frac((square.x + square.y) * 0.5f) * 2.0f;
        return float4(lerp(float3(uv.x, uv.y, 0.6f), float3(0.05f), dark), 1);
    }
};

struct Quads : Uniforms {
    float lean = number("lean", 60.0f, {0, 89}, "how far the quads lean back, degrees");
};

}  // namespace

Stage exercise_0_02a() {
    return {.title = "Perspective by hand",
            .section = "",
            .news = "An exercise of stage 0.02.",
            .uniforms = declared<MyFragmentProgram, Quads>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.35f, -2.1f}, .target = {0.0f, -0.03f, 0.0f}},
            .draw = [](const Scene& s) {
                const glm::mat4 lean = rotationX(Quads(s.uniforms()).lean);
                const auto draw = [&](float x, bool byHand) {
                    const Uniforms uniforms = s.uniforms(translation({x, 0, 0}) * lean);
                    MyFragmentProgram fragment = uniforms;
                    fragment.byHand = byHand;
                    s.draw(s.mesh, MyVertexProgram(uniforms), fragment);
                };
                draw(-0.56f, false);
                draw(0.56f, true);
                s.labelColumns({"the rasterizer", "by hand"});
            }};
}

}  // namespace relief::samples

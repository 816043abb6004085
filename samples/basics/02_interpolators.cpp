// 0.02 Interpolators: perspective-correct beside affine
// New: uv coordinates go from the vertices to the pixels, on a quad that leans away from the viewer.
// Was: colours, on a triangle that faces the viewer (0.01).
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
    noperspective<TEXCOORD<1, float2>> affineUV;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = v.uv;
        i.affineUV = v.uv;
        return i;
    }
};

struct MyFragmentProgram : Uniforms {
    Float squares = number("squares", 8.0f, {1, 64}, "squares of the board along a side");
    bool affine = false;

    float4 operator()(Interpolators i) const {
        const float2 uv = affine ? float2(i.affineUV) : float2(i.uv);

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

Stage basics_02_interpolators() {
    return {.title = "Interpolators",
            .section = "part 2",
            .news =
                "Left: perspective-correct. Right: affine, as if the screen were the surface; it breaks along the "
                "diagonal.",
            .uniforms = declared<MyFragmentProgram, Quads>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.35f, -2.1f}, .target = {0.0f, -0.03f, 0.0f}},
            .draw = [](const Scene& s) {
                const glm::mat4 lean = rotationX(Quads(s.uniforms()).lean);
                const auto draw = [&](float x, bool affine) {
                    const Uniforms uniforms = s.uniforms(translation({x, 0, 0}) * lean);
                    MyFragmentProgram fragment = uniforms;
                    fragment.affine = affine;
                    s.draw(s.mesh, MyVertexProgram(uniforms), fragment);
                };
                draw(-0.56f, false);
                draw(0.56f, true);
            }};
}

}  // namespace relief::samples

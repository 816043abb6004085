// 0.01 Triangle: the ground that the tutorials stand on
// New: three vertices, three colours, and everything between them.
// Was: nothing.
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float3> color;
};

struct MyVertexProgram {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = v.position;
        i.color = v.normal;
        return i;
    }
};

struct MyFragmentProgram : Uniforms {
    float4 tint = rgba("tint", glm::vec4(1.0f), "colour that everything is multiplied by");

    float4 operator()(Interpolators i) const { return float4(i.color * tint.xyz(), 1); }
};

// Positions are in clip space already; the normals carry the three colours.
const Mesh& triangle() {
    static const Mesh mesh = {.name = "triangle",
                              .positions = {{-0.5f, -0.75f, 0.5f}, {0.0f, 0.75f, 0.5f}, {0.5f, -0.75f, 0.5f}},
                              .normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                              .uvs = {},
                              .tangents = {},
                              .indices = {0, 1, 2}};
    return mesh;
}

}  // namespace

Stage basics_01_triangle() {
    return {.title = "Triangle",
            .section = "part 1",
            .news = "Three vertices, three colours: the smallest picture there is.",
            .uniforms = declared<MyFragmentProgram>(),
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>({&triangle()}); }};
}

}  // namespace relief::samples

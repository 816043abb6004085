// 0.03a Depth in metres: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
};

struct Interpolators {
    SV_POSITION position;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        return i;
    }
};

struct ShowColor {
    float3 color;

    float4 operator()(Interpolators) const { return float4(color, 1); }
};

// What the depth buffer holds, z / w: 0 at the near plane, 1 at the far plane, and most of the way near 1.
struct ShowDepth {
    float4 operator()(Interpolators i) const { return float4(float3(i.position.z), 1); }
};

// The distance along the view, black at the near plane and white at the far plane.
struct ShowDistance {
    float4 operator()(Interpolators i) const {
        const Float n = 1.0f, f = 3.0f;  // distances of the near and the far plane
        const Float z = i.position.z;    // what the depth buffer holds
        // your turn: the distance, and 0 at the near plane to 1 at the far plane
        const Float distance = n * f / (f - z * (f - n));
        const Float shown = (distance - n) / (f - n);
        // end of your turn
        return float4(float3(shown), 1);
    }
};

constexpr RenderState kBothSides = {.cull = Cull::none};

struct Quads : Uniforms {
    float turn = number("turn", 50.0f, {0, 90}, "how far one quad is turned about Y, degrees");
    float lean = number("lean", 50.0f, {0, 90}, "how far the other one leans back, degrees");
};

}  // namespace

Stage exercise_0_03a() {
    return {.title = "Depth in metres",
            .section = "",
            .news = "An exercise of stage 0.03.",
            .uniforms = declared<Quads>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.25f, -1.55f}, .nearPlane = 1.0f, .farPlane = 3.0f},
            .draw = [](const Scene& s) {
                const Quads quads = s.uniforms();
                const glm::mat4 turned[] = {rotationY(quads.turn), rotationX(quads.lean)};
                const float3 colors[] = {{0.9f, 0.45f, 0.1f}, {0.1f, 0.35f, 0.8f}};
                for (int k = 0; k < 2; ++k) {
                    for (int view = 0; view < 3; ++view) {
                        // One camera for all three views, each in its third of the picture.
                        s.cutCell(view, 3);
                        const MyVertexProgram vertex = s.uniforms(turned[k] * scaling(glm::vec3(0.54f)));
                        if (view == 0) s.draw(s.mesh, vertex, ShowColor{colors[k]}, kBothSides);
                        if (view == 1) s.draw(s.mesh, vertex, ShowDepth{}, kBothSides);
                        if (view == 2) s.draw(s.mesh, vertex, ShowDistance{}, kBothSides);
                    }
                }
                s.labelColumns({"colour", "depth: 0 black, 1 white", "distance: near black, far white"});
            }};
}

}  // namespace relief::samples

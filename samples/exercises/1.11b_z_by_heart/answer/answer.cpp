// 1.11b The third component: the answer of an exercise. The lines between the marks are what the learner writes.
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> worldPos;
};

struct MyVertexProgram : LitMaterial {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.uv = TRANSFORM_TEX(v.uv, mainTex_ST);
        return i;
    }
};

struct MyFragmentProgram : LitMaterial {
    float4 operator()(Interpolators i) const {
        // your turn: z of the normal, 0 to 1
        const Float z = 0.8f;
        // end of your turn

        // Above: yours and the right one. Below: by how much they differ, enlarged.
        const Float x = 0.6f, y = 0.0f;
        const float3 right = float3(sqrt(1.0f - x * x - y * y));
        const float3 yours = float3(z);
        const float3 shown = select(i.uv.x < 0.5f, yours, right);
        return float4(select(i.uv.y < 0.25f, saturate(abs(yours - right) * 64.0f), shown), 1);
    }
};

}  // namespace

Stage exercise_1_11b() {
    return {.title = "The third component",
            .section = "",
            .news = "An exercise of stage 1.11.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.0f, -1.2f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.objects[0]); }};
}

}  // namespace relief::samples

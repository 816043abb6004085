// 1.10a The code of a flat normal: the answer of an exercise. The lines between the marks are what the learner writes.
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
        // your turn: the codes of red, green and blue, 0 to 255
        const float3 codes = float3(128, 128, 255);
        // end of your turn

        // Above: your colour and the right one. Below: by how much they differ, 64 times enlarged.
        const float3 flat = float3(0, 0, 1);
        const float3 right = floor((flat * 0.5f + 0.5f) * 255.0f + 0.5f) / 255.0f;
        const float3 shown = select(i.uv.x < 0.5f, codes / 255.0f, right);
        return float4(select(i.uv.y < 0.25f, saturate(abs(codes / 255.0f - right) * 64.0f), shown), 1);
    }
};

}  // namespace

Stage exercise_1_10a() {
    return {.title = "The code of a flat normal",
            .section = "",
            .news = "An exercise of stage 1.10.",
            .uniforms = declared<MyFragmentProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.0f, -1.2f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.objects[0]); }};
}

}  // namespace relief::samples

// 0.05 Combining textures: a detail texture over the main one
// New: a second texture, tiled more finely, multiplies the first; both uv travel in one TEXCOORD.
// Was: one texture (0.04).
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main texture in xy, detail texture in zw  // new
};

struct MyVertexProgram : Uniforms {
    float4 mainTex_ST = vector("mainTex_ST", {1, 1, 0, 0}, {-16, 16}, "tiling in x and y, offset in z and w");   // new
    float4 detailTex_ST = vector("detailTex_ST", {10, 10, 0, 0}, {-64, 64}, "the same for the detail texture");  // new

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));  // new
        return i;
    }
};

struct MyFragmentProgram : Uniforms {                                                         // new
    float4 tint = rgba("tint", glm::vec4(1.0f), "colour that the texture is multiplied by");  // new
    sampler2D mainTex = albedo("marble-albedo.png");                                          // new
    sampler2D detailTex = detail("marble-detail.png");                                        // new

    float4 operator()(Interpolators i) const {
        float4 color = tex2D(mainTex, i.uv.xy()) * tint;                // new
        color *= tex2D(detailTex, i.uv.zw()) * unity_ColorSpaceDouble;  // new
        return color;                                                   // new
    }
};

}  // namespace

Stage basics_05_combining_textures() {
    return {.title = "Combining textures",
            .section = "part 3",
            .news = "A detail texture, tiled ten times as fine, gives the marble its grain.",
            .uniforms = declared<MyFragmentProgram, MyVertexProgram>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.0f, -1.2f}},
            .draw = [](const Scene& s) { s.draw<MyVertexProgram, MyFragmentProgram>(s.objects[0]); }};
}

}  // namespace relief::samples

// 0.05 Combining textures: a detail texture over the main one
// New: a second texture, tiled more finely, multiplies the first; both uv travel in one TEXCOORD.
// Was: one texture (0.04).
#include "common/stage.h"

namespace relief::samples {

namespace {

struct VertexData
{
    POSITION position;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // main texture in xy, detail texture in zw
};

struct MyVertexProgram
{
    ObjectTransform object;
    float4 mainTex_ST, detailTex_ST;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

struct MyFragmentProgram
{
    float4 tint;
    sampler2D mainTex, detailTex;

    float4 operator()(Interpolators i) const
    {
        float4 color = tex2D(mainTex, i.uv.xy()) * tint;
        color *= tex2D(detailTex, i.uv.zw()) * unity_ColorSpaceDouble;
        return color;
    }
};

}  // namespace

Stage basics_05_combining_textures()
{
    return {
        .title = "Combining textures",
        .section = "part 3",
        .news = "A detail texture, tiled ten times as fine, gives the marble its grain.",
        .properties = {{"tint", glm::vec4(1.0f), 0.0f, 1.0f, 4, "colour that the texture is multiplied by"},
                       {"mainTex_ST", {1, 1, 0, 0}, -16.0f, 16.0f, 4, "tiling in x and y, offset in z and w"},
                       {"detailTex_ST", {10, 10, 0, 0}, -64.0f, 64.0f, 4, "the same for the detail texture"}},
        .inputs =
            {.mesh = "quad", .albedo = "marble-albedo.png", .height = "", .normal = "", .detail = "marble-detail.png"},
        .camera = {.position = {0.0f, 0.0f, -1.2f}},
        .draw = [](const Scene& s) {
            s.draw(s.mesh, MyVertexProgram{s.object(glm::mat4(1.0f)), s.vector("mainTex_ST"), s.vector("detailTex_ST")},
                   MyFragmentProgram{s.vector("tint"), s.mainTex, s.detailTex});
        }};
}

}  // namespace relief::samples

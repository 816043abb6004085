// 5.01 Smooth edges: D3D 11.3 3.5.4 and 19.2.4
// New: several samples a pixel, beside the truth of 64. Each picture is small, and enlarged without a filter.
// Was: one sample a pixel (4.13).
#include "common/screen_quad.h"
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = v.uv;
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        return i;
    }
};

template <bool COVERAGE>
struct MyFragmentProgram : StoneMaterial {
    Float smoothness = number("smoothness", 0.75f, {0, 1}, "0 matte, 1 polished");

    float4 operator()(Interpolators i) const {
        if constexpr (COVERAGE) return float4(1.0f);
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        const float3 normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
        float3 specular;
        Float oneMinusReflectivity;
        const float3 diffuse = DiffuseAndSpecularFromMetallic(tint.rgb(), 0.0f, specular, oneMinusReflectivity);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);
        return UNITY_BRDF_PBS(diffuse, specular, smoothness, normal, viewDir, light) + float4(tint.rgb() * ambient, 0);
    }
};

constexpr int kEnlarged = 10;  // pixels of the picture for each small one

// One column: a small picture with so many samples, or with 8 x 8 times as many pixels and their mean.
template <bool COVERAGE>
void DrawCell(const Scene& s, int column, int samples) {
    const bool isTruth = samples == 64;
    const int finer = isTruth ? 8 : 1;
    const int width = std::max(s.width / 4 / kEnlarged, 1), height = std::max(s.height / 2 / kEnlarged, 1);
    const Camera camera = {.position = {0.0f, 0.3f, -1.9f}};
    const glm::mat4 clipFromWorld =
        clipFromView(camera, static_cast<float>(width) / static_cast<float>(height)) * viewFromWorld(camera);
    const Framebuffer& drawn = s.pass(
        *Framebuffer::create(width * finer, height * finer, Format::rgba32f, Store::discard, isTruth ? 1 : samples),
        clipFromWorld, [](const Scene& p) {
            for (const Object& o : p.objects) p.draw<MyVertexProgram, MyFragmentProgram<COVERAGE>>(o);
        });
    sampler2D picture = s.sampled(drawn, drawn.colorIndex());
    picture.filter = Filter::nearest;
    picture.mipmaps = true;
    picture.minLod = picture.maxLod = isTruth ? 3.0f : 0.0f;  // 8 x 8 pixels are one texel of level 3
    s.cutCell(column, 4, COVERAGE ? 1 : 0, 2);
    s.draw(primitive("quad"), ScreenVertexProgram{0.25f, 0.5f}, ShowPicture{picture}, kOverThePicture);
}

}  // namespace

Stage beyond_01_smooth_edges() {
    return {.title = "Smooth edges",
            .section = "D3D 11.3 3.5.4",
            .news = "One sample a pixel, four, eight, and the truth of 64; below, how much of each pixel is covered.",
            .uniforms = declared<MyFragmentProgram<false>>(),
            .mesh = "sphere",
            .draw = [](const Scene& s) {
                const int samples[] = {1, 4, 8, 64};
                for (int column = 0; column < 4; ++column) {
                    DrawCell<false>(s, column, samples[column]);
                    DrawCell<true>(s, column, samples[column]);
                }
                s.labelColumns({"1 sample", "4 samples", "8 samples", "64: the truth"}, 0, 2);
                s.labelColumns({"covered", "covered", "covered", "covered"}, 1, 2);
            }};
}

}  // namespace relief::samples

// 5.18 Cutout and transparency: Rendering 11; D3D 11.3 17.17
// New: alpha. Pixels are thrown away, or some of their samples, or blended; and then the order counts.
// Was: surfaces that hide all that is behind them (5.15).
#include "common/screen_quad.h"
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
    SV_IsFrontFace isFront;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = v.uv;
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        return i;
    }
};

// A sheet of marble with holes where it is low.
struct Sheet : Uniforms {
    sampler2D heightMap = heights("marble-heights.png");
    Float cutoff = number("cutoff", 0.5f, {0, 1}, "alpha below this is thrown away");
    Float sharpness = number("sharpness", 12.0f, {1, 64}, "how steeply alpha rises at the rim of a hole");
    Float opacity = number("opacity", 0.7f, {0, 1}, "of the sheets that fade");
    UnityLight light = sun(40.0f, -30.0f);
    float3 color = float3(1.0f);

    Float AlphaOf(const Interpolators& i) const {
        return saturate((tex2D(heightMap, i.uv).x - 0.55f) * sharpness + 0.5f);
    }
    float3 ColorOf(const Interpolators& i) const {
        const float3 normal = normalize(i.normal) * select(i.isFront, Float(1.0f), Float(-1.0f));
        return color * (light.color * saturate(dot(normal, light.dir)) + 0.15f);
    }
};

struct AlphaTest : Sheet {
    float4 operator()(Interpolators i, Discard& discard) const {
        discard(AlphaOf(i) < cutoff);
        return float4(ColorOf(i), 1);
    }
};

struct AlphaToCoverage : Sheet {
    float4 operator()(Interpolators i) const { return float4(ColorOf(i), AlphaOf(i)); }
};

struct Fade : Sheet {
    float4 operator()(Interpolators i) const { return float4(ColorOf(i), AlphaOf(i) * opacity); }
};

constexpr RenderState kTest = {.cull = Cull::none};
constexpr RenderState kCoverage = {.cull = Cull::none, .alphaToCoverage = true};
constexpr RenderState kBlend = {.depthWrite = false, .cull = Cull::none, .blend = Blend::alpha};

// Three sheets behind each other, the nearest one first or last.
template <class FragmentProgram>
void DrawSheets(const Scene& s, bool nearestFirst, const RenderState& state) {
    const float3 colors[] = {{0.9f, 0.35f, 0.15f}, {0.85f, 0.8f, 0.7f}, {0.15f, 0.4f, 0.8f}};
    for (int k = 0; k < 3; ++k) {
        const int sheet = nearestFirst ? k : 2 - k;
        const auto place = static_cast<float>(sheet);
        const glm::mat4 worldFromObject =
            translation({0.12f * place - 0.12f, 0.1f * place - 0.1f, 0.45f * place - 0.45f}) * rotationY(20.0f);
        FragmentProgram fragment = s.uniforms(worldFromObject);
        fragment.color = colors[sheet];
        s.draw(s.mesh, MyVertexProgram(s.uniforms(worldFromObject)), fragment, state);
    }
}

}  // namespace

Stage beyond_18_cutout_and_transparency() {
    return {
        .title = "Cutout and transparency",
        .section = "Rendering 11",
        .news = "Alpha test, alpha to coverage on 8 samples, and blending from back to front; the other way is wrong.",
        .uniforms = declared<Sheet>(),
        .mesh = "quad",
        .camera = {.position = {-0.4f, 0.3f, -3.4f}},
        .draw = [](const Scene& s) {
            s.cutCell(0, 4);
            DrawSheets<AlphaTest>(s, true, kTest);
            const Framebuffer& smooth =
                s.pass(*Framebuffer::create(s.width, s.height, Format::rgba32f, Store::discard, 8),
                       [](const Scene& p) { DrawSheets<AlphaToCoverage>(p, true, kCoverage); });
            s.cutCell(1, 4);
            s.draw(primitive("quad"), ScreenVertexProgram{}, ShowPicture{s.sampled(smooth, smooth.colorIndex())},
                   kOverThePicture);
            s.cutCell(2, 4);
            DrawSheets<Fade>(s, false, kBlend);
            s.cutCell(3, 4);
            DrawSheets<Fade>(s, true, kBlend);
            s.labelColumns({"alpha test", "alpha to coverage", "blended", "wrong: nearest first"});
        }};
}

}  // namespace relief::samples

// 0.04 Texture: five ways to look a picture up
// New: a texture on a plane that runs to the horizon, filtered in four ways, and the mip level as a colour.
// Was: a pattern computed in the fragment program (0.02).
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
};

struct MyVertexProgram : Uniforms {
    float4 mainTex_ST = vector("mainTex_ST", {24, 24, 0, 0}, {-256, 256}, "tiling in x and y, offset in z and w");

    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = TRANSFORM_TEX(v.uv, mainTex_ST);
        return i;
    }
};

struct MyFragmentProgram {
    sampler2D mainTex;

    float4 operator()(Interpolators i) const { return tex2D(mainTex, i.uv); }
};

// A colour for every mip level, blended as trilinear filtering blends: red 0, yellow 1, green 2, cyan 3, blue from 4
// on.
struct ShowMipLevel {
    sampler2D mainTex;

    float4 operator()(Interpolators i) const {
        const Float level = calculateLevelOfDetail(mainTex, i.uv);
        return float4(saturate(2.0f - level), saturate(level) - saturate(level - 3.0f), saturate(level - 2.0f), 1);
    }
};

struct Textures : Uniforms {
    sampler2D mainTex = albedo("marble-albedo.png");
    float maxAnisotropy = number("maxAnisotropy", 16.0f, {1, 16}, "samples along the longer axis, at most");
};

}  // namespace

Stage basics_04_texture() {
    return {.title = "Texture",
            .section = "part 3",
            .news = "From left to right: nearest, bilinear, trilinear, anisotropic 16x, and the mip level as a colour.",
            .uniforms = declared<MyVertexProgram, Textures>(),
            .mesh = "quad",
            .camera = {.position = {0.0f, 0.35f, -5.0f},
                       .target = {0.0f, -0.15f, -3.0f},
                       .nearPlane = 0.1f,
                       .farPlane = 1000.0f},
            .draw = [](const Scene& s) {
                const MyVertexProgram vertex = s.uniforms(rotationX(90.0f) * scaling(glm::vec3(60.0f)));
                const Textures textures = s.uniforms();
                sampler2D mainTex = textures.mainTex;
                const auto strip = [&](int k, auto program) {
                    s.cutStrip(static_cast<float>(k) / 5, static_cast<float>(k + 1) / 5);
                    s.draw(s.mesh, vertex, program);
                };
                strip(4, ShowMipLevel{mainTex});
                strip(2, MyFragmentProgram{mainTex});
                mainTex.maxAnisotropy = static_cast<int>(textures.maxAnisotropy);
                strip(3, MyFragmentProgram{mainTex});
                mainTex.maxAnisotropy = 1;
                mainTex.mipmaps = false;
                mainTex.filter = Filter::bilinear;
                strip(1, MyFragmentProgram{mainTex});
                mainTex.filter = Filter::nearest;
                strip(0, MyFragmentProgram{mainTex});
            }};
}

}  // namespace relief::samples

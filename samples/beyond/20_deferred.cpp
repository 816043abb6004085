// 5.20 Deferred: Saito and Takahashi 1990; Rendering 13 and 15; Cigolle et al. 2014
// New: several targets in one draw. The first pass writes down what is seen; the second lights it, pixel by pixel.
// Was: each draw is lit while it is drawn (5.19).
#include "common/false_color.h"
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
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.uv = v.uv;
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        return i;
    }
};

// The sphere of directions as a square: its lower half folded outwards. 0 ... 1.
float2 OctahedralOf(const float3& n) {
    const float3 p = n / (abs(n.x) + abs(n.y) + abs(n.z));
    const float2 folded = {(1.0f - abs(p.y)) * signNotZero(p.x), (1.0f - abs(p.x)) * signNotZero(p.y)};
    return select(p.z < 0.0f, folded, p.xy()) * 0.5f + 0.5f;
}
float3 FromOctahedral(const float2& square) {
    const float2 p = square * 2.0f - 1.0f;
    const Float z = 1.0f - abs(p.x) - abs(p.y);
    const float2 folded = {(1.0f - abs(p.y)) * signNotZero(p.x), (1.0f - abs(p.x)) * signNotZero(p.y)};
    return normalize(float3(select(z < 0.0f, folded, p), z));
}

// Two numbers of 12 bits in three of 8.
float3 PackedTwelve(const float2& v) {
    const float2 code = floor(saturate(v) * 4095.0f + 0.5f);
    const Float high = floor(code.x / 16.0f), low = floor(code.y / 256.0f);
    return float3(high, (code.x - high * 16.0f) * 16.0f + low, code.y - low * 256.0f) / 255.0f;
}
float2 UnpackedTwelve(const float3& bytes) {
    const float3 code = floor(bytes * 255.0f + 0.5f);
    const Float low = floor(code.y / 16.0f);
    return float2(code.x * 16.0f + low, (code.y - low * 16.0f) * 256.0f + code.z) / 4095.0f;
}

struct GBuffer {
    SV_Target<0> albedo;
    SV_Target<1> xyz;     // 3 x 8 bits, and in alpha nothing
    SV_Target<2> square;  // octahedral: 2 x 8 bits in red and green
    SV_Target<3> packed;  // octahedral: 2 x 12 bits in red, green and blue
};

struct Bumpy : DetailedMarble {
    float3 NormalOf(const Interpolators& i) const {
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        return TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
    }
};

struct WriteGBuffer : Bumpy {
    GBuffer operator()(Interpolators i) const {
        const float3 normal = NormalOf(i);
        const float2 square = OctahedralOf(normal);
        return {tex2D(mainTex, i.uv), float4(normal * 0.5f + 0.5f, 1), float4(square, 0, 1),
                float4(PackedTwelve(square), 1)};
    }
};

// The truth to measure by: the same draw, with the normal as floats.
struct WriteNormal : Bumpy {
    float4 operator()(Interpolators i) const { return float4(NormalOf(i), 1); }
};

template <int ENCODING, bool SHOW_ERROR>
struct LightPixels : DetailedMarble {
    sampler2D depth = {}, albedo = {}, normals = {}, truth = {};

    float4 operator()(ScreenInterpolators i, Discard& discard) const {
        discard(tex2D(depth, i.uv).x == 1.0f);  // nothing was drawn there
        if (discard.all()) return 0.0f;         // nor on any pixel of this block: leave out the rest
        const float4 code = tex2D(normals, i.uv);
        const float3 normal = ENCODING == 0   ? normalize(code.xyz() * 2.0f - 1.0f)
                              : ENCODING == 1 ? FromOctahedral(code.xy())
                                              : FromOctahedral(UnpackedTwelve(code.xyz()));
        if constexpr (SHOW_ERROR) return float4(falseColor(degreesBetween(normal, tex2D(truth, i.uv).xyz())), 1);
        const float3 color = tex2D(albedo, i.uv).rgb() * (light.color * saturate(dot(normal, light.dir)) + 0.05f);
        return float4(color, 1);
    }
};

template <int ENCODING>
void DrawColumn(const Scene& s, const Framebuffer& seen, const Framebuffer& truth) {
    const auto sampler = [&s](const Framebuffer& target, int attachment) {
        sampler2D nearest = s.sampled(target, attachment);
        nearest.filter = Filter::nearest;
        return nearest;
    };
    const auto draw = [&](auto program) {
        program.depth = sampler(seen, seen.depthIndex());
        program.albedo = sampler(seen, seen.colorIndex(0));
        program.normals = sampler(seen, seen.colorIndex(1 + ENCODING));
        program.truth = sampler(truth, truth.colorIndex());
        s.draw(primitive("quad"), ScreenVertexProgram{}, program);
    };
    s.cutCell(ENCODING, 3, 0, 2);
    draw(LightPixels<ENCODING, false>(s.uniforms()));
    s.cutCell(ENCODING, 3, 1, 2);
    draw(LightPixels<ENCODING, true>(s.uniforms()));
}

}  // namespace

Stage beyond_20_deferred() {
    return {.title = "Deferred",
            .section = "Saito and Takahashi 1990; Rendering 13 and 15",
            .news = "Four targets in one draw, lit afterwards; normals in three encodings, and how far each is off.",
            .uniforms = declared<LightPixels<0, false>>(),
            .mesh = "sphere",
            .camera = {.position = {0.0f, 0.5f, -3.1f}},
            .draw = [](const Scene& s) {
                const Attachment depth = {Format::depth32f}, bytes = {Format::rgba8};
                const Framebuffer& seen =
                    s.pass(*Framebuffer::create(s.width, s.height, {{Format::rgba8Srgb}, bytes, bytes, bytes, depth}),
                           [](const Scene& p) { p.draw<MyVertexProgram, WriteGBuffer>(p.objects[0]); });
                const Framebuffer& truth =
                    s.pass(*Framebuffer::create(s.width, s.height, {{Format::rgba32f}, depth}),
                           [](const Scene& p) { p.draw<MyVertexProgram, WriteNormal>(p.objects[0]); });
                DrawColumn<0>(s, seen, truth);
                DrawColumn<1>(s, seen, truth);
                DrawColumn<2>(s, seen, truth);
                s.labelColumns({"xyz, 3 x 8 bits", "octahedral, 2 x 8", "octahedral, 2 x 12"}, 0, 2);
                s.labelColumns({"error, red: 1 degree", "error, red: 1 degree", "error, red: 1 degree"}, 1, 2);
            }};
}

}  // namespace relief::samples

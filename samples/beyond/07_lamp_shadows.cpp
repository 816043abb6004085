// 5.07 Lamp shadows: Gerasimov 2004; Rendering 7
// New: a lamp among the shapes sees to all sides. Six depths, one for each face of a cube around it.
// Was: a sun, whose shadow map is one picture (5.06).
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

struct DepthInterpolators {
    SV_POSITION position;
};

// From the light only where a surface is counts.
struct DepthVertexProgram : Uniforms {
    DepthInterpolators operator()(VertexData v) const { return {UnityObjectToClipPos(object, v.position)}; }
};
struct NoColor {
    float4 operator()(DepthInterpolators) const { return float4(0.0f); }
};

struct Lamp : StoneMaterial {
    float3 lampPosition = vector("lampPosition", {0.05f, 0.75f, -0.3f}, {-4, 4}, "of the lamp");
    Float range = number("range", 5.0f, {0.5f, 20}, "how far the lamp shines");
    Float strength = number("strength", 2.0f, {0, 16}, "of the lamp's light");
    Float mapSize = number("mapSize", 256.0f, {16, 1024}, "side of each of the six pictures, texels");
    Float slopeBias = number("slopeBias", 1.5f, {0, 16}, "of what depth changes by from a texel to the next");
    Float normalOffset = number("normalOffset", 0.015f, {0, 0.5f}, "how far a point is moved off its surface");
    float3 lampColor = rgb("lampColor", {1.0f, 0.72f, 0.42f}, "of the lamp's light");

    static constexpr float kNear = 0.04f;
    glm::mat4 ClipFromView() const { return perspective(90.0f, 1.0f, kNear, range[0]); }
};

template <bool SHADOWS>
struct MyFragmentProgram : Lamp {
    float4x4 clipFromView = {};
    SamplerCubeComparisonState shadowMap = {};

    // The share of light that arrives. Depth is measured along the axis of the face that the direction passes through:
    // how far along is the direction's longest component.
    Float Shadow(const float3& worldPos) const {
        const float3 direction = worldPos - lampPosition, length = abs(direction);
        const Float along = max(max(length.x, length.y), length.z);
        const float4 p = mul(clipFromView, float4(0, 0, along, 1));
        return SampleCmp(shadowMap, direction, p.z / p.w);
    }

    float4 operator()(Interpolators i) const {
        float3 normal = normalize(i.normal);
        const Float shadow = SHADOWS ? Shadow(i.worldPos + normal * normalOffset) : Float(1.0f);
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
        const UnityLight lamp = CreateLight(PointLight{lampColor * strength, lampPosition, range}, i.worldPos);
        const Float diffuse = saturate(dot(normal, lamp.dir)) * shadow;
        return float4(tint.rgb() * (lamp.color * diffuse + ambient), 1);
    }
};

// The lamp itself, which has no shadow.
struct Glow : Lamp {
    float4 operator()(DepthInterpolators) const { return float4(saturate(lampColor * strength), 1); }
};

// White where the lamp is, black from two units on.
struct ShowDistance : Lamp {
    sampler2D depth = {};

    float4 operator()(ScreenInterpolators i) const {
        const Float z = tex2D(depth, i.uv).x;
        const Float along = kNear * range / (range - z * (range - kNear));
        const Float near = 1.0f - saturate(along * 0.5f);
        return float4(float3(near * near), 1);
    }
};

// What a face sees.
const Framebuffer& DepthThrough(const Scene& s, const Lamp& lamp, int face) {
    const int side = static_cast<int>(lamp.mapSize[0]);
    const RenderState state = {.depthBias = {0.0f, lamp.slopeBias[0], 0.0f}};
    const glm::mat4 clipFromWorld = lamp.ClipFromView() * lookThroughFace(firstLane(lamp.lampPosition), face);
    return s.pass(*Framebuffer::create(side, side, {{Format::depth32f}}), clipFromWorld, [&](const Scene& fromLamp) {
        for (const Object& o : fromLamp.objects) fromLamp.draw<DepthVertexProgram, NoColor>(o, state);
    });
}

template <bool SHADOWS>
void DrawLit(const Scene& s, int row, const Lamp& lamp, const SamplerCubeComparisonState& map) {
    s.cutCell(0, 2, row, 2);
    for (const Object& o : s.objects) {
        MyFragmentProgram<SHADOWS> fragment = s.uniforms(o.worldFromObject);
        fragment.clipFromView = broadcast(lamp.ClipFromView());
        fragment.shadowMap = map;
        s.draw(*o.mesh, MyVertexProgram(s.uniforms(o.worldFromObject)), fragment);
    }
    const glm::mat4 bulb = translation(firstLane(lamp.lampPosition)) * scaling(glm::vec3(0.07f));
    s.draw<DepthVertexProgram, Glow>({&primitive("sphere"), bulb});
}

// The cube unfolded, one of its faces in each cell: column and row.
constexpr glm::ivec2 kCross[] = {{2, 2}, {0, 2}, {1, 1}, {1, 3}, {1, 2}, {3, 2}};

}  // namespace

Stage beyond_07_lamp_shadows() {
    return {.title = "Lamp shadows",
            .section = "Gerasimov 2004; Rendering 7",
            .news = "A lamp among the shapes: six depths, one for each face of a cube around it.",
            .uniforms = declared<MyFragmentProgram<true>>(),
            .mesh = "cube+sphere+quad",
            .camera = {.position = {0.0f, 3.6f, -5.6f}, .target = {0.0f, -0.25f, 0.0f}},
            .draw = [](const Scene& s) {
                const Lamp lamp = s.uniforms();
                SamplerCubeComparisonState map;
                sampler2D depths[kCubeFaces];
                for (int face = 0; face < kCubeFaces; ++face) {
                    const Framebuffer& seen = DepthThrough(s, lamp, face);
                    depths[face] = s.sampled(seen, seen.depthIndex());
                    map.faces[static_cast<std::size_t>(face)] = depths[face].texture;
                }
                DrawLit<false>(s, 0, lamp, map);
                s.label("no shadows");
                DrawLit<true>(s, 1, lamp, map);
                s.label("six depths in a cube");
                s.cutCell(1, 2);
                s.label("what the lamp sees: white is near");
                const float wide = 0.97f / 8.0f,
                            high = wide * static_cast<float>(s.width) / static_cast<float>(s.height);
                for (int face = 0; face < kCubeFaces; ++face) {
                    s.cutCell(4 + kCross[face].x, 8, kCross[face].y, 4);
                    ShowDistance program = s.uniforms();
                    program.depth = depths[face];
                    s.draw(primitive("quad"), ScreenVertexProgram{wide, high}, program);
                    s.label(kCubeFaceNames[static_cast<std::size_t>(face)]);
                }
            }};
}

}  // namespace relief::samples

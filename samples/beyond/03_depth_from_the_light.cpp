// 5.03 Depth from the light: Williams 1978; Rendering 7
// New: a target as a texture. The scene is drawn from the light first, and its depth is shown on a quad.
// Was: a target that is shown (5.01).
#include "common/screen_quad.h"
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
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

struct Interpolators {
    SV_POSITION position;
    TEXCOORD<0, float3> normal;
};

struct MyVertexProgram : Uniforms {
    Interpolators operator()(VertexData v) const {
        return {UnityObjectToClipPos(object, v.position), UnityObjectToWorldNormal(object, v.normal)};
    }
};

struct MyFragmentProgram : StoneMaterial {
    float4 operator()(Interpolators i) const {
        return float4(tint.rgb() * (light.color * saturate(dot(normalize(i.normal), light.dir)) + ambient), 1);
    }
};

struct ShowDepth {
    sampler2D depth;

    float4 operator()(ScreenInterpolators i) const { return float4(float3(tex2D(depth, i.uv).x), 1); }
};

struct Lamp : StoneMaterial {
    Float mapSize = number("mapSize", 256.0f, {16, 2048}, "side of the shadow map, texels");
};

}  // namespace

Stage beyond_03_depth_from_the_light() {
    return {
        .title = "Depth from the light",
        .section = "Williams 1978; Rendering 7",
        .news = "A target as a texture: the scene, and its depth as the light sees it.",
        .uniforms = declared<MyFragmentProgram, Lamp>(),
        .mesh = "cube+sphere+quad",
        .camera = {.position = {0.0f, 1.3f, -3.6f}, .target = {0.0f, -0.1f, 0.0f}},
        .draw = [](const Scene& s) {
            const Lamp lamp = s.uniforms();
            const glm::vec3 away = firstLane(lamp.light.dir);
            const glm::mat4 clipFromWorld = orthographic(4.4f, 4.4f, 1.0f, 6.0f) * lookAt(away * 3.5f, glm::vec3(0));
            const int side = static_cast<int>(lamp.mapSize[0]);
            const Framebuffer& map = s.pass(*Framebuffer::create(side, side, {{Format::depth32f}}), clipFromWorld,
                                            [](const Scene& fromLight) {
                                                for (const Object& o : fromLight.objects)
                                                    fromLight.draw<DepthVertexProgram, NoColor>(o);
                                            });

            s.cutCell(0, 2);
            for (const Object& o : s.objects) s.draw<MyVertexProgram, MyFragmentProgram>(o);
            s.cutCell(1, 2);
            const float width = 0.8f * static_cast<float>(s.height) / static_cast<float>(s.width);
            s.draw(primitive("quad"), ScreenVertexProgram{width, 0.8f}, ShowDepth{s.sampled(map, map.depthIndex())});
            s.labelColumns({"from the camera", "depth from the light: 0 black, 1 white"});
        }};
}

}  // namespace relief::samples

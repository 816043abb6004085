// 0.07 Multiple lights: a base pass, additive passes, lights per vertex, and ambient light
// New: a light that comes after the first is a draw of its own, whose result is added.
// Was: one light (0.06).
#include "common/stage.h"

namespace relief::samples {
namespace {

struct VertexData {
    POSITION position;
    NORMAL normal;
};

template <bool VERTEXLIGHT_ON>
struct Interpolators {
    SV_POSITION position;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> worldPos;
};

template <>
struct Interpolators<true> {
    SV_POSITION position;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> worldPos;
    TEXCOORD<3, float3> vertexLightColor;
};

// A red and a green lamp of range 1.5; the other two of the four are black.
VertexLights twoLamps(Float strength) {
    const float attenSq = 25.0f / (1.5f * 1.5f);
    return {.positionX = {0.0f, 1.5f, 0.0f, 0.0f},
            .positionY = {0.4f, 0.0f, 0.0f, 0.0f},
            .positionZ = {-0.6f, -0.5f, 0.0f, 0.0f},
            .attenSq = float4(Float(attenSq)),
            .color = {float3(1.0f, 0.15f, 0.1f) * strength, float3(0.1f, 1.0f, 0.2f) * strength, float3(Float(0.0f)),
                      float3(Float(0.0f))}};
}

template <bool VERTEXLIGHT_ON>
struct MyVertexProgram : Uniforms {
    VertexLights vertexLights =
        twoLamps(number("vertexLights", 1.5f, {0, 8}, "strength of the red and green lamp; per vertex"));

    Interpolators<VERTEXLIGHT_ON> operator()(VertexData v) const {
        Interpolators<VERTEXLIGHT_ON> i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        if constexpr (VERTEXLIGHT_ON) i.vertexLightColor = Shade4PointLights(vertexLights, i.worldPos, i.normal);
        return i;
    }
};

// The sky's blue above, and what the ground gives back below.
SphericalHarmonics surroundings(float strength) {
    const glm::vec3 sky(0.1f, 0.13f, 0.2f), equator(0.05f), ground(0.02f);
    return gradientSurroundings(sky * strength, equator * strength, ground * strength);
}

// The base pass has the vertex lights and the surroundings besides its own light.
template <class Light, bool basePass>
struct MyFragmentProgram : LitMaterial {
    float ambientStrength = number("ambient", 1.0f, {0, 8}, "strength of the surroundings; spherical harmonics");
    SphericalHarmonics ambient = surroundings(ambientStrength);
    Light source = {};

    float4 operator()(Interpolators<basePass> i) const {
        i.normal = normalize(i.normal);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);

        float3 albedo = tint.xyz();
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);

        float4 color =
            UNITY_BRDF_PBS(albedo, specularTint, smoothness, i.normal, viewDir, CreateLight(source, i.worldPos));
        if constexpr (basePass) {
            color += float4(albedo * (i.vertexLightColor + ShadeSH9(ambient, i.normal)), 0);
        }
        return color;
    }
};

// The base pass fills the depth buffer; an additive pass adds its light where that very depth is seen.
constexpr RenderState kBasePass = {};
constexpr RenderState kAdditivePass = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};

struct Lights : Uniforms {
    UnityLight light = Uniforms::sun(35.0f, -20.0f);
    Float sun = number("sun", 0.25f, {0, 8}, "strength of the directional light; base pass");
    Float lamp = number("lamp", 8.0f, {0, 64}, "strength of the blue point light; additive pass");
    Float spot = number("spot", 12.0f, {0, 64}, "strength of the yellow spot light; additive pass");
};

template <bool basePass, class Light>
void drawPass(const Scene& s, const Object& o, const Light& light) {
    const MyVertexProgram<basePass> vertex = s.uniforms(o.worldFromObject);
    MyFragmentProgram<Light, basePass> fragment = s.uniforms(o.worldFromObject);
    fragment.source = light;
    s.draw(*o.mesh, vertex, fragment, basePass ? kBasePass : kAdditivePass);
}

}  // namespace

Stage basics_07_multiple_lights() {
    return {.title = "Multiple lights",
            .section = "part 5",
            .news = "A sun, a lamp, a spot, two lamps per vertex and the sky: one base pass, and additive passes.",
            .uniforms = declared<MyFragmentProgram<PointLight, true>, Lights, MyVertexProgram<true>>(),
            .mesh = "cube+sphere+quad",
            .camera = {.position = {0.0f, 1.1f, -2.7f}, .target = {0.0f, -0.1f, 0.0f}},
            .draw = [](const Scene& s) {
                const Lights lights = s.uniforms();
                const DirectionalLight sun = {lights.light.color * lights.sun, lights.light.dir};
                const PointLight lamp = {float3(0.2f, 0.45f, 1.0f) * lights.lamp, {-1.3f, 0.6f, -0.9f}, 1.2f};
                const SpotLight spot = {float3(1.0f, 0.8f, 0.3f) * lights.spot,
                                        {1.5f, 1.6f, -0.8f},
                                        3.5f,
                                        normalize(float3(-0.48f, -0.78f, 0.4f)),
                                        0.93f,
                                        0.96f};
                for (const Object& o : s.objects) {
                    drawPass<true>(s, o, sun);
                    if (s.reaches("the lamp", lamp, o)) drawPass<false>(s, o, lamp);
                    if (s.reaches("the spot", spot, o)) drawPass<false>(s, o, spot);
                }
            }};
}

}  // namespace relief::samples

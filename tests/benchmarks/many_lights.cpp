#include "many_lights.h"

#include <cmath>
#include <vector>

#include "common/camera.h"
#include "relief/relief.h"
#include "relief/shading/lights.h"
#include "relief/shading/object_transform.h"

namespace relief::benchmarks {

namespace {

constexpr int kPiecesPerSide = 8;  // each 1 x 1

// A PointLight with a number in place of one for each lane: many of them stay small.
struct Lamp
{
    glm::vec3 color, position;
    float range;

    PointLight light() const { return {broadcast(color), broadcast(position), Float(range)}; }
};

struct VertexData
{
    POSITION position;
    NORMAL normal;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float3> normal;
    TEXCOORD<1, float3> worldPos;
};

struct MyVertexProgram
{
    ObjectTransform object;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        return i;
    }
};

// One point of the floor, and what it reflects of a light.
struct Surface
{
    float3 worldPos, normal, viewDir;

    Surface(const Interpolators& i, const float3& worldSpaceCameraPos)
        : worldPos(i.worldPos),
          normal(normalize(i.normal)),
          viewDir(normalize(worldSpaceCameraPos - float3(i.worldPos)))
    {
    }

    float4 reflected(const UnityLight& light) const
    {
        return UNITY_BRDF_PBS(float3(0.5f, 0.45f, 0.4f), float3(Float(0.04f)), 0.5f, normal, viewDir, light);
    }
};

template <class Light>
struct OneLightFragmentProgram
{
    float3 worldSpaceCameraPos;
    Light source;

    float4 operator()(Interpolators i) const
    {
        const Surface surface(i, worldSpaceCameraPos);
        return surface.reflected(CreateLight(source, surface.worldPos));
    }
};

template <bool SKIPPING>
struct AllLightsFragmentProgram
{
    float3 worldSpaceCameraPos;
    DirectionalLight sun;
    const std::vector<Lamp>* lamps;

    float4 operator()(Interpolators i) const
    {
        const Surface surface(i, worldSpaceCameraPos);
        float4 color = surface.reflected(CreateLight(sun, surface.worldPos));
        for (const Lamp& lamp : *lamps) {
            const UnityLight light = CreateLight(lamp.light(), surface.worldPos);
            if (SKIPPING && !any(light.color.x > 0.0f)) continue;
            color += float4(surface.reflected(light).xyz(), 0);
        }
        return color;
    }
};

// The base pass fills the depth buffer; an additive pass adds its light where that very depth is seen.
constexpr RenderState kBasePass = {};
constexpr RenderState kAdditivePass = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};

struct Floor
{
    Mesh piece = makeQuad();
    std::vector<Lamp> lamps;
    samples::Camera camera = {.position = {0.0f, 3.6f, -5.6f}, .target = {0.0f, -0.4f, 0.0f}, .fieldOfView = 60};
};

// Spread evenly over the floor and one unit around it: the i-th points of two sequences by multiples of a number that
// fill a square without clusters (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences": 1/p and 1/p^2,
// p^3 = p + 1).
std::vector<Lamp> makeLamps(int count)
{
    std::vector<Lamp> lamps;
    for (int i = 0; i < count; ++i) {
        const auto place = [i](double step) {
            const double turns = 0.5 + step * i;
            return static_cast<float>((turns - std::floor(turns) - 0.5) * (kPiecesPerSide + 2));
        };
        const glm::vec3 colors[] = {{1.0f, 0.3f, 0.2f}, {0.2f, 1.0f, 0.3f}, {0.3f, 0.4f, 1.0f}};
        lamps.push_back({colors[i % 3], {place(0.7548776662466927), 0.5f, place(0.5698402909980532)}, 1.8f});
    }
    return lamps;
}

}  // namespace

std::shared_ptr<const void> recordManyLights(Frame& frame, int width, int height, int lamps, LightsBy by)
{
    const auto floor = std::make_shared<Floor>();
    floor->lamps = makeLamps(lamps);
    const glm::mat4 clipFromWorld =
        samples::clipFromView(floor->camera, static_cast<float>(width) / static_cast<float>(height)) *
        samples::viewFromWorld(floor->camera);
    const float3 eye = broadcast(floor->camera.position);
    const DirectionalLight sun = {float3(Float(0.3f)), normalize(float3(0.3f, 1.0f, -0.4f))};
    for (int n = 0; n < kPiecesPerSide * kPiecesPerSide; ++n) {
        const auto place = [](int cell) { return static_cast<float>(cell) - (kPiecesPerSide - 1) * 0.5f; };
        const glm::mat4 worldFromObject =
            samples::translation({place(n % kPiecesPerSide), 0, place(n / kPiecesPerSide)}) * samples::rotationX(90);
        const MyVertexProgram vertexProgram{{clipFromWorld, worldFromObject}};
        if (by == LightsBy::loop) {
            frame.draw(floor->piece, vertexProgram, AllLightsFragmentProgram<false>{eye, sun, &floor->lamps});
            continue;
        }
        if (by == LightsBy::skippingLoop) {
            frame.draw(floor->piece, vertexProgram, AllLightsFragmentProgram<true>{eye, sun, &floor->lamps});
            continue;
        }
        frame.draw(floor->piece, vertexProgram, OneLightFragmentProgram<DirectionalLight>{eye, sun}, kBasePass);
        const Bounds bounds = transformed(boundsOf(floor->piece), worldFromObject);
        for (const Lamp& lamp : floor->lamps) {
            if (!lightReaches(lamp.light(), bounds)) continue;
            frame.draw(floor->piece, vertexProgram, OneLightFragmentProgram<PointLight>{eye, lamp.light()},
                       kAdditivePass);
        }
    }
    return floor;
}

}  // namespace relief::benchmarks

#include "common/lit_scene.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "common/render.h"
#include "relief/pipeline/target_texture.h"
#include "relief/shading/normals.h"
#include "relief/shading/object_transform.h"
#include "relief/shading/tangent_space.h"
#include "relief/texture/comparison_sampler.h"

namespace relief::samples {

namespace {

// --- the programs; with and without a normal map ---

template <bool NORMAL_MAP>
struct VertexData;

template <>
struct VertexData<false>
{
    POSITION position;
    NORMAL normal;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float2> uv1;
    COLOR<0, float4> color;
};

template <>
struct VertexData<true>
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float2> uv1;
    COLOR<0, float4> color;
};

template <bool NORMAL_MAP>
struct Interpolators;

template <>
struct Interpolators<false>
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;  // the first set in xy, the second in zw
    TEXCOORD<1, float3> normal;
    TEXCOORD<3, float3> worldPos;
    COLOR<0, float4> color;
};

template <>
struct Interpolators<true>
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<3, float3> worldPos;
    COLOR<0, float4> color;
};

template <bool NORMAL_MAP>
struct SceneVertexProgram
{
    ObjectTransform object;

    Interpolators<NORMAL_MAP> operator()(VertexData<NORMAL_MAP> v) const
    {
        Interpolators<NORMAL_MAP> i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        if constexpr (NORMAL_MAP) i.tangent = float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w);
        i.uv = float4(v.uv, v.uv1);
        i.color = v.color;
        return i;
    }
};

float4 sampled(const MaterialTexture& t, const float4& uvs)
{
    const float2 uv = t.uvSet == 0 ? uvs.xy() : uvs.zw();
    return tex2D(t.sampler, {uv.x * t.u.x + uv.y * t.u.y + t.u.z, uv.x * t.v.x + uv.y * t.v.y + t.v.z});
}

// What the fragment programs share.
template <bool NORMAL_MAP>
struct Surface
{
    SceneMaterial material;
    Surroundings light;
    float3 worldSpaceCameraPos;
    Float mirrorSign;  // unity_WorldTransformParams.w
    Float side;        // 1 where fronts are drawn, -1 where backs are

    float4 baseColor(const Interpolators<NORMAL_MAP>& i) const
    {
        return sampled(material.baseColorTexture, i.uv) * broadcast(material.baseColor) * i.color;
    }

    float3 normalAt(const Interpolators<NORMAL_MAP>& i) const
    {
        if constexpr (NORMAL_MAP) {
            const float3 tangent = i.tangent.xyz();
            const float3 binormal = CreateBinormal(i.normal, tangent, i.tangent.w, mirrorSign);
            const float3 bump = UnpackScaleNormalRGB(sampled(material.normalTexture, i.uv), material.normalScale);
            return TangentSpaceToWorld(bump, tangent, binormal, i.normal) * side;
        } else {
            return normalize(i.normal) * side;
        }
    }

    // The light that the surroundings send to the viewer by this surface, as Unity's BRDF1: their reflection grows
    // towards grazing angles, and fades with roughness.
    float3 ambient(const float3& diffuse, const float3& specular, Float oneMinusReflectivity, Float roughness,
                   const float3& normal, const float3& viewDir) const
    {
        const Float smoothness = 1.0f - roughness;
        const Float grazing = saturate(smoothness + (1.0f - oneMinusReflectivity));
        const float3 fresnel = lerp(specular, float3(grazing), Pow5(1.0f - abs(dot(normal, viewDir))));
        const Float squared = roughness * roughness;
        const float3 direction = reflect(-viewDir, normal);
        const float3 mirrored =
            light.mirrored == nullptr
                ? ShadeSH9(light.sky, direction)
                : texCUBElod({light.mirrored},
                             float4(direction, levelOfRoughness(roughness, light.mirrored->levelCount())))
                      .xyz();
        return diffuse * ShadeSH9(light.sky, normal) + mirrored * fresnel * (1.0f / (squared * squared + 1.0f));
    }

    // The share of the sun that arrives: nine comparisons of 2x2 texels each, off the surface by a texel and a half.
    Float shadow(const Interpolators<NORMAL_MAP>& i) const
    {
        if (light.shadow == nullptr) return 1.0f;
        const SunShadow& sun = *light.shadow;
        const float3 position = i.worldPos + normalize(i.normal) * (side * (1.5f * sun.texel));
        const float4 p = mul(broadcast(sun.sunFromWorld), float4(position, 1.0f));
        const float2 uv = p.xy() * 0.5f + 0.5f;
        const float step = sun.depth.texelSize().x;
        Float sum = 0.0f;
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                const float2 aside = {Float(static_cast<float>(x) * step), Float(static_cast<float>(y) * step)};
                sum += SampleCmp({&sun.depth}, uv + aside, p.z);
            }
        }
        return sum * (1.0f / 9.0f);
    }

    float3 lit(const Interpolators<NORMAL_MAP>& i, const float3& base) const
    {
        if (material.unlit) return base;
        const float4 metallicRoughness = sampled(material.metallicRoughnessTexture, i.uv);
        const Float roughness = saturate(metallicRoughness.y * material.roughness);
        const float3 normal = normalAt(i);
        const float3 viewDir = normalize(worldSpaceCameraPos - i.worldPos);
        float3 specular;
        Float oneMinusReflectivity;
        const float3 diffuse = DiffuseAndSpecularFromMetallic(base, metallicRoughness.z * material.metallic, specular,
                                                              oneMinusReflectivity);
        float3 direct = UNITY_BRDF_PBS_Exact(diffuse, specular, 1.0f - roughness, normal, viewDir,
                                             CreateLight(light.sun, i.worldPos))
                            .xyz() *
                        shadow(i);
        for (const PunctualLight& lamp : light.lamps) {
            direct += UNITY_BRDF_PBS_Exact(diffuse, specular, 1.0f - roughness, normal, viewDir,
                                           CreateLight(lamp, i.worldPos))
                          .xyz();
        }
        const Float occlusion = 1.0f + (sampled(material.occlusionTexture, i.uv).x - 1.0f) * material.occlusionStrength;
        const float3 emitted = sampled(material.emissiveTexture, i.uv).xyz() * broadcast(material.emissive);
        return direct + ambient(diffuse, specular, oneMinusReflectivity, roughness, normal, viewDir) * occlusion +
               emitted;
    }
};

template <bool NORMAL_MAP>
struct OpaqueProgram : Surface<NORMAL_MAP>
{
    float4 operator()(Interpolators<NORMAL_MAP> i) const
    {
        return float4(this->lit(i, this->baseColor(i).xyz()), 1.0f);
    }
};

template <bool NORMAL_MAP>
struct MaskedProgram : Surface<NORMAL_MAP>
{
    float4 operator()(Interpolators<NORMAL_MAP> i, Discard& discard) const
    {
        const float4 base = this->baseColor(i);
        discard(base.w < this->material.alphaCutoff);
        if (discard.all()) return 0.0f;
        return float4(this->lit(i, base.xyz()), 1.0f);
    }
};

template <bool NORMAL_MAP>
struct BlendedProgram : Surface<NORMAL_MAP>
{
    float4 operator()(Interpolators<NORMAL_MAP> i) const
    {
        const float4 base = this->baseColor(i);
        return float4(this->lit(i, base.xyz()), saturate(base.w));
    }
};

// For the sun's depths: nothing but what a mask lets through.
struct MaskAlone : Surface<false>
{
    float4 operator()(Interpolators<false> i, Discard& discard) const
    {
        discard(baseColor(i).w < material.alphaCutoff);
        return float4(0.0f);
    }
};
struct Nothing
{
    float4 operator()(const Interpolators<false>&) const { return float4(0.0f); }
};

template <bool NORMAL_MAP>
void drawSide(Frame& frame, const Mesh& mesh, const ObjectTransform& object, const Surface<NORMAL_MAP>& surface,
              Cull cull)
{
    const SceneVertexProgram<NORMAL_MAP> vertex = {object};
    switch (surface.material.alpha) {
        case SceneMaterial::Alpha::opaque:
            frame.draw(mesh, vertex, OpaqueProgram<NORMAL_MAP>{surface}, {.cull = cull});
            break;
        case SceneMaterial::Alpha::mask:
            frame.draw(mesh, vertex, MaskedProgram<NORMAL_MAP>{surface}, {.cull = cull});
            break;
        case SceneMaterial::Alpha::blend:
            frame.draw(mesh, vertex, BlendedProgram<NORMAL_MAP>{surface},
                       {.depthWrite = false, .cull = cull, .blend = Blend::alpha});
            break;
    }
}

template <bool NORMAL_MAP>
void drawMesh(Frame& frame, const Mesh& mesh, const ObjectTransform& object, Surface<NORMAL_MAP> surface)
{
    if (surface.material.twoSided) {
        surface.side = -1.0f;
        drawSide(frame, mesh, object, surface, Cull::front);
    }
    surface.side = 1.0f;
    drawSide(frame, mesh, object, surface, Cull::back);
}

constexpr float kExtent = 2.0f;            // of the longest side
constexpr float kSineOfHalfView = 0.342f;  // sin 20 degrees, of Camera's usual field of view

}  // namespace

Surroundings usualSurroundings()
{
    return {.sun = {.color = float3(0.9f, 0.86f, 0.78f), .dir = normalize(float3(0.75f, 1.0f, 0.55f))},
            .sky = clearSky(1.0f)};
}

SphericalHarmonics clearSky(float strength)
{
    const glm::vec3 above(0.40f, 0.45f, 0.52f), around(0.26f, 0.27f, 0.29f), below(0.13f, 0.12f, 0.10f);
    return gradientSurroundings(above * strength, around * strength, below * strength);
}

LitScene::LitScene(SceneFile itsScene) : scene(std::move(itsScene))
{
    const Bounds& bounds = scene.bounds;
    float extent = 0.0f;
    for (int i = 0; i < 3; ++i) extent = std::max(extent, bounds.high[i] * 0.5f - bounds.low[i] * 0.5f);
    scale = extent > 0.0f ? std::clamp(kExtent * 0.5f / extent, 1e-30f, 1e30f) : 1.0f;
    worldFromScene = scaling(glm::vec3(scale)) * translation(-bounds.centre());
    for (const SceneLight& light : scene.lights) {
        const PunctualLight lamp = punctualLight(light, worldFromScene, scale);
        if (light.kind == SceneLight::Kind::directional && !filesSun) {
            filesSun = DirectionalLight{lamp.color, lamp.dir};
        } else {
            filesLamps.push_back(lamp);
        }
    }
}

Surroundings LitScene::lightOf(const Surroundings& day) const
{
    if (scene.lights.empty()) return day;
    Surroundings its = day;
    its.sun = filesSun.value_or(DirectionalLight{float3(0.0f), day.sun.dir});
    its.lamps = filesLamps;
    return its;
}

Expected<SunShadow> LitScene::shadowOf(const float3& sun, int threads, int side) const
{
    const float radius = std::max(scene.bounds.radius() * scale, 1e-3f);
    const glm::mat4 sunFromWorld = orthographic(2.0f * radius, 2.0f * radius, radius, 3.0f * radius) *
                                   lookAt(firstLane(sun) * (2.0f * radius), glm::vec3(0.0f));
    Expected<Framebuffer> target = Framebuffer::create(side, side, {{Format::depth32f, Store::keep}});
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {.threads = threads});
    frame.clearDepth();
    const RenderState state = {.cull = Cull::none, .depthBias = {.slope = 1.5f}};
    for (const SceneInstance& instance : scene.instances) {
        const SceneMaterial& material = scene.materials[instance.material];
        if (material.alpha == SceneMaterial::Alpha::blend) continue;
        const SceneVertexProgram<false> vertex = {
            ObjectTransform(sunFromWorld, worldFromScene * instance.worldFromObject)};
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Expected<void> drawn = material.alpha == SceneMaterial::Alpha::mask
                                         ? frame.draw(mesh, vertex, MaskAlone{{material, {}, {}, 1.0f, 1.0f}}, state)
                                         : frame.draw(mesh, vertex, Nothing{}, state);
        if (!drawn) return tl::unexpected(drawn.error());
    }
    frame.run();
    return textureOf(*target, 0).map([&](Texture&& depth) {
        return SunShadow{std::move(depth), firstLane(sun), sunFromWorld, 2.0f * radius / static_cast<float>(side)};
    });
}

LitScene::View LitScene::view(float aspect) const
{
    if (!chosen && scene.camera) {
        const SceneCamera& its = *scene.camera;
        const glm::vec3 position = glm::vec3(worldFromScene * glm::vec4(its.position, 1.0f));
        return {perspective(its.fieldOfView, aspect, its.nearPlane * scale, its.farPlane * scale) *
                    lookAlong(position, its.forward, its.up),
                position};
    }
    Camera camera;
    if (chosen) {
        camera = *chosen;
    } else {
        const float distance = scene.bounds.radius() * scale / (kSineOfHalfView * std::min(aspect, 1.0f));
        camera.position = glm::normalize(glm::vec3(0.55f, 0.45f, 1.0f)) * distance;
        camera.nearPlane = 0.01f;
    }
    return {clipFromView(camera, aspect) * viewFromWorld(camera), camera.position};
}

void LitScene::draw(Frame& frame, const SceneInstance& instance, const View& from, const Surroundings& light) const
{
    const Mesh& mesh = scene.meshes[instance.mesh];
    const SceneMaterial& material = scene.materials[instance.material];
    const ObjectTransform object(from.clipFromWorld, worldFromScene * instance.worldFromObject);
    const Float mirror = object.unity_WorldTransformParams.w;
    frame.setFrontCounterClockwise(instance.mirrored);
    if (material.hasNormalMap()) {
        drawMesh<true>(frame, mesh, object, {material, light, broadcast(from.position), mirror, 1.0f});
    } else {
        drawMesh<false>(frame, mesh, object, {material, light, broadcast(from.position), mirror, 1.0f});
    }
}

Expected<void> LitScene::record(Frame& frame, int width, int height, const Surroundings& light) const
{
    frame.reset();
    frame.clear(kBackground);
    return draw(frame, view(static_cast<float>(width) / static_cast<float>(height)), light);
}

Expected<void> LitScene::draw(Frame& frame, const View& from, const Surroundings& light) const
{
    std::vector<std::pair<float, const SceneInstance*>> blended;  // by squared distance
    for (const SceneInstance& instance : scene.instances) {
        if (scene.materials[instance.material].alpha == SceneMaterial::Alpha::blend) {
            const glm::vec3 d = glm::vec3(worldFromScene * glm::vec4(instance.bounds.centre(), 1.0f)) - from.position;
            blended.emplace_back(d.x * d.x + d.y * d.y + d.z * d.z, &instance);
        } else {
            draw(frame, instance, from, light);
        }
    }
    // The farthest first; of equal ones in the file's order.
    std::sort(blended.begin(), blended.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    for (const auto& [distance, instance] : blended) draw(frame, *instance, from, light);
    frame.setFrontCounterClockwise(false);
    if (!frame.problem().empty()) return fail(frame.problem());
    return {};
}

}  // namespace relief::samples

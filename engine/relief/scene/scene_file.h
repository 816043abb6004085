// A scene as a file describes it: meshes, where they stand, what they are made of. Plain data, checked when it was read
// (gltf.h); who draws it decides about lights. Our conventions: left-handed, Y up, clockwise fronts, uv (0, 0) at the
// lower left, colours linear (hlsl/conventions.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "relief/mesh/bounds.h"
#include "relief/mesh/mesh.h"
#include "relief/texture/sampler.h"

namespace relief::inline RELIEF_WIDTH {

// A texture of a material. Without one, `sampler` is white.
struct MaterialTexture
{
    sampler2D sampler;
    int uvSet = 0;  // 0 or 1: TEXCOORD0 or TEXCOORD1

    // The uv that is sampled: (dot(u, (uv, 1)), dot(v, (uv, 1))).
    glm::vec3 u{1, 0, 0}, v{0, 1, 0};
};

// glTF's metallic-roughness material. Each factor is multiplied by its texture's channel.
struct SceneMaterial
{
    enum class Alpha
    {
        opaque,  // alpha is 1
        mask,    // drawn where alpha >= alphaCutoff
        blend
    };

    glm::vec4 baseColor{1.0f};                // linear
    glm::vec3 emissive{0.0f};                 // linear, at least 0
    float metallic = 1.0f, roughness = 1.0f;  // 0 ... 1
    float normalScale = 1.0f;
    float occlusionStrength = 1.0f;  // 0 ... 1
    Alpha alpha = Alpha::opaque;
    float alphaCutoff = 0.5f;
    bool twoSided = false;
    bool unlit = false;  // the base colour as it is

    MaterialTexture baseColorTexture;          // sRGB
    MaterialTexture metallicRoughnessTexture;  // green roughness, blue metallic
    MaterialTexture normalTexture;             // +Y, read by UnpackScaleNormalRGB
    MaterialTexture occlusionTexture;          // red
    MaterialTexture emissiveTexture;           // sRGB

    bool hasNormalMap() const { return normalTexture.sampler.texture != nullptr; }
};

struct SceneInstance
{
    std::size_t mesh, material;  // among SceneFile's
    glm::mat4 worldFromObject;   // affine, with finite numbers
    bool mirrored;               // it turns clockwise fronts round: Frame::setFrontCounterClockwise
    Bounds bounds;               // in world space
};

struct SceneCamera
{
    glm::vec3 position, forward, up;  // world space, unit vectors
    float fieldOfView;                // vertical, degrees, in (0, 180)
    float nearPlane;
    float farPlane;  // may be infinite
};

// KHR_lights_punctual. Nothing of a light is behind its range, which may be infinite.
struct SceneLight
{
    enum class Kind
    {
        directional,
        point,
        spot
    };

    Kind kind;
    glm::vec3 color;              // linear, 0 ... 1
    float intensity;              // lux of a directional light, candela of the others; at least 0
    glm::vec3 position, forward;  // world space; where it shines to, a unit vector, not of points
    float range;
    float cosInner, cosOuter;  // of a spot's angles from its middle: the outer one is less
};

struct SceneFile
{
    // Each with normals, uvs, the stream TEXCOORD1 and colours; with tangents where its material has a normal map.
    std::vector<Mesh> meshes;
    std::vector<SceneMaterial> materials;
    std::vector<SceneInstance> instances;                  // in the order of the file's nodes, parents first
    std::vector<std::shared_ptr<const Texture>> textures;  // that the materials' samplers name
    std::optional<SceneCamera> camera;                     // the first one with perspective
    std::vector<SceneLight> lights;                        // in the order of the nodes that they belong to
    Bounds bounds;                                         // of all instances, in world space

    std::vector<std::string> notes;  // what the file has and this has not, one line each
};

}  // namespace relief::inline RELIEF_WIDTH

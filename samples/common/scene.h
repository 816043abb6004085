// What a stage's draw function gets: the frame, and everything that is not the lesson, ready to be put into the fields
// of its programs: matrices, camera, light, textures and the values of the stage's properties.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/camera.h"
#include "relief.h"
#include "shading/lighting.h"
#include "shading/object_transform.h"

namespace relief::samples {

// A number, colour or vector that the user may change: --set name=value, or the arrow keys in the window. Ranges and
// defaults are the tutorial's.
struct Property
{
    std::string name;
    glm::vec4 value{0.0f};
    float minimum = 0.0f, maximum = 1.0f;
    int components = 1;
    std::string meaning;
};

// What a stage reads from files: the default's name in assets/; empty: the stage has no such input; `none`: it has one,
// but nothing is in it by default.
inline constexpr const char* kNone = "none";

struct Inputs
{
    std::string mesh;  // "quad", "cube", "sphere", "terrain"
    std::string albedo, height, normal, detail;
};

// The user's files in place of the defaults; empty: the default.
struct InputFiles
{
    std::string mesh, albedo, height, normal, detail;
};

// The loaded inputs; they outlive the frames that use them.
struct LoadedInputs
{
    Mesh mesh;
    bool usersMesh = false;
    std::optional<Texture> albedo, height, normal, detail;
};

// Loads what a stage reads. A file that cannot be read, or that the stage has no input for, is an error naming it.
Expected<std::unique_ptr<LoadedInputs>> loadInputs(const Inputs& inputs, const InputFiles& files);

class Scene
{
public:
    Scene(Frame& frame, int width, int height, const Camera& camera, const LoadedInputs& inputs,
          const std::vector<Property>& properties);

    Frame& frame;
    int width, height;
    const Mesh& mesh;

    // Uniforms, under Unity's names without their underscores.
    float3 worldSpaceCameraPos;
    UnityLight light;  // directional, turned by the properties lightPitch and lightYaw
    sampler2D mainTex, heightMap, normalMap, detailTex;
    float4 heightMap_TexelSize;

    // A property's value in every lane.
    float4 vector(const std::string& name) const;
    Float number(const std::string& name) const;

    // The matrices of an object. lying() lays the quad flat, facing up; a mesh of the user's stands as it is.
    ObjectTransform object(const glm::mat4& worldFromObject) const;
    ObjectTransform lying() const;

    // Draws into the same camera's picture again, but only between two fractions of its width.
    void cutStrip(float from, float to) const;

private:
    bool usersMesh;
    glm::mat4 clipFromWorld;
    std::map<std::string, glm::vec4> values;
};

// The properties of Rendering 5's material, on which all of "Bumpiness" builds, and the light's two angles.
std::vector<Property> litProperties(std::vector<Property> more = {});

// The height of the bumps: how many texels high the whole range of the height map is. Resolution changes the look
// unless this grows with it, which is what the tutorial's "replace delta by 1" hides.
Property bumpScaleProperty();

}  // namespace relief::samples

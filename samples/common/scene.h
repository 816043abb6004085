// What a stage's draw function gets: the frame, and everything that is not the lesson, ready to be put into the fields
// of its programs: matrices, camera, light, textures and the values of the stage's properties.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/camera.h"
#include "common/input_files.h"
#include "relief.h"
#include "shading/lights.h"
#include "shading/normals.h"
#include "shading/object_transform.h"
#include "shading/tangent_space.h"
#include "texture/import.h"

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
// but nothing is in it by default. The import settings are those of Unity's inspector.
inline constexpr const char* kNone = "none";

// A normal map as DXT5nm: of a grey picture's heights, or of a picture of normals.
ImportSettings normalMapSettings(float bumpiness, bool fadeOutMips = false);

struct Inputs
{
    std::string mesh;  // "quad", "cube", "sphere", "terrain"; several with + between them stand side by side
    std::string albedo, height, normal, detail, detailNormal;
    float cubesTurnedBy = 35.0f;  // degrees about Y, where there are several shapes
    ImportSettings normalImport = normalMapSettings(0.05f);
    ImportSettings detailImport = {};
    ImportSettings detailNormalImport = normalMapSettings(0.1f);
};

// A mesh and where it stands.
struct Object
{
    const Mesh* mesh;
    glm::mat4 worldFromObject;
};

// The loaded inputs; they outlive the frames that use them.
struct LoadedInputs
{
    std::optional<Mesh> usersMesh;
    std::vector<Object> objects;  // the user's mesh alone, or the stage's
    std::shared_ptr<const Texture> albedo, height, normal, detail, detailNormal;
};

// Loads what a stage reads. A file that cannot be read, or that the stage has no input for, is an error naming it.
Expected<std::unique_ptr<LoadedInputs>> loadInputs(const Inputs& inputs, const InputFiles& files);

// What a scene leaves behind when it is drawn, and what the frame still needs when it runs.
struct SceneLog
{
    // Every draw's mesh and matrix, in order, and which part of the picture it went to.
    struct Drawn
    {
        Object object;
        Viewport viewport;
        Rectangle scissor;
    };
    std::vector<Drawn> drawn;
    std::vector<std::string> notes;  // what was left out, and what was measured; for explain
    int passesLeftOut = 0;           // by Scene::reaches
    std::deque<Mesh> kept;           // meshes that the scene made

    // Meshes that came without uv or tangents, with them; made when a program first reads any.
    std::map<const Mesh*, std::unique_ptr<Mesh>> uvs, tangents;

    std::set<const Texture*> textures;  // that the stage made; explain counts their mip levels

    Viewport viewport;  // of the next draws
    Rectangle scissor;

    // For the next frame; uvs and tangents stay.
    void clear();
};

struct TangentSpaceVisualizer;

class Scene
{
public:
    Scene(Frame& frame, SceneLog& log, int width, int height, const Camera& camera, const LoadedInputs& inputs,
          const std::vector<Property>& properties);

    Frame& frame;
    int width, height;
    const std::vector<Object>& objects;
    const Mesh& mesh;  // the first object's

    // Uniforms, under Unity's names without their underscores.
    float3 worldSpaceCameraPos;
    UnityLight light;  // directional, turned by the properties lightPitch and lightYaw
    sampler2D mainTex, heightMap, normalMap, detailTex, detailNormalMap;
    float4 heightMap_TexelSize;

    // A property's value in every lane.
    float4 vector(const std::string& name) const;
    Float number(const std::string& name) const;

    // The matrices of an object. lying() lays the quad flat, facing up; a mesh of the user's stands as it is.
    ObjectTransform object(const glm::mat4& worldFromObject) const;
    ObjectTransform lying() const;

    // Frame::draw. A mesh without uv or tangents gets them here, if the vertex program reads any, and a mirrored object
    // its front faces.
    template <class VertexProgram, class FragmentProgram>
    void draw(const Mesh& mesh, const VertexProgram& vertexProgram, const FragmentProgram& fragmentProgram,
              const RenderState& state = {}) const;

    // Whether a light reaches an object; if not, its pass is to be left out, and explain says so.
    template <class Light>
    bool reaches(const std::string& name, const Light& light, const Object& object) const;

    // Draws into the same camera's picture again, but only between two fractions of its width.
    void cutStrip(float from, float to) const;

    // Lines over everything drawn so far.
    void showTangents(const TangentSpaceVisualizer& visualizer) const;

    // The next draws go into one of `columns` * `rows` cells of the picture, from the top left one, seen by the same
    // camera in each: what stands at the origin looks the same in all of them.
    void cutCell(int column, int columns, int row = 0, int rows = 1) const;

    // For meshes that a stage makes: they live until the frame has run. For textures that it makes and that live
    // longer: explain knows of them. And a line for explain.
    const Mesh& keep(Mesh made) const;
    sampler2D samplerOf(const Texture& made) const;
    void note(const std::string& line) const;

    // The mesh, or, if it came without, the same with uv by longitude and latitude, or with tangents; made once.
    const Mesh& withUvs(const Mesh& mesh) const;
    const Mesh& withTangents(const Mesh& mesh) const;

private:
    const Mesh& prepare(const Mesh& drawn, std::span<const Field> vertexData, const float4x4* worldFromObject) const;
    void cut(const Viewport& viewport, const Rectangle& scissor) const;
    void leftOut(const std::string& name, const Object& object) const;

    SceneLog& log;
    bool usersMesh;
    glm::mat4 clipFromWorld;
    std::map<std::string, glm::vec4> values;
};

template <class VertexProgram, class FragmentProgram>
void Scene::draw(const Mesh& drawnMesh, const VertexProgram& vertexProgram, const FragmentProgram& fragmentProgram,
                 const RenderState& state) const
{
    const float4x4* worldFromObject = nullptr;
    if constexpr (requires { vertexProgram.object.worldFromObject; }) {
        worldFromObject = &vertexProgram.object.worldFromObject;
    }
    const Mesh& complete = prepare(drawnMesh, kFields<relief::detail::VertexDataFor<VertexProgram>>, worldFromObject);
    frame.draw(complete, vertexProgram, fragmentProgram, state);
}

template <class Light>
bool Scene::reaches(const std::string& name, const Light& source, const Object& object) const
{
    const bool reached = lightReaches(source, transformed(boundsOf(*object.mesh), object.worldFromObject));
    if (!reached) leftOut(name, object);
    return reached;
}

// One list after the other; and the light's two angles.
std::vector<Property> joined(std::vector<Property> first, const std::vector<Property>& more);
std::vector<Property> lightAngles(float pitch, float yaw);

// The properties of Rendering 5's material, on which all of "Bumpiness" builds, and the light's two angles.
std::vector<Property> litProperties(const std::vector<Property>& more = {});

// The height of the bumps: how many texels high the whole range of the height map is. Resolution changes the look
// unless this grows with it, which is what the tutorial's "replace delta by 1" hides.
Property bumpScaleProperty();

// Of a finished normal map, as the tutorial's Bump Scale: 1 takes it as it is.
Property mapScaleProperty(const std::string& name, float value);
Property detailTilingProperty();

// Where the binormal is computed: the default is the CMake option RELIEF_BINORMAL_PER_FRAGMENT.
inline constexpr bool kBinormalPerFragment = RELIEF_BINORMAL_PER_FRAGMENT != 0;
Property binormalPerFragmentProperty(float value);

// What the stages from 1.19 on share: the marble with its normals, detail and detail normals, and their properties.
Inputs detailedMarble(const std::string& mesh);
Inputs bare(const std::string& mesh);  // the same inputs, with nothing in them
std::vector<Property> detailedProperties(const std::vector<Property>& more = {});

}  // namespace relief::samples

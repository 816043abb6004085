// What a stage's draw function gets: the frame, the objects, and the uniforms of its programs.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/camera.h"
#include "common/input_files.h"
#include "common/overlay.h"
#include "common/uniforms.h"
#include "relief/pipeline/instruments.h"
#include "relief/shading/normals.h"
#include "relief/shading/tangent_space.h"

namespace relief::samples {

class LitScene;
struct Environment;
struct SunShadow;
struct Surroundings;

// What a stage names as its mesh that shows a scene of a glTF file, which the user names with --mesh.
inline constexpr std::string_view kSceneOfFile = "scene";

// A mesh and where it stands.
struct Object
{
    const Mesh* mesh;
    glm::mat4 worldFromObject{1.0f};
};

// The loaded inputs; they outlive the frames that use them.
struct LoadedInputs
{
    std::optional<Mesh> usersMesh;
    std::vector<Object> objects;  // the user's mesh alone, or the stage's
    std::shared_ptr<const LitScene> usersScene;
    PerTexture<std::shared_ptr<const Texture>> textures;
    std::shared_ptr<const Environment> environment;  // null: none, or the stage reads none
};

// Of a glTF file.
Expected<std::shared_ptr<const LitScene>> readLitScene(const std::string& path);

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

    // A pass before the picture, for explain: what it drew, which attachments of its target became textures, a bit for
    // each, and, where `tellsDraws`, what each draw added to the statistics.
    struct Pass
    {
        const Framebuffer* target;
        Statistics statistics;
        std::vector<DrawFacts> draws;
        std::vector<Statistics> ofDraws;
        unsigned read = 0;
    };
    std::vector<Pass> passes;
    bool tellsDraws = false;

    std::vector<std::string> notes;   // what was left out, and what was measured; for explain
    std::vector<Label> labels;        // for who shows the picture (inside.h)
    std::string problem;              // with the stage itself, one line
    int passesLeftOut = 0;            // by Scene::reaches
    std::deque<Mesh> kept;            // meshes that the scene made
    std::deque<Framebuffer> targets;  // of passes before the picture, and what of them is a texture
    std::deque<Texture> rendered;
    std::shared_ptr<const SunShadow> sunShadow;  // of the user's scene

    // Meshes that came without uv or tangents, with them; made when a program first reads any.
    std::map<const Mesh*, std::unique_ptr<Mesh>> uvs, tangents;

    std::set<const Texture*> textures;  // that the stage made; explain counts their mip levels

    Viewport viewport;  // of the next draws
    Rectangle scissor;

    // For the next frame; uvs and tangents stay, and what explain asks for.
    void clear();
};

struct TangentSpaceVisualizer;

class Scene final : private UniformSource
{
public:
    Scene(Frame& frame, SceneLog& log, int width, int height, const Camera& camera, const LoadedInputs& inputs,
          const std::vector<Property>& properties);

    Frame& frame;
    int width, height;
    const std::vector<Object>& objects;
    const Mesh& mesh;  // the first object's

    // The uniforms of an object, for any struct that is derived from Uniforms. At the origin: those of no object.
    Uniforms uniforms(const glm::mat4& worldFromObject = glm::mat4(1.0f)) const;

    // The first object, laid flat and facing up; a mesh of the user's as it is.
    Object lying() const;

    // The scene of the user's file (kSceneOfFile), in its own materials (lit_scene.h).
    void drawFile(const Surroundings& light) const;

    // Draws an object with programs that need no more than its uniforms.
    template <class VertexProgram, class FragmentProgram>
    void draw(const Object& object, const RenderState& state = {}) const;

    // Frame::draw. A mesh without uv or tangents gets them here, if the vertex program reads any, and a mirrored object
    // its front faces.
    template <class VertexProgram, class FragmentProgram>
    void draw(const Mesh& mesh, const VertexProgram& vertexProgram, const FragmentProgram& fragmentProgram,
              const RenderState& state = {}) const;

    // Draws into a target of its own before the picture, seen by a camera of its own: `record` gets a scene for it,
    // whose frame is cleared to 0 and depth 1, and which is run at once. The target lives until the picture's frame has
    // run.
    Framebuffer& pass(Framebuffer target, const glm::mat4& clipFromWorld,
                      const std::function<void(const Scene&)>& record) const;

    // The same, seen by the picture's own camera.
    Framebuffer& pass(Framebuffer target, const std::function<void(const Scene&)>& record) const;

    // An attachment of such a target as a texture (pipeline/target_texture.h), clamped at its edges. It lives as long.
    sampler2D sampled(const Framebuffer& target, int attachment) const;

    // Whether a light reaches an object; if not, its pass is to be left out, and explain says so.
    template <class Light>
    bool reaches(std::string_view name, const Light& light, const Object& object) const;

    // Draws into the same camera's picture again, but only between two fractions of its width.
    void cutStrip(float from, float to) const;

    // Lines over everything drawn so far.
    void showTangents(const TangentSpaceVisualizer& visualizer) const;

    // The next draws go into one of `columns` * `rows` cells of the picture, from the top left one, seen by the same
    // camera in each: what stands at the origin looks the same in all of them.
    void cutCell(int column, int columns, int row = 0, int rows = 1) const;

    // A few words about each column of the picture, or of one of its rows: what it shows. And about what the next draws
    // go to, a cell, a strip or the whole picture.
    void labelColumns(std::initializer_list<std::string_view> words, int row = 0, int rows = 1) const;
    void label(std::string_view words) const;

    // The same about a scale at its lower edge, which false_color.h draws.
    void labelScale(std::string_view words) const;

    // For meshes that a stage makes: they live until the frame has run. For textures that it makes and that live
    // longer: explain knows of them. And a line for explain.
    const Mesh& keep(Mesh made) const;
    sampler2D samplerOf(const Texture& made) const;
    void note(std::string_view line) const;

    // The mesh, or, if it came without, the same with uv by longitude and latitude, or with tangents; made once.
    const Mesh& withUvs(const Mesh& mesh) const;
    const Mesh& withTangents(const Mesh& mesh) const;

private:
    Scene(const Scene& outer, Frame& frame, const Framebuffer& target, const glm::mat4& clipFromWorld);
    const Mesh& prepare(const Mesh& drawn, Fields vertexData, const float4x4* worldFromObject) const;
    Rectangle cellAt(int column, int columns, int row, int rows) const;
    void cut(const Viewport& viewport, const Rectangle& scissor) const;
    void leftOut(std::string_view name, const Object& object) const;
    glm::vec4 value(const Declaration& declaration) const override;
    sampler2D texture(TextureSlot slot, const char* file, const ImportSettings& settings) const override;
    const Environment* environment() const override;

    SceneLog& log;
    glm::mat4 clipFromWorld;
    glm::vec3 cameraPosition;
    const std::vector<Property>& properties;
    const LoadedInputs& inputs;
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

namespace detail {

// A program without uniforms is made of nothing.
template <class Program>
Program programOf(const Uniforms& uniforms)
{
    if constexpr (std::is_base_of_v<Uniforms, Program>)
        return uniforms;
    else
        return {};
}

}  // namespace detail

template <class VertexProgram, class FragmentProgram>
void Scene::draw(const Object& object, const RenderState& state) const
{
    const Uniforms its = uniforms(object.worldFromObject);
    draw(*object.mesh, detail::programOf<VertexProgram>(its), detail::programOf<FragmentProgram>(its), state);
}

template <class Light>
bool Scene::reaches(std::string_view name, const Light& source, const Object& object) const
{
    const bool reached = lightReaches(source, transformed(boundsOf(*object.mesh), object.worldFromObject));
    if (!reached) leftOut(name, object);
    return reached;
}

// Where the binormal is computed: the default is the CMake option RELIEF_BINORMAL_PER_FRAGMENT.
inline constexpr bool kBinormalPerFragment = RELIEF_BINORMAL_PER_FRAGMENT != 0;

}  // namespace relief::samples

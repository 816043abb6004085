// The benchmark scenes: each puts the weight on another part of the pipeline.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "common/render.h"
#include "relief/pipeline/frame.h"
#include "relief/texture/cube_map.h"
#include "relief/texture/texture.h"

namespace relief::benchmarks {

// One colour on every pixel, at one depth.
struct Layer
{
    float depth;
    glm::vec4 color;
};

// A mesh that a scene made, where it stands, and how often its uv go around.
struct Piece
{
    Mesh mesh;
    glm::mat4 worldFromObject{1.0f};
    float tiling = 1.0f;
};

// What is drawn before the picture, into a target whose attachments are textures of the picture's programs.
struct EarlierPass
{
    Framebuffer target;
    Frame frame;

    EarlierPass(Framebuffer created, int threads) : target(std::move(created)), frame(target, {.threads = threads}) {}
};

// What a scene's draws are made of, kept alive while frames run. Another rasterizer draws the same from it (twins.h).
struct SceneData
{
    Mesh mesh;
    std::optional<Texture> texture;
    int maxAnisotropy = 1;
    float tiling = 1.0f;
    glm::mat4 clipFromWorld{1.0f}, worldFromObject{1.0f};
    glm::vec3 lightDir{0.0f}, color{0.0f}, cameraPos{0.0f};
    std::vector<Layer> layers;

    // Of a scene of several objects, or passes (feature_scenes.h).
    std::vector<Piece> pieces;
    std::optional<Texture> albedo;
    std::optional<CubeMap> cubeMap;
    glm::mat4 lightFromWorld{1.0f};
    std::unique_ptr<EarlierPass> pass;

    // Of a stage, in place of all this: its inputs, and what its draw function gets.
    std::optional<samples::PreparedStage> stage;
    std::optional<samples::Scene> stageScene;

    // Why there is nothing to draw, where files or memory are missing; empty elsewhere.
    std::string problem;

    // What is drawn, and where it stands in the world; once, however many passes there are.
    std::vector<samples::Object> objects() const;

    // To be called before every frame.
    void runPasses();
};

struct BenchScene
{
    std::string name;
    std::string what;
    std::function<std::unique_ptr<SceneData>(Frame&, int width, int height)> record;
    int samples = 1;  // of a pixel of its target
};

const std::vector<BenchScene>& benchScenes();

// A target for such a scene: 8-bit colours, and a depth that is not kept.
Expected<Framebuffer> targetFor(const BenchScene& scene, int width, int height);

// 512 x 512 texels of noise and a grid, RGBA8.
Texture testTexture();

// What some of them are made of, for other sizes than theirs.

// How the plane's texture is fetched: from mip levels, up to `maxAnisotropy` times anisotropic, or bilinearly from its
// finest level alone.
struct PlaneFetch
{
    int maxAnisotropy = 1;
    bool finestLevel = false;
};

std::unique_ptr<SceneData> recordPlane(Frame& frame, int width, int height, Texture texture, PlaneFetch fetch);

// A height field of 2 * cellsX * cellsZ triangles.
std::unique_ptr<SceneData> recordTerrain(Frame& frame, int width, int height, int cellsX, int cellsZ);

// A stage, with settings as PreparedStage::prepare takes them.
std::unique_ptr<SceneData> recordStage(Frame& frame, int width, int height, const std::string& name,
                                       const std::vector<std::string>& settings = {});

}  // namespace relief::benchmarks

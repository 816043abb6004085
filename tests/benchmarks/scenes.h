// The benchmark scenes: each puts the weight on another part of the pipeline.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "common/render.h"
#include "pipeline/frame.h"
#include "texture/texture.h"

namespace relief::benchmarks {

// One colour on every pixel, at one depth.
struct Layer
{
    float depth;
    glm::vec4 color;
};

// What a scene's draws are made of, kept alive while frames run. Another rasterizer draws the same from it (twins.h).
struct SceneData
{
    Mesh mesh;
    std::optional<Texture> texture;
    int maxAnisotropy = 1;
    float tiling = 1.0f;
    glm::mat4 clipFromWorld{1.0f}, worldFromObject{1.0f};
    glm::vec3 lightDir{0.0f}, color{0.0f};
    std::vector<Layer> layers;

    // Of a stage, in place of all this: its inputs, and what its draw function gets.
    std::optional<samples::PreparedStage> stage;
    std::optional<samples::Scene> stageScene;

    // Why there is nothing to draw, where files are missing; empty elsewhere.
    std::string problem;

    // What is drawn, and where it stands in the world; once, however many passes there are.
    std::vector<samples::Object> objects() const;
};

struct BenchScene
{
    std::string name;
    std::string what;
    std::function<std::unique_ptr<SceneData>(Frame&, int width, int height)> record;
};

const std::vector<BenchScene>& benchScenes();

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

// The benchmark scenes: each puts the weight on another part of the pipeline.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/frame.h"

namespace relief::benchmarks {

// What a scene's draws refer to, kept alive while frames run.
struct SceneData
{
    virtual ~SceneData() = default;
};

struct BenchScene
{
    std::string name;
    std::string what;
    std::function<std::unique_ptr<SceneData>(Frame&, int width, int height)> record;
};

const std::vector<BenchScene>& benchScenes();

}  // namespace relief::benchmarks

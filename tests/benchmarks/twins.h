// The benchmark scenes as Mesa draws them: the meshes, textures, matrices and colours of scenes.h, with GLSL programs
// of the same formulae. Those of stages are in stage_twins.cpp.
#pragma once

#include <functional>

#include "mesa.h"
#include "scenes.h"

namespace relief::benchmarks {

// Draws the scene once, onto what is there.
using MesaDrawing = std::function<void()>;

struct Twin
{
    std::string scene;  // its name in benchScenes()
    // The drawing refers to `mesa`.
    std::function<Expected<MesaDrawing>(Mesa& mesa, const SceneData& data)> prepare;
};

const std::vector<Twin>& twins();

}  // namespace relief::benchmarks

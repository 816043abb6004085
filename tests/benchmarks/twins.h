// The benchmark scenes as Mesa draws them: the meshes, textures, matrices and colours of scenes.h, with GLSL programs
// of the same formulae. Those of stages are in stage_twins.cpp, those of feature_scenes.h in feature_twins.cpp.
#pragma once

#include <concepts>
#include <functional>

#include "mesa.h"
#include "scenes.h"

namespace relief::benchmarks {

struct MesaDrawing
{
    std::function<void()> picture;  // draws the scene once, onto what is there
    std::function<void()> passes;   // before that, and before the picture is cleared; may be empty

    template <std::invocable Picture>
    MesaDrawing(Picture draw, std::function<void()> before = {}) : picture(std::move(draw)), passes(std::move(before))
    {
    }
};

struct Twin
{
    std::string scene;  // its name in benchScenes() or featureScenes()
    // The drawing refers to `mesa`.
    std::function<Expected<MesaDrawing>(Mesa& mesa, const SceneData& data)> prepare;
};

const std::vector<Twin>& twins();

}  // namespace relief::benchmarks

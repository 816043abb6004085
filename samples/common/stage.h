// A stage: one step of a tutorial. Its file defines the programs and one function that returns this; the registry that
// CMake writes from samples/CMakeLists.txt lists them all.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/materials.h"
#include "common/scene.h"

namespace relief::samples {

struct Stage
{
    std::string title;
    std::string section;  // of the tutorial
    std::string news;     // what is new, in one line
    Declared uniforms;    // declared<MyVertexProgram, MyFragmentProgram>()
    std::string mesh;     // as in Inputs; empty: the stage draws a shape of its own
    float cubesTurnedBy = Inputs().cubesTurnedBy;
    Camera camera;
    std::function<void(const Scene&)> draw;

    // Filled in by the registry.
    std::string id;        // "1.06"
    std::string stem;      // "06_rotated_tangent"
    std::string folder;    // "bumpiness"
    std::string tutorial;  // "Rendering 6, Bumpiness (Catlike Coding)"

    // All that it reads from files.
    Inputs inputs() const
    {
        Inputs all = uniforms.inputs;
        all.mesh = mesh;
        all.cubesTurnedBy = cubesTurnedBy;
        return all;
    }
};

// All stages, in the order of the book. Built once.
const std::vector<Stage>& allStages();

// By number (1.06, also 1.6) or stem (06_rotated_tangent, rotated_tangent). An error names the nearest ones.
Expected<const Stage*> findStage(const std::string& name);

}  // namespace relief::samples

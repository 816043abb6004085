// A stage: one step of a tutorial. Its file defines the programs and one function that returns this; the registry that
// CMake writes from samples/CMakeLists.txt lists them all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/materials.h"
#include "common/scene.h"

namespace relief::samples {

struct Stage
{
    // What the file gives. Literals and functions: the compiler of a stage has little to do with them.
    std::string_view title;
    std::string_view section;  // of the tutorial
    std::string_view news;     // what is new, in one line
    UniformStructs uniforms;   // declared<MyVertexProgram, MyFragmentProgram>()
    std::string_view mesh;     // as in Inputs; empty: the stage draws a shape of its own
    float cubesTurnedBy = kCubesTurnedBy;
    Camera camera;
    void (*draw)(const Scene&) = nullptr;

    // Filled in by the registry.
    std::string id;        // "1.06"
    std::string stem;      // "06_rotated_tangent"
    std::string folder;    // "bumpiness"
    std::string tutorial;  // "Rendering 6, Bumpiness (Catlike Coding)"

    std::string name() const;  // "1.06 Rotated tangent"

    // What its programs declare, and all that it reads from files.
    std::vector<Property> properties() const;
    Inputs inputs() const;
};

// All stages, in the order of the book. Built once.
const std::vector<Stage>& allStages();

// By number (1.06, also 1.6) or stem (06_rotated_tangent, rotated_tangent). An error names the nearest ones.
Expected<const Stage*> findStage(const std::string& name);

}  // namespace relief::samples

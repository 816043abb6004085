// A stage: one step of a tutorial. Its file defines the programs and one function that returns this; the registry that
// CMake writes from samples/CMakeLists.txt lists them all.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/phong_properties.h"
#include "common/scene.h"
#include "common/triplanar_properties.h"

namespace relief::samples {

struct Stage
{
    std::string title;
    std::string section;  // of the tutorial
    std::string news;     // what is new, in one line
    std::vector<Property> properties;
    Inputs inputs;
    Camera camera;
    std::function<void(const Scene&)> draw;

    // Filled in by the registry.
    std::string id;        // "1.06"
    std::string stem;      // "06_rotated_tangent"
    std::string folder;    // "bumpiness"
    std::string tutorial;  // "Rendering 6, Bumpiness (Catlike Coding)"
};

// All stages, in the order of the book. Built once.
const std::vector<Stage>& allStages();

// By number (1.06, also 1.6) or stem (06_rotated_tangent, rotated_tangent). An error names the nearest ones.
Expected<const Stage*> findStage(const std::string& name);

}  // namespace relief::samples

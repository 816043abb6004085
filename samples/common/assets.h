// Where the samples' textures and shapes come from.
#pragma once

#include <string>

#include "relief/error.h"
#include "relief/mesh/mesh.h"

namespace relief::samples {

// The path of a file in assets/: in the source tree, or in $RELIEF_ASSETS where that is set. An error names the path
// that was tried.
Expected<std::string> assetPath(const std::string& name);

// "quad", "cube", "sphere", "low-sphere" or "terrain"; made once per process. Any other name gives a quad.
bool isPrimitive(const std::string& name);
const Mesh& primitive(const std::string& name);

// The mesh moved and scaled so that it fits the unit cube about the origin, as the primitives do.
Mesh fitted(Mesh mesh);

}  // namespace relief::samples

// Where the samples' textures and shapes come from.
#pragma once

#include <string>

#include "error.h"
#include "mesh/mesh.h"
#include "texture/texture.h"

namespace relief::samples {

// The path of a file in assets/: in the source tree, or in $RELIEF_ASSETS where that is set. An error names the path
// that was tried.
Expected<std::string> assetPath(const std::string& name);

Expected<Texture> loadTexture(const std::string& path, ColorSpace meaning);

// "quad", "cube", "sphere" or "terrain".
Mesh primitive(const std::string& name);

// The mesh moved and scaled so that it fits the unit cube about the origin, as the primitives do. A mesh without uv
// gets its picture projected from above: u along x, v along z.
Mesh fitted(Mesh mesh);

}  // namespace relief::samples

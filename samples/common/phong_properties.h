// The materials of the tutorials that light by Phong's model, under the names of their Properties blocks, with the
// light's two angles.
#pragma once

#include "common/scene.h"

namespace relief::samples {

// "Lighting of Bumpy Surfaces": without and with a highlight.
std::vector<Property> diffuseProperties(const std::vector<Property>& more = {});
std::vector<Property> phongProperties(const std::vector<Property>& more = {});

// "Normal Maps".
std::vector<Property> cgProperties(const std::vector<Property>& more = {});

}  // namespace relief::samples

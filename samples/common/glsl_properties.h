// The material of the OpenGL tutorials, under the names of their Properties blocks, and the light's two angles.
#pragma once

#include "common/scene.h"

namespace relief::samples {

std::vector<Property> diffuseProperties(const std::vector<Property>& more = {});

// With a highlight.
std::vector<Property> phongProperties(const std::vector<Property>& more = {});

}  // namespace relief::samples

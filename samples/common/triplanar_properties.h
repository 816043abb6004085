// What the stages of the triplanar chapter share.
#pragma once

#include "common/scene.h"

namespace relief::samples {

// The light's two angles and the light from everywhere, how often the texture repeats, how steep its bumps are.
std::vector<Property> triplanarProperties(const std::vector<Property>& more = {}, float lightYaw = -40.0f);

// Bricks, each with a letter cut into it, so that every turn and every mirroring of the picture shows.
Inputs bricks(const std::string& mesh);

}  // namespace relief::samples

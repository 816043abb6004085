// What surrounds the samples that mirror something, unless the user names a picture: a paved yard with eight pillars,
// each of a colour of its own, under a clear sky with a sun and a few clouds. Every direction can be told from every
// other one, and each edge of the cube map cuts through something straight. Traced here, no picture of anybody's.
#pragma once

#include <memory>

#include "common/read_environment.h"

namespace relief::samples {

// Made once per process.
std::shared_ptr<const Environment> courtyard();

// Its radiance in a direction of unit length, linear; the eye is one unit above the ground.
glm::vec3 courtyardRadiance(const glm::vec3& direction);

}  // namespace relief::samples

// A picture of what surrounds a scene, made ready (shading/environment.h).
#pragma once

#include <string>

#include "relief/error.h"
#include "relief/shading/environment.h"

namespace relief::samples {

struct Environment
{
    CubeMap radiance;               // as the picture has it
    CubeMap mirrored;               // by roughness
    SphericalHarmonics irradiance;  // for matte surfaces
};

// From a file that `import-environment` wrote, or any picture that it takes; such a one is prefiltered here, with fewer
// samples. `threads`: 0 for one per processor.
Expected<Environment> readEnvironment(const std::string& path, int threads);

}  // namespace relief::samples

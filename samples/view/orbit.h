// A camera that is moved by hand.
#pragma once

#include "common/camera.h"

namespace relief::samples {

// Around what it looks at, by degrees: never straight above or below.
Camera orbited(const Camera& camera, float yaw, float pitch);

// To `factor` times its distance, within 0.1 and 50.
Camera zoomed(const Camera& camera, float factor);

// With what it looks at, to its right and upwards; 1 is the height of the picture there.
Camera moved(const Camera& camera, float right, float up);

}  // namespace relief::samples

// The camera of a stage, and the matrices that it stands for (engine/relief/shading/camera.h).
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "relief/shading/camera.h"

namespace relief::samples {

inline constexpr float kDegree = 0.0174532925f;  // radians

// Left-handed, Y up; looks from `position` at `target`.
struct Camera
{
    glm::vec3 position{0.0f, 0.0f, -1.5f};
    glm::vec3 target{0.0f};
    float fieldOfView = 40.0f;  // vertical, degrees
    float nearPlane = 0.05f, farPlane = 100.0f;
};

inline glm::mat4 viewFromWorld(const Camera& camera)
{
    return lookAt(camera.position, camera.target);
}

// Depth 0 at the near plane, 1 at the far plane. aspect = width / height.
inline glm::mat4 clipFromView(const Camera& camera, float aspect)
{
    return perspective(camera.fieldOfView, aspect, camera.nearPlane, camera.farPlane);
}

using relief::rotationX;
using relief::rotationY;
using relief::scaling;
using relief::translation;

}  // namespace relief::samples

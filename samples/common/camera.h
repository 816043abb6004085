// The camera and the matrices on the CPU side: plain floats, exact operations only (the engine's own sine and cosine),
// so that every machine gets the same matrices.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

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

glm::mat4 viewFromWorld(const Camera& camera);

// Depth 0 at the near plane, 1 at the far plane. aspect = width / height.
glm::mat4 clipFromView(const Camera& camera, float aspect);

// Turns by an angle in degrees about one axis: left-handed, positive as Unity's inspector shows it.
glm::mat4 rotationX(float degrees);
glm::mat4 rotationY(float degrees);
glm::mat4 translation(const glm::vec3& offset);
glm::mat4 scaling(const glm::vec3& factors);

}  // namespace relief::samples

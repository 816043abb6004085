#include "view/orbit.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relief::samples {

namespace {

struct Angles
{
    float yaw, pitch, distance;
};

Angles anglesOf(const Camera& camera)
{
    const glm::vec3 d = camera.position - camera.target;
    const float distance = glm::length(d);
    return {std::atan2(-d.x, -d.z) / kDegree, std::asin(std::clamp(d.y / distance, -1.0f, 1.0f)) / kDegree, distance};
}

Camera at(Camera camera, const Angles& angles)
{
    const glm::vec4 offset =
        rotationY(angles.yaw) * (rotationX(angles.pitch) * glm::vec4(0.0f, 0.0f, -angles.distance, 0.0f));
    camera.position = camera.target + glm::vec3(offset);
    return camera;
}

}  // namespace

Camera orbited(const Camera& camera, float yaw, float pitch)
{
    Angles angles = anglesOf(camera);
    angles.yaw += yaw;
    angles.pitch = std::clamp(angles.pitch + pitch, -89.0f, 89.0f);
    return at(camera, angles);
}

Camera zoomed(const Camera& camera, float factor)
{
    Angles angles = anglesOf(camera);
    angles.distance = std::clamp(angles.distance * factor, 0.1f, 50.0f);
    return at(camera, angles);
}

Camera moved(const Camera& camera, float right, float up)
{
    const Angles angles = anglesOf(camera);
    const float height = 2.0f * angles.distance * std::tan(camera.fieldOfView * kDegree / 2.0f);
    const glm::vec4 offset = rotationY(angles.yaw) * (rotationX(angles.pitch) * glm::vec4(right, up, 0.0f, 0.0f));
    Camera result = camera;
    result.position += height * glm::vec3(offset);
    result.target += height * glm::vec3(offset);
    return result;
}

}  // namespace relief::samples

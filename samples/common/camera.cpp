#include "common/camera.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "lanes/math.h"

namespace relief::samples {

glm::mat4 viewFromWorld(const Camera& camera)
{
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const bool vertical = std::abs(forward.y) > 0.9999f;
    const glm::vec3 right = glm::normalize(glm::cross(vertical ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0), forward));
    const glm::vec3 up = glm::cross(forward, right);
    const glm::vec3& p = camera.position;
    return {{right.x, up.x, forward.x, 0.0f},
            {right.y, up.y, forward.y, 0.0f},
            {right.z, up.z, forward.z, 0.0f},
            {-glm::dot(right, p), -glm::dot(up, p), -glm::dot(forward, p), 1.0f}};
}

glm::mat4 clipFromView(const Camera& camera, float aspect)
{
    const float half = camera.fieldOfView * 0.5f * kDegree;
    const float zoom = cos(half) / sin(half);
    const float depth = camera.farPlane / (camera.farPlane - camera.nearPlane);
    return {{zoom / aspect, 0, 0, 0}, {0, zoom, 0, 0}, {0, 0, depth, 1}, {0, 0, -depth * camera.nearPlane, 0}};
}

glm::mat4 rotationX(float degrees)
{
    const float c = cos(degrees * kDegree), s = sin(degrees * kDegree);
    return {{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {0, 0, 0, 1}};
}

glm::mat4 rotationY(float degrees)
{
    const float c = cos(degrees * kDegree), s = sin(degrees * kDegree);
    return {{c, 0, -s, 0}, {0, 1, 0, 0}, {s, 0, c, 0}, {0, 0, 0, 1}};
}

glm::mat4 translation(const glm::vec3& t)
{
    return {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {t.x, t.y, t.z, 1}};
}

glm::mat4 scaling(const glm::vec3& f)
{
    return {{f.x, 0, 0, 0}, {0, f.y, 0, 0}, {0, 0, f.z, 0}, {0, 0, 0, 1}};
}

}  // namespace relief::samples

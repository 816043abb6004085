#include "relief/shading/camera.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "relief/lanes/environment.h"
#include "relief/lanes/math.h"
#include "relief/texture/cube_face.h"

namespace relief {

namespace {

constexpr float kDegree = 0.0174532925f;  // radians

// x and y of a projection: z, and what is added to it, are the rows' business that differ.
glm::mat4 projection(float fieldOfView, float aspect, float depth, float offset)
{
    const float half = fieldOfView * 0.5f * kDegree;
    const float zoom = cos(half) / sin(half);
    return {{zoom / aspect, 0, 0, 0}, {0, zoom, 0, 0}, {0, 0, depth, 1}, {0, 0, offset, 0}};
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

glm::mat4 lookAt(const glm::vec3& position, const glm::vec3& target, const glm::vec3& up)
{
    const DefaultFloatingPoint environment;
    return lookAlong(position, target - position, up);
}

glm::mat4 lookAlong(const glm::vec3& position, const glm::vec3& direction, const glm::vec3& up)
{
    const DefaultFloatingPoint environment;
    const glm::vec3 forward = glm::normalize(direction);
    const glm::vec3 other = std::abs(up.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const bool alongUp = std::abs(glm::dot(forward, up)) > 0.9999f;
    const glm::vec3 right = glm::normalize(glm::cross(alongUp ? other : up, forward));
    const glm::vec3 upward = glm::cross(forward, right);
    return {{right.x, upward.x, forward.x, 0.0f},
            {right.y, upward.y, forward.y, 0.0f},
            {right.z, upward.z, forward.z, 0.0f},
            {-glm::dot(right, position), -glm::dot(upward, position), -glm::dot(forward, position), 1.0f}};
}

glm::mat4 lookThroughFace(const glm::vec3& position, int face)
{
    const CubeFaceAxes& axes = kCubeFaceAxes[static_cast<std::size_t>(face)];
    return lookAlong(position, glm::vec3(axes.middle), glm::vec3(axes.up));
}

glm::mat4 perspective(float fieldOfView, float aspect, float nearPlane, float farPlane)
{
    const DefaultFloatingPoint environment;
    const float depth = farPlane == kInfinity ? 1.0f : farPlane / (farPlane - nearPlane);
    return projection(fieldOfView, aspect, depth, -depth * nearPlane);
}

glm::mat4 perspectiveReversed(float fieldOfView, float aspect, float nearPlane, float farPlane)
{
    const DefaultFloatingPoint environment;
    const float depth = farPlane == kInfinity ? 0.0f : -nearPlane / (farPlane - nearPlane);
    const float offset = farPlane == kInfinity ? nearPlane : -depth * farPlane;
    return projection(fieldOfView, aspect, depth, offset);
}

glm::mat4 orthographic(float width, float height, float nearPlane, float farPlane)
{
    const DefaultFloatingPoint environment;
    const float depth = 1.0f / (farPlane - nearPlane);
    return {{2.0f / width, 0, 0, 0}, {0, 2.0f / height, 0, 0}, {0, 0, depth, 0}, {0, 0, -depth * nearPlane, 1}};
}

glm::mat4 rotationX(float degrees)
{
    const DefaultFloatingPoint environment;
    const float c = cos(degrees * kDegree), s = sin(degrees * kDegree);
    return {{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {0, 0, 0, 1}};
}

glm::mat4 rotationY(float degrees)
{
    const DefaultFloatingPoint environment;
    const float c = cos(degrees * kDegree), s = sin(degrees * kDegree);
    return {{c, 0, -s, 0}, {0, 1, 0, 0}, {s, 0, c, 0}, {0, 0, 0, 1}};
}

glm::mat4 rotationZ(float degrees)
{
    const DefaultFloatingPoint environment;
    const float c = cos(degrees * kDegree), s = sin(degrees * kDegree);
    return {{c, s, 0, 0}, {-s, c, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
}

glm::mat4 translation(const glm::vec3& t)
{
    return {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {t.x, t.y, t.z, 1}};
}

glm::mat4 scaling(const glm::vec3& f)
{
    return {{f.x, 0, 0, 0}, {0, f.y, 0, 0}, {0, 0, f.z, 0}, {0, 0, 0, 1}};
}

}  // namespace relief

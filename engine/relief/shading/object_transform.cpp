#include "relief/shading/object_transform.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "relief/lanes/environment.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

// Times a power of two, where a product of four of its numbers might leave the range of floats.
glm::mat3 moderate(glm::mat3 m)
{
    float largest = 0.0f;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::fabs(m[i / 3][i % 3]));
    if (!std::isfinite(largest)) return m;
    int exponent = 0;
    std::frexp(largest, &exponent);
    if (std::abs(exponent) <= 30) return m;
    for (int i = 0; i < 9; ++i) m[i / 3][i % 3] = std::ldexp(m[i / 3][i % 3], -exponent);
    return m;
}

float determinantSign(const glm::mat3& m)
{
    return glm::dot(m[0], glm::cross(m[1], m[2])) < 0.0f ? -1.0f : 1.0f;
}

}  // namespace

float mirrorSign(const glm::mat4& m)
{
    return determinantSign(moderate(glm::mat3(m)));
}

glm::mat3 normalMatrix(const glm::mat3& matrix)
{
    const glm::mat3 m = moderate(matrix);
    const float sign = determinantSign(m);
    return {glm::cross(m[1], m[2]) * sign, glm::cross(m[2], m[0]) * sign, glm::cross(m[0], m[1]) * sign};
}

ObjectTransform::ObjectTransform(const glm::mat4& clipFromWorld, const glm::mat4& world)
{
    const DefaultFloatingPoint environment;
    clipFromObject = broadcast(clipFromWorld * world);
    worldFromObject = broadcast(world);
    normalFromObject = broadcast(normalMatrix(glm::mat3(world)));
    unity_WorldTransformParams = float4(0.0f, 0.0f, 0.0f, mirrorSign(world));
}

}  // namespace relief::inline RELIEF_WIDTH

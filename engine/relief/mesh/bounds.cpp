#include "relief/mesh/bounds.h"

#include <algorithm>
#include <cmath>

#include "relief/lanes/environment.h"
#include "relief/lanes/settled.h"

namespace relief {

glm::vec3 Bounds::centre() const
{
    const DefaultFloatingPoint environment;
    return settled(low * 0.5f + high * 0.5f);
}

float Bounds::radius() const
{
    const DefaultFloatingPoint environment;
    glm::vec3 half = high * 0.5f - low * 0.5f;
    // By a power of two to about 1, or squares would leave the range of floats.
    const float longest = std::max({half.x, half.y, half.z});
    int exponent = 0;
    if (std::isfinite(longest)) std::frexp(longest, &exponent);
    for (int i = 0; i < 3; ++i) half[i] = std::ldexp(half[i], -exponent);
    return settled(std::ldexp(std::sqrt(half.x * half.x + half.y * half.y + half.z * half.z), exponent));
}

float Bounds::squaredDistance(const glm::vec3& point) const
{
    const DefaultFloatingPoint environment;
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) {
        const float outside = std::max({low[i] - point[i], point[i] - high[i], 0.0f});
        sum += outside * outside;
    }
    return settled(sum);
}

Bounds boundsOf(const Mesh& mesh)
{
    if (mesh.positions.empty()) return {};
    Bounds bounds = {mesh.positions[0], mesh.positions[0]};
    for (const glm::vec3& p : mesh.positions) {
        for (int i = 0; i < 3; ++i) {
            bounds.low[i] = std::min(bounds.low[i], p[i]);
            bounds.high[i] = std::max(bounds.high[i], p[i]);
        }
    }
    return bounds;
}

Bounds transformed(const Bounds& bounds, const glm::mat4& matrix)
{
    const DefaultFloatingPoint environment;
    Bounds moved;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 p = {(corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                             (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                             (corner & 4) != 0 ? bounds.high.z : bounds.low.z, 1.0f};
        for (int i = 0; i < 3; ++i) {
            const float v = matrix[0][i] * p.x + matrix[1][i] * p.y + matrix[2][i] * p.z + matrix[3][i];
            moved.low[i] = corner == 0 ? v : std::min(moved.low[i], v);
            moved.high[i] = corner == 0 ? v : std::max(moved.high[i], v);
        }
    }
    return moved;
}

}  // namespace relief

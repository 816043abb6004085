// Which texels of a picture a triangle covers by its uvs, and with which weights. In: three uvs, (0,0) the picture's
// lower left. Out: columns, rows from the top, as pictures are stored, and barycentric weights in double.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "relief/mesh/mesh.h"

namespace relief {

// uvs beyond this are refused by those who bake: a picture is one period, and its islands belong into it.
inline constexpr float kLargestBakedUv = 16.0f;

namespace texels {

// Twice the area of a, b, c. The ends are taken in a fixed order, so that the triangles on both sides of an edge get
// the same number with opposite signs: rounding leaves no gap between them.
inline double edgeFunction(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    if (b.x < a.x || (b.x == a.x && b.y < a.y)) return -edgeFunction(b, a, c);
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

inline int wrapped(int i, int size)
{
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

}  // namespace texels

// Of the corners of a triangle. The mesh must be valid and have uvs.
inline std::array<glm::vec2, 3> uvsOf(const Mesh& mesh, std::size_t triangle)
{
    const std::uint32_t* const of = &mesh.indices[3 * triangle];
    return {mesh.uvs[of[0]], mesh.uvs[of[1]], mesh.uvs[of[2]]};
}

// Calls visit(x, y, weights) for each texel whose centre lies in the triangle or on its border: x from the left, y from
// the top, and weights, an std::array<double, 3> that is at least 0 and adds up to 1, of the three corners. uvs outside
// 0..1 wrap around, so that a triangle that is larger than the picture comes to a texel more than once. From bottom to
// top, left to right. A triangle without area covers nothing. uvs must be within +-kLargestBakedUv, sides in 1..16384.
template <class Visit>
void visitTexels(const std::array<glm::vec2, 3>& uvs, int width, int height, const Visit& visit)
{
    const glm::dvec2 size(width, height);
    const glm::dvec2 a = glm::dvec2(uvs[0]) * size, b = glm::dvec2(uvs[1]) * size, c = glm::dvec2(uvs[2]) * size;
    const auto first = [](double p, double q, double r) { return std::ceil(std::fmin(std::fmin(p, q), r) - 0.5); };
    const auto last = [](double p, double q, double r) { return std::floor(std::fmax(std::fmax(p, q), r) - 0.5); };
    const int endX = static_cast<int>(last(a.x, b.x, c.x)), endY = static_cast<int>(last(a.y, b.y, c.y));

    for (int y = static_cast<int>(first(a.y, b.y, c.y)); y <= endY; ++y) {
        for (int x = static_cast<int>(first(a.x, b.x, c.x)); x <= endX; ++x) {
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            const double e0 = texels::edgeFunction(b, c, centre);
            const double e1 = texels::edgeFunction(c, a, centre);
            const double e2 = texels::edgeFunction(a, b, centre);
            const bool isInside = (e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0);
            const double sum = e0 + e1 + e2;
            if (!isInside || sum == 0) continue;
            const std::array<double, 3> weights = {e0 / sum, e1 / sum, e2 / sum};
            visit(texels::wrapped(x, width), height - 1 - texels::wrapped(y, height), weights);
        }
    }
}

}  // namespace relief

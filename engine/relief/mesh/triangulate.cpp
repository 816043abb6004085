// Ear clipping (G. H. Meisters, "Polygons have ears", 1975): cut off, again and again, a corner whose triangle lies
// inside the polygon and holds no other corner. In double precision, on the polygon seen from its front.
#include "relief/mesh/triangulate.h"

#include <cmath>
#include <cstddef>

#include <glm/vec2.hpp>

#include "relief/lanes/environment.h"

namespace relief {
namespace {

// Twice the area of a, b, c; positive where they turn counter-clockwise.
double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Drops the axis along which the polygon is thinnest, and mirrors the rest if need be so that the polygon turns
// counter-clockwise. Its normal is Newell's: the sum of the edges' cross products, good for concave polygons too.
std::vector<glm::dvec2> flatten(std::span<const glm::vec3> corners)
{
    glm::dvec3 normal(0);
    const glm::dvec3 origin = corners[0];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::dvec3(corners[i]) - origin;
        const glm::dvec3 b = glm::dvec3(corners[(i + 1) % corners.size()]) - origin;
        normal += glm::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    }
    const glm::dvec3 size(std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z));
    const int dropped = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int right = (dropped + 1) % 3;
    const int up = (dropped + 2) % 3;
    const double mirror = normal[dropped] < 0 ? -1.0 : 1.0;

    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        const glm::dvec3 p = glm::dvec3(corner) - origin;
        flat.emplace_back(p[right] * mirror, p[up]);
    }
    return flat;
}

// Whether the corner at `place` of the remaining ones can be cut off. A corner at the same point as one of the ear's
// own does not count as inside: polygons with holes visit such points twice.
bool isEar(const std::vector<glm::dvec2>& flat, const std::vector<std::uint32_t>& remaining, std::size_t place)
{
    const std::size_t count = remaining.size();
    const glm::dvec2 a = flat[remaining[(place + count - 1) % count]];
    const glm::dvec2 b = flat[remaining[place]];
    const glm::dvec2 c = flat[remaining[(place + 1) % count]];
    if (turn(a, b, c) <= 0) return false;
    for (const std::uint32_t other : remaining) {
        const glm::dvec2 p = flat[other];
        if (p == a || p == b || p == c) continue;
        if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::vec3> corners)
{
    const DefaultFloatingPoint environment;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    if (corners.size() < 3) return triangles;
    triangles.reserve(corners.size() - 2);

    const std::vector<glm::dvec2> flat = flatten(corners);
    std::vector<std::uint32_t> remaining(corners.size());
    for (std::uint32_t i = 0; i < corners.size(); ++i) remaining[i] = i;
    while (remaining.size() > 3) {
        // Starting at place 1 makes the fan of a convex polygon, and is the way out where there is no ear at all.
        std::size_t place = 1;
        while (place < remaining.size() && !isEar(flat, remaining, place)) ++place;
        if (place == remaining.size()) place = 1;
        triangles.push_back({remaining[place - 1], remaining[place], remaining[(place + 1) % remaining.size()]});
        remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(place));
    }
    triangles.push_back({remaining[0], remaining[1], remaining[2]});
    return triangles;
}

}  // namespace relief

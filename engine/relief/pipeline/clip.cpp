#include "relief/pipeline/clip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "relief/pipeline/limits.h"
#include "relief/pipeline/viewport_transform.h"

namespace relief::inline RELIEF_WIDTH {

namespace {

enum class Plane
{
    smallW,
    near,
    far,
    left,
    right,
    bottom,
    top,
    own  // and those after it: the vertex program's
};

// Signed distance to a plane, positive inside. In double: a product of two floats is exact there, so the sign is right.
double distance(Plane plane, const ClipVertex& vertex, const ClipLimits& limits)
{
    const glm::vec4& p = vertex.position;
    switch (plane) {
        case Plane::smallW:
            return static_cast<double>(p.w) - static_cast<double>(kSmallestW);
        case Plane::near:
            return p.z;
        case Plane::far:
            return static_cast<double>(p.w) - static_cast<double>(p.z);
        case Plane::left:
            return static_cast<double>(p.w) + static_cast<double>(p.x) * limits.inverseGuardX;
        case Plane::right:
            return static_cast<double>(p.w) - static_cast<double>(p.x) * limits.inverseGuardX;
        case Plane::bottom:
            return static_cast<double>(p.w) + static_cast<double>(p.y) * limits.inverseGuardY;
        case Plane::top:
            return static_cast<double>(p.w) - static_cast<double>(p.y) * limits.inverseGuardY;
        default:
            break;
    }
    const float(&corner)[3] = limits.distance[static_cast<int>(plane) - static_cast<int>(Plane::own)];
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += static_cast<double>(vertex.weight[k]) * static_cast<double>(corner[k]);
    return sum;
}

// a + t (b - a), rounded once, and never beyond the two ends.
float between(float a, float b, double t)
{
    const double value = static_cast<double>(a) + t * (static_cast<double>(b) - static_cast<double>(a));
    return std::clamp(static_cast<float>(value), std::min(a, b), std::max(a, b));
}

// The coordinate that lies on the plane, from the plane's own equation. Between two ends that are 1e30 apart, on either
// side of the screen, no t is fine enough to hit the plane.
void putOnPlane(Plane plane, const ClipLimits& limits, const glm::vec4& a, const glm::vec4& b, glm::vec4& p)
{
    const auto put = [&](int i, float value) { p[i] = std::clamp(value, std::min(a[i], b[i]), std::max(a[i], b[i])); };
    switch (plane) {
        case Plane::smallW:
            return put(3, kSmallestW);
        case Plane::near:
            return put(2, 0.0f);
        case Plane::far:
            return put(2, p.w);
        case Plane::left:
            return put(0, -p.w / limits.inverseGuardX);
        case Plane::right:
            return put(0, p.w / limits.inverseGuardX);
        case Plane::bottom:
            return put(1, -p.w / limits.inverseGuardY);
        case Plane::top:
            return put(1, p.w / limits.inverseGuardY);
        default:
            return;
    }
}

// The point where the edge leaves the plane; t is in [0, 1] because the distances have strictly different signs.
ClipVertex cut(Plane plane, const ClipLimits& limits, const ClipVertex& inside, double insideDistance,
               const ClipVertex& outside, double outsideDistance)
{
    const double t = std::clamp(insideDistance / (insideDistance - outsideDistance), 0.0, 1.0);
    ClipVertex v;
    for (int i = 0; i < 4; ++i) v.position[i] = between(inside.position[i], outside.position[i], t);
    for (int k = 0; k < 3; ++k) v.weight[k] = between(inside.weight[k], outside.weight[k], t);
    putOnPlane(plane, limits, inside.position, outside.position, v.position);
    // On screen the two ends lie w times farther from each other. An end behind the eye has a negative w, and the
    // screen's line goes on beyond the other end.
    const double s = t * static_cast<double>(outside.position.w) / static_cast<double>(v.position.w);
    for (int k = 0; k < 3; ++k) v.onScreen[k] = inside.onScreen[k] + s * (outside.onScreen[k] - inside.onScreen[k]);
    return v;
}

// The planes' numbers are 0 ... planeCount() - 1.
int planeCount(const ClipLimits& limits)
{
    return static_cast<int>(Plane::own) + limits.distanceCount;
}

bool isLeftOut(Plane plane, const ClipLimits& limits)
{
    return !limits.depthClip && (plane == Plane::near || plane == Plane::far);
}

// What a new vertex has between the corners' values: from the corner that it is nearest to, and towards the others.
float mixed(const ClipVertex& vertex, const float (&corner)[3], Interpolation interpolation)
{
    if (interpolation == Interpolation::flat) return corner[0];
    const auto nearest = std::max_element(vertex.weight, vertex.weight + 3) - vertex.weight;
    const std::ptrdiff_t b = (nearest + 1) % 3, c = (nearest + 2) % 3;
    const float from = corner[nearest];
    if (interpolation != Interpolation::affine)
        return from + vertex.weight[b] * (corner[b] - from) + vertex.weight[c] * (corner[c] - from);
    const auto part = [&](std::ptrdiff_t k) { return vertex.onScreen[k] * (static_cast<double>(corner[k]) - from); };
    constexpr double largest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(from + part(b) + part(c), -largest, largest));
}

}  // namespace

ClipLimits clipLimits(const DrawGeometry& draw, const std::array<std::uint32_t, 3>& corners)
{
    const ViewportTransform transform(draw.viewport);
    ClipLimits limits = {transform.inverseGuardX, transform.inverseGuardY, draw.depthClip};
    limits.distanceCount = draw.clipDistanceCount;
    constexpr float largest = std::numeric_limits<float>::max();
    for (int i = 0; i < limits.distanceCount; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const float d = draw.components[corners[k] * std::size_t{draw.componentStride} +
                                            draw.clipDistances[static_cast<std::size_t>(i)]];
            limits.distance[i][k] = std::isnan(d) ? -largest : std::clamp(d, -largest, largest);
        }
    }
    return limits;
}

int clipTriangle(const glm::vec4 corners[3], const ClipLimits& limits, std::span<ClipVertex, kMaxClippedVertices> out)
{
    ClipVertex buffers[2][kMaxClippedVertices];
    ClipVertex* polygon = buffers[0];
    ClipVertex* next = buffers[1];
    for (int k = 0; k < 3; ++k) {
        polygon[k] = {corners[k], {0.0f, 0.0f, 0.0f}, {0.0, 0.0, 0.0}};
        polygon[k].weight[k] = 1.0f;
        polygon[k].onScreen[k] = 1.0;
    }

    int count = 3;
    for (int p = 0; p < planeCount(limits); ++p) {
        const auto plane = static_cast<Plane>(p);
        if (isLeftOut(plane, limits)) continue;
        int kept = 0;
        const auto keep = [&](const ClipVertex& v) {
            if (kept < kMaxClippedVertices) next[kept++] = v;
        };
        for (int i = 0; i < count; ++i) {
            const ClipVertex& a = polygon[i];
            const ClipVertex& b = polygon[(i + 1) % count];
            const double da = distance(plane, a, limits), db = distance(plane, b, limits);
            if (da >= 0.0) keep(a);
            if (da > 0.0 && db < 0.0) keep(cut(plane, limits, a, da, b, db));
            if (da < 0.0 && db > 0.0) keep(cut(plane, limits, b, db, a, da));
        }
        std::swap(polygon, next);
        count = kept;
        if (count < 3) return 0;
    }
    std::copy_n(polygon, count, out.begin());
    return count;
}

bool clipLine(const glm::vec4 ends[2], const ClipLimits& limits, ClipVertex out[2])
{
    out[0] = {ends[0], {1.0f, 0.0f, 0.0f}, {1.0, 0.0, 0.0}};
    out[1] = {ends[1], {0.0f, 1.0f, 0.0f}, {0.0, 1.0, 0.0}};
    for (int p = 0; p < planeCount(limits); ++p) {
        const auto plane = static_cast<Plane>(p);
        if (isLeftOut(plane, limits)) continue;
        const double d0 = distance(plane, out[0], limits), d1 = distance(plane, out[1], limits);
        if (d0 < 0.0 && d1 < 0.0) return false;
        // An end on the plane and the other outside leaves a point: both ends are then the same, and cover nothing.
        if (d1 < 0.0) out[1] = d0 > 0.0 ? cut(plane, limits, out[0], d0, out[1], d1) : out[0];
        if (d0 < 0.0) out[0] = d1 > 0.0 ? cut(plane, limits, out[1], d1, out[0], d0) : out[1];
    }
    return true;
}

std::uint32_t clippedVertex(const DrawGeometry& draw, const std::array<std::uint32_t, 3>& corners,
                            const ClipVertex& vertex, TriangleChunk& chunk)
{
    const std::size_t first = chunk.clippedComponents.size();
    for (std::uint32_t c = 0; c < draw.componentCount; ++c) {
        float corner[3];
        for (std::size_t k = 0; k < 3; ++k) corner[k] = componentsOf(draw, chunk, corners[k])[c];
        chunk.clippedComponents.push_back(mixed(vertex, corner, draw.interpolations[c]));
    }
    return kClippedVertex | static_cast<std::uint32_t>(first);
}

}  // namespace relief::inline RELIEF_WIDTH

#include "agreement.h"

#include <algorithm>
#include <cstdlib>

#include <glm/geometric.hpp>

namespace relief::benchmarks {

namespace {

// Where a vertex lies on screen, in pixels; nothing if it lies behind the eye.
std::optional<glm::dvec2> onScreen(const glm::dmat4& clipFromObject, const glm::vec3& position, glm::dvec2 size)
{
    const glm::dvec4 clip = clipFromObject * glm::dvec4(position, 1.0);
    if (clip.w <= 0.0) return {};
    return glm::dvec2(clip.x / clip.w + 1.0, 1.0 - clip.y / clip.w) * 0.5 * size;
}

double distanceToLine(glm::dvec2 point, glm::dvec2 a, glm::dvec2 b)
{
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double part = square > 0.0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(point - a - along * part);
}

bool isNearEdge(const SceneData& scene, glm::dvec2 size, glm::dvec2 pixelCentre, int samples)
{
    const SamplePattern& pattern = *samplePattern(samples);
    const auto isNear = [&](const samples::Object& object) {
        const glm::dmat4 clipFromObject = scene.clipFromWorld * object.worldFromObject;
        const Mesh& mesh = *object.mesh;
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
            const auto a = onScreen(clipFromObject, mesh.positions[mesh.indices[i]], size);
            const auto b = onScreen(clipFromObject, mesh.positions[mesh.indices[next]], size);
            if (!a || !b) continue;
            for (int sample = 0; sample < samples; ++sample) {
                const auto& [x, y] = pattern.position[static_cast<std::size_t>(sample)];
                if (distanceToLine(pixelCentre + glm::dvec2(x, y) / 256.0, *a, *b) <= 1.0 / 256.0) return true;
            }
        }
        return false;
    };
    const std::vector<samples::Object> objects = scene.objects();
    return std::any_of(objects.begin(), objects.end(), isNear);
}

}  // namespace

Agreement agreement(const SceneData& scene, int width, int height, int samples, std::span<const std::uint32_t> ours,
                    std::span<const std::uint32_t> theirs)
{
    Agreement result;
    result.pixels = ours.size();
    const auto columns = static_cast<std::size_t>(width);
    for (std::size_t i = 0; i < ours.size(); ++i) {
        if ((ours[i] >> 24 == 0) != (theirs[i] >> 24 == 0)) {
            const glm::dvec2 centre(static_cast<double>(i % columns) + 0.5, static_cast<double>(i / columns) + 0.5);
            ++result.coverageDiffers;
            result.awayFromEdges += !isNearEdge(scene, {width, height}, centre, samples);
        }
        int difference = 0;
        for (int shift = 0; shift < 24; shift += 8) {
            const int a = static_cast<int>(ours[i] >> shift & 255), b = static_cast<int>(theirs[i] >> shift & 255);
            difference = std::max(difference, std::abs(a - b));
        }
        result.close += difference <= 1;
        result.largest = std::max(result.largest, difference);
    }
    return result;
}

}  // namespace relief::benchmarks

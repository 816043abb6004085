// Measuring a baked map: the mesh's triangles visit their texels as they did when they were baked.
#include "relief/mesh/bake_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "relief/lanes/environment.h"
#include "relief/lanes/math.h"
#include "relief/mesh/texels.h"

namespace relief {
namespace {

double angleBetween(const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 difference = a - b, sum = a + b;
    const float half = atan2(static_cast<float>(std::sqrt(glm::dot(difference, difference))),
                             static_cast<float>(std::sqrt(glm::dot(sum, sum))));
    constexpr double kDegrees = 57.295779513082321;  // 180 / pi
    return 2.0 * static_cast<double>(half) * kDegrees;
}

Expected<void> checkMesh(const BakedNormalMap& map, const Mesh& mesh)
{
    if (const Expected<void> valid = validate(mesh); !valid) return valid;
    const bool hasStreams = !mesh.uvs.empty() && !mesh.tangents.empty();
    const bool hasSmallUvs = std::all_of(mesh.uvs.begin(), mesh.uvs.end(), [](glm::vec2 uv) {
        return std::fabs(uv.x) <= kLargestBakedUv && std::fabs(uv.y) <= kLargestBakedUv;
    });
    if (map.hits == 0 || (hasStreams && hasSmallUvs)) return {};
    return fail("mesh '" + mesh.name +
                "': no map was baked for it, without uvs in the picture and tangents; give the baked mesh");
}

}  // namespace

Expected<AngleError> bakeError(const BakedNormalMap& map, const Mesh& mesh, const DecodeOptions& options)
{
    const DefaultFloatingPoint environment;
    if (const Expected<void> usable = checkMesh(map, mesh); !usable) return tl::unexpected(usable.error());
    AngleError error;
    if (map.hits == 0) return error;
    double sum = 0;
    std::vector<bool> isMeasured(map.normals.size(), false);
    for (std::size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
        const std::array<FrameCorner, 3> corners = frameCorners(mesh, triangle);
        visitTexels(uvsOf(mesh, triangle), map.width, map.height, [&](int x, int y, const auto& weights) {
            const std::size_t texel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
            if (map.triangles[texel] != triangle || map.states[texel] != TexelState::hit || isMeasured[texel]) return;
            isMeasured[texel] = true;
            TangentFrame frame = frameAt(corners, weights, options.binormal);
            if (options.orthonormalise) frame = orthonormal(frame);
            const glm::dvec3 shaded = decoded(glm::dvec3(map.normals[texel]), frame);
            const double angle = angleBetween(shaded, unitOrZero(glm::dvec3(map.detailNormals[texel])));
            sum += angle;
            error.max = std::max(error.max, angle);
            ++error.texels;
        });
    }
    if (error.texels != map.hits) {
        return fail("mesh '" + mesh.name + "': covers " + std::to_string(error.texels) + " of the map's " +
                    std::to_string(map.hits) + " baked texels; give the mesh that it was baked for");
    }
    error.mean = sum / static_cast<double>(error.texels);
    return error;
}

}  // namespace relief

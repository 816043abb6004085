// Baking: every triangle paints its texels, then the islands are continued.
#include "relief/mesh/bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "relief/lanes/environment.h"
#include "relief/memory.h"
#include "relief/mesh/ray_tree.h"
#include "relief/mesh/texels.h"

namespace relief {
namespace {

constexpr int kLargestSide = 16384;
constexpr int kLargestPadding = 64;

Expected<void> checkRange(const char* field, int value, int least, int most)
{
    if (value >= least && value <= most) return {};
    return fail(std::string("bake: ") + field + " is " + std::to_string(value) + "; give it a value in " +
                std::to_string(least) + ".." + std::to_string(most));
}

// The map, and a number for each texel that is no triangle's, while islands are continued.
Expected<void> checkMemory(const BakeOptions& options)
{
    constexpr std::uint64_t kBytesPerTexel =
        2 * sizeof(glm::vec3) + sizeof(TexelState) + sizeof(std::uint32_t) + sizeof(std::size_t);
    const std::uint64_t texels = static_cast<std::uint64_t>(options.width) * static_cast<std::uint64_t>(options.height);
    if (fitsInMemory(texels * kBytesPerTexel)) return {};
    return fail("bake: a map of " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                " texels does not fit into memory; give it a smaller width and height");
}

Expected<void> checkOptions(const BakeOptions& options)
{
    if (!(options.distance > 0) || !std::isfinite(options.distance)) {
        return fail("bake: distance is " + std::to_string(options.distance) +
                    "; give a length above 0, in the meshes' units");
    }
    return checkRange("width", options.width, 1, kLargestSide)
        .and_then([&] { return checkRange("height", options.height, 1, kLargestSide); })
        .and_then([&] { return checkRange("padding", options.padding, 0, kLargestPadding); })
        .and_then([&] { return checkMemory(options); });
}

Expected<void> checkLow(const Mesh& low)
{
    if (const Expected<void> valid = validate(low); !valid) return valid;
    if (low.indices.empty()) return {};
    if (low.uvs.empty()) {
        return fail("mesh '" + low.name + "': baking needs uvs; give every vertex one (withSphericalUvs)");
    }
    if (low.tangents.empty()) {
        return fail("mesh '" + low.name + "': baking needs tangents; give every vertex one (withTangents)");
    }
    for (std::size_t i = 0; i < low.uvs.size(); ++i) {
        if (std::fabs(low.uvs[i].x) <= kLargestBakedUv && std::fabs(low.uvs[i].y) <= kLargestBakedUv) continue;
        return fail("mesh '" + low.name + "': the uv of vertex " + std::to_string(i) + " is beyond +-" +
                    std::to_string(static_cast<int>(kLargestBakedUv)) + "; move the islands into 0..1");
    }
    return {};
}

class Baker
{
public:
    Baker(const Mesh& l, const Mesh& h, const BakeOptions& o) : low(l), high(h), options(o), tree(h) {}

    BakedNormalMap bake()
    {
        const std::size_t texels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
        map.width = options.width;
        map.height = options.height;
        map.binormal = options.binormal;
        map.normals.assign(texels, {0, 0, 1});
        map.states.assign(texels, TexelState::background);
        map.triangles.assign(texels, BakedNormalMap::kNoTriangle);
        map.detailNormals.assign(texels, glm::vec3(0));
        for (std::size_t triangle = 0; triangle < low.indices.size() / 3; ++triangle) bakeTriangle(triangle);
        continueIslands();
        return std::move(map);
    }

private:
    void bakeTriangle(std::size_t triangle)
    {
        const std::array<FrameCorner, 3> corners = frameCorners(low, triangle);
        visitTexels(
            uvsOf(low, triangle), map.width, map.height, [&](int x, int y, const std::array<double, 3>& weights) {
                const std::size_t texel =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
                if (map.states[texel] != TexelState::background) return;
                map.triangles[texel] = static_cast<std::uint32_t>(triangle);
                bakeTexel(texel, corners, weights);
            });
    }

    void bakeTexel(std::size_t texel, const std::array<FrameCorner, 3>& corners, const std::array<double, 3>& weights)
    {
        const TangentFrame frame = frameAt(corners, weights, options.binormal);
        const glm::dvec3 detail = detailNormal(corners, weights, unitOrZero(frame.normal));
        if (detail == glm::dvec3(0)) {
            map.states[texel] = TexelState::missed;
            ++map.misses;
            return;
        }
        map.states[texel] = TexelState::hit;
        ++map.hits;
        map.detailNormals[texel] = glm::vec3(detail);
        map.normals[texel] = glm::vec3(encoded(detail, frame));
    }

    // Of the detailed mesh, above or below the point; zero if there is none.
    glm::dvec3 detailNormal(const std::array<FrameCorner, 3>& corners, const std::array<double, 3>& weights,
                            const glm::dvec3& normal) const
    {
        glm::dvec3 sum(0);
        if (normal == sum) return sum;
        const double distance = static_cast<double>(options.distance);
        const glm::dvec3 position =
            weights[0] * corners[0].position + weights[1] * corners[1].position + weights[2] * corners[2].position;
        const std::optional<RayHit> hit = tree.firstHit({position, -normal, -distance, distance});
        if (!hit) return sum;
        for (std::size_t k = 0; k < 3; ++k) {
            sum += hit->weights[k] * glm::dvec3(high.normals[high.indices[3 * std::size_t{hit->triangle} + k]]);
        }
        return unitOrZero(sum);
    }

    // One texel outwards per round: the mean of the neighbours that were there before the round.
    void continueIslands()
    {
        std::vector<std::size_t> border, vectorless;
        vectorless.reserve(map.states.size() - map.hits - map.misses);  // growing would take three times as much
        for (std::size_t i = 0; i < map.states.size(); ++i) {
            if (map.states[i] == TexelState::background) vectorless.push_back(i);
        }
        for (int round = 0; round < options.padding && !vectorless.empty(); ++round) {
            border.clear();
            const auto isReached = [&](std::size_t texel) {
                const glm::dvec3 sum = sumOfNeighbours(texel);
                if (sum == glm::dvec3(0)) return false;
                map.normals[texel] = glm::vec3(unitOrZero(sum));
                border.push_back(texel);
                return true;
            };
            vectorless.erase(std::remove_if(vectorless.begin(), vectorless.end(), isReached), vectorless.end());
            for (const std::size_t texel : border) map.states[texel] = TexelState::padding;
        }
    }

    glm::dvec3 sumOfNeighbours(std::size_t texel) const
    {
        const int x = static_cast<int>(texel % static_cast<std::size_t>(map.width));
        const int y = static_cast<int>(texel / static_cast<std::size_t>(map.width));
        glm::dvec3 sum(0);
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const std::size_t neighbour = static_cast<std::size_t>(texels::wrapped(y + dy, map.height)) *
                                                  static_cast<std::size_t>(map.width) +
                                              static_cast<std::size_t>(texels::wrapped(x + dx, map.width));
                if (map.states[neighbour] != TexelState::background) sum += glm::dvec3(map.normals[neighbour]);
            }
        }
        return sum;
    }

    const Mesh& low;
    const Mesh& high;
    const BakeOptions& options;
    RayTree tree;
    BakedNormalMap map;
};

}  // namespace

Expected<BakedNormalMap> bakeNormalMap(const Mesh& low, const Mesh& high, const BakeOptions& options)
{
    const DefaultFloatingPoint environment;
    const Expected<void> isPossible =
        checkOptions(options).and_then([&] { return checkLow(low); }).and_then([&] { return validate(high); });
    if (!isPossible) return tl::unexpected(isPossible.error());
    return Baker(low, high, options).bake();
}

BakedNormalMap roundedTo8Bits(BakedNormalMap map)
{
    const DefaultFloatingPoint environment;
    for (glm::vec3& normal : map.normals) {
        for (int axis = 0; axis < 3; ++axis) {
            const double code = std::floor((static_cast<double>(normal[axis]) * 0.5 + 0.5) * 255.0 + 0.5);
            normal[axis] = static_cast<float>(std::clamp(code, 0.0, 255.0) / 255.0 * 2.0 - 1.0);
        }
    }
    return map;
}

std::vector<float> rgbaOf(const BakedNormalMap& map)
{
    const DefaultFloatingPoint environment;
    std::vector<float> rgba;
    rgba.reserve(4 * map.normals.size());
    for (const glm::vec3& n : map.normals) {
        rgba.insert(rgba.end(), {n.x * 0.5f + 0.5f, n.y * 0.5f + 0.5f, n.z * 0.5f + 0.5f, 1.0f});
    }
    return rgba;
}

}  // namespace relief

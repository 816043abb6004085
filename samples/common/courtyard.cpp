#include "common/courtyard.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "relief/lanes/environment.h"
#include "relief/pipeline/workers.h"

namespace relief::samples {

namespace {

const glm::vec3 kTowardsSun = glm::normalize(glm::vec3(-0.6f, 0.75f, -0.45f));
constexpr glm::vec3 kSunlight{2.2f, 2.05f, 1.75f};
constexpr glm::vec3 kSkylight{0.34f, 0.42f, 0.55f};
constexpr glm::vec3 kHaze{0.62f, 0.70f, 0.78f};

// 0 below `low`, 1 above `high`, without a kink.
float rise(float low, float high, float x)
{
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

struct Pillar
{
    float x, z;
    glm::vec3 color;
};

// Square, upright, half a unit to each side, from the ground (y = -1) up; the eye is at the origin.
constexpr float kPillarHalf = 0.5f, kPillarTop = 2.2f;
constexpr std::array<Pillar, 8> kPillars = {{{4.0f, 0.0f, {0.75f, 0.08f, 0.05f}},
                                             {3.2f, 3.2f, {0.85f, 0.38f, 0.05f}},
                                             {0.0f, 4.0f, {0.80f, 0.68f, 0.08f}},
                                             {-3.2f, 3.2f, {0.20f, 0.55f, 0.08f}},
                                             {-4.0f, 0.0f, {0.05f, 0.48f, 0.40f}},
                                             {-3.2f, -3.2f, {0.06f, 0.22f, 0.70f}},
                                             {0.0f, -4.0f, {0.33f, 0.10f, 0.60f}},
                                             {3.2f, -3.2f, {0.70f, 0.12f, 0.42f}}}};

struct Hit
{
    float distance;
    glm::vec3 normal;
};

// Where a ray from `origin` enters a box, by slabs; a distance below 0: it does not.
Hit intersect(const glm::vec3& origin, const glm::vec3& direction, const glm::vec3& low, const glm::vec3& high)
{
    float enter = 0.0f, leave = 1e9f;
    glm::vec3 normal(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0f) {
            if (origin[axis] < low[axis] || origin[axis] > high[axis]) return {-1.0f, normal};
            continue;
        }
        const float a = (low[axis] - origin[axis]) / direction[axis], b = (high[axis] - origin[axis]) / direction[axis];
        if (std::min(a, b) > enter) {
            enter = std::min(a, b);
            normal = glm::vec3(0.0f);
            normal[axis] = direction[axis] > 0.0f ? -1.0f : 1.0f;
        }
        leave = std::min(leave, std::max(a, b));
    }
    return {enter > 0.0f && enter <= leave ? enter : -1.0f, normal};
}

Hit intersect(const glm::vec3& origin, const glm::vec3& direction, const Pillar& pillar)
{
    // Most rays pass a pillar by further off than half its diagonal, of which the square is 0.5.
    const float x = pillar.x - origin.x, z = pillar.z - origin.z, across = direction.x * z - direction.z * x;
    if (across * across > 0.6f * (direction.x * direction.x + direction.z * direction.z)) return {-1.0f, {}};
    return intersect(origin, direction, {pillar.x - kPillarHalf, -1.0f, pillar.z - kPillarHalf},
                     {pillar.x + kPillarHalf, kPillarTop, pillar.z + kPillarHalf});
}

glm::vec3 lit(const glm::vec3& albedo, const glm::vec3& point, const glm::vec3& normal)
{
    float sun = std::max(glm::dot(normal, kTowardsSun), 0.0f);
    for (const Pillar& pillar : kPillars) {
        if (sun > 0.0f && intersect(point + normal * 1e-3f, kTowardsSun, pillar).distance > 0.0f) sun = 0.0f;
    }
    return albedo * (kSunlight * sun + kSkylight);
}

// A disc of the sky that is cloud within `inner`, a cosine, and blue beyond `outer`.
struct Puff
{
    glm::vec3 middle;
    float outer, inner;
};

// The clouds, each a few puffs beside each other.
std::array<Puff, 20> makePuffs()
{
    constexpr std::array<glm::vec3, 4> kClouds = {
        {{0.8f, 0.75f, 0.5f}, {-0.5f, 0.9f, 0.75f}, {0.45f, 0.8f, -0.9f}, {-1.0f, 0.55f, 0.15f}}};
    std::array<Puff, 20> puffs{};
    std::size_t count = 0;
    for (const glm::vec3& place : kClouds) {
        const glm::vec3 middle = glm::normalize(place), aside = glm::normalize(glm::cross(middle, glm::vec3(0, 1, 0)));
        for (int k = -2; k <= 2; ++k) {
            const float size = 0.0055f - 0.0011f * static_cast<float>(k * k);
            puffs[count++] = {glm::normalize(middle + aside * (0.09f * static_cast<float>(k))), 1.0f - 1.6f * size,
                              1.0f - 0.5f * size};
        }
    }
    return puffs;
}

glm::vec3 sky(const glm::vec3& d)
{
    const float up = std::max(d.y, 0.0f), fall = (1.0f - up) * (1.0f - up);
    glm::vec3 color = glm::mix(glm::vec3(0.09f, 0.24f, 0.62f), kHaze, fall * fall);
    static const std::array<Puff, 20> puffs = makePuffs();
    float cloud = 0.0f;
    for (const Puff& puff : puffs) cloud = std::max(cloud, rise(puff.outer, puff.inner, glm::dot(d, puff.middle)));
    color = glm::mix(color, glm::vec3(1.15f, 1.12f, 1.1f), 0.9f * cloud);
    const float toSun = glm::dot(d, kTowardsSun);
    return color + glm::vec3(0.9f, 0.8f, 0.6f) * rise(0.93f, 1.0f, toSun) * 0.5f +
           glm::vec3(40.0f, 36.0f, 30.0f) * rise(0.9968f, 0.9978f, toSun);
}

glm::vec3 ground(const glm::vec3& point)
{
    const float nearest = std::max(std::fabs(point.x), std::fabs(point.z));
    if (nearest > 6.0f) return lit({0.16f, 0.22f, 0.07f}, point, {0, 1, 0});  // lawn around the yard
    const int x = static_cast<int>(std::floor(point.x + 0.5f)), z = static_cast<int>(std::floor(point.z + 0.5f));
    return lit((x + z) % 2 == 0 ? glm::vec3(0.55f, 0.50f, 0.42f) : glm::vec3(0.16f, 0.14f, 0.13f), point, {0, 1, 0});
}

}  // namespace

glm::vec3 courtyardRadiance(const glm::vec3& d)
{
    Hit nearest = {-1.0f, {}};
    const Pillar* hit = nullptr;
    for (const Pillar& pillar : kPillars) {
        const Hit here = intersect(glm::vec3(0.0f), d, pillar);
        if (here.distance > 0.0f && (hit == nullptr || here.distance < nearest.distance)) {
            nearest = here;
            hit = &pillar;
        }
    }
    if (hit != nullptr) {
        const glm::vec3 point = d * nearest.distance;
        const bool isBand = point.y > kPillarTop - 0.3f || point.y < -0.8f;
        return lit(isBand ? glm::vec3(0.75f) : hit->color, point, nearest.normal);
    }
    if (d.y >= 0.0f) return sky(d);
    const float distance = -1.0f / d.y;
    return glm::mix(ground(d * distance), kHaze, rise(6.0f, 60.0f, distance));
}

namespace {

constexpr int kSide = 256, kSamples = 3;  // of a face in texels, and of a texel in each direction

std::shared_ptr<const Environment> made()
{
    Workers workers;
    const auto run = [&workers](int tasks, const std::function<void(int)>& function) {
        workers.run(tasks, [&function](int task, int) {
            const DefaultFloatingPoint environment;
            function(task);
        });
    };
    ImageFloat strip{kCubeFaces * kSide, kSide, std::vector<float>(std::size_t{kCubeFaces} * kSide * kSide * 4, 1.0f)};
    run(kSide, [&strip](int row) {
        for (int column = 0; column < kCubeFaces * kSide; ++column) {
            const CubeFaceAxes& axes = kCubeFaceAxes[static_cast<std::size_t>(column / kSide)];
            glm::vec3 sum(0.0f);
            for (int k = 0; k < kSamples * kSamples; ++k) {
                const auto place = [](int texel, int sample) {  // -1..1
                    return (static_cast<float>(2 * (texel * kSamples + sample)) + 1.0f) / (kSide * kSamples) - 1.0f;
                };
                const float s = place(column % kSide, k % kSamples), t = -place(row, k / kSamples);
                sum += courtyardRadiance(
                    glm::normalize(glm::vec3(axes.middle) + glm::vec3(axes.right) * s + glm::vec3(axes.up) * t));
            }
            const auto texel = static_cast<std::size_t>(row * kCubeFaces * kSide + column) * 4;
            for (int c = 0; c < 3; ++c) {
                strip.pixels[texel + static_cast<std::size_t>(c)] = sum[c] / (kSamples * kSamples);
            }
        }
    });
    CubeMap radiance = *CubeMap::fromPicture(std::move(strip), ColorSpace::linear);
    ImageFloat levels = *prefilteredEnvironment(radiance, {.side = 128, .samples = 128}, run);
    const SphericalHarmonics irradiance = irradianceOf(radiance);
    return std::make_shared<Environment>(
        Environment{std::move(radiance), *CubeMap::fromPicture(std::move(levels), ColorSpace::linear), irradiance});
}

}  // namespace

std::shared_ptr<const Environment> courtyard()
{
    static const std::shared_ptr<const Environment> once = made();
    return once;
}

}  // namespace relief::samples

// Lights: attenuation, cones, reach, lights per vertex and spherical harmonics (stability cases S-801, S-815 to S-820).
#include "relief/shading/lights.h"

#include <limits>

#include "relief/mesh/primitives.h"
#include "shading_fixture.h"

using namespace fixture;

namespace {

const PointLight kLamp = {{1, 1, 1}, {0, 0, 0}, 4.0f};
const SpotLight kSpot = {{1, 1, 1}, {0, 0, 0}, 4.0f, {0, 0, 1}, 0.8f, 0.9f};

template <class Light>
float strength(const Light& light, const float3& at)
{
    return CreateLight(light, at).color.x[0];
}

// A light per vertex that stands alone at `position`.
VertexLights lampAt(const glm::vec3& position, float range)
{
    VertexLights lights{};
    lights.positionX.x = position.x;
    lights.positionY.x = position.y;
    lights.positionZ.x = position.z;
    lights.attenSq.x = 25.0f / (range * range);
    lights.color[0] = float3(1, 1, 1);
    return lights;
}

}  // namespace

TEST_CASE("lights: a point light is 1 near by, 1 / (1 + 25 q) half way, and exactly 0 from its range on")
{
    CHECK(strength(kLamp, {0, 0, 0.001f}) == doctest::Approx(1.0).epsilon(1e-5));
    CHECK(strength(kLamp, {2, 0, 0}) == doctest::Approx(1.0 / 7.25));
    CHECK(strength(kLamp, {0, 3.6f, 0}) == doctest::Approx(0.5 / (1.0 + 25.0 * 0.81)));  // half way down the fade
    for (const float d : {4.0f, 4.1f, 100.0f, 1e20f, std::numeric_limits<float>::infinity()})
        CHECK(strength(kLamp, {d, 0, 0}) == 0.0f);
}

TEST_CASE("lights: attenuation never jumps, and falls all the way")
{
    float before = strength(kLamp, {0, 0, 0});
    for (int i = 1; i <= 5000; ++i) {
        const float now = strength(kLamp, {static_cast<float>(i) * 0.001f, 0, 0});
        CHECK(now <= before);
        CHECK(before - now <= 0.005f);
        before = now;
    }
}

TEST_CASE("lights: S-801 a light on the surface has no direction, and lights nothing")
{
    const UnityLight light = CreateLight(kLamp, {0, 0, 0});
    CHECK(length(lane(light.dir)) == 0.0);
    CHECK(isFinite(lane(light.color)));
    CHECK(length(lane(CreateLight(kLamp, {std::numeric_limits<float>::quiet_NaN(), 0, 0}).dir)) == 0.0);
    const float4 color = UNITY_BRDF_PBS({1, 1, 1}, {1, 1, 1}, 0.5f, {0, 1, 0}, {0, 1, 0}, light);
    CHECK(length(lane(color.xyz())) == 0.0);
    CHECK(isFinite(lane(Shade4PointLights(lampAt({0, 0, 0}, 1.0f), {0, 0, 0}, {0, 1, 0}))));
}

TEST_CASE("lights: a spot shines within its cone, S-818 and not behind itself")
{
    CHECK(strength(kSpot, {0, 0, 1}) == doctest::Approx(strength(kLamp, {0, 0, 1})));
    CHECK(strength(kSpot, {0.75f, 0, 1}) == 0.0f);  // cosine 0.8: the border
    CHECK(strength(kSpot, {0, 0, -1}) == 0.0f);
    CHECK(strength(kSpot, {0.1f, 0, -1}) == 0.0f);
    CHECK(strength(kSpot, {0, 0, 0}) == 0.0f);
    const float middle = std::tan(std::acos(0.85f));
    CHECK(strength(kSpot, {middle, 0, 1}) == doctest::Approx(0.5f * strength(kLamp, {middle, 0, 1})).epsilon(1e-4));
}

TEST_CASE("lights: a light is said not to reach only what it does not light")
{
    CHECK(lightReaches(DirectionalLight{{1, 1, 1}, {0, 1, 0}}, Bounds{{5, 5, 5}, {6, 6, 6}}));
    CHECK(lightReaches(kLamp, Bounds{{-1, -1, 3}, {1, 1, 5}}));
    CHECK_FALSE(lightReaches(kLamp, Bounds{{-1, -1, 4}, {1, 1, 5}}));
    CHECK_FALSE(lightReaches(kSpot, Bounds{{-1, -1, -2}, {1, 1, -1.5f}}));           // behind
    CHECK_FALSE(lightReaches(kSpot, Bounds{{2, -0.2f, 0.3f}, {2.4f, 0.2f, 0.7f}}));  // beside
    CHECK(lightReaches(kSpot, Bounds{{-0.1f, -0.1f, 2}, {0.1f, 0.1f, 2.2f}}));
    // Whatever the box, if it is out of reach then no point of it is lit.
    std::uint32_t state = 1;
    const auto random = [&state](float low, float high) {
        state = state * 1664525u + 1013904223u;
        return low + static_cast<float>(state >> 8) * 0x1p-24f * (high - low);
    };
    int unreached = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 corner = {random(-5, 5), random(-5, 5), random(-5, 5)};
        const float size = random(0.1f, 2.0f);
        const Bounds box = {corner, corner + glm::vec3(size)};
        const bool lamp = lightReaches(kLamp, box), spot = lightReaches(kSpot, box);
        unreached += !spot;
        for (int k = 0; k < 20; ++k) {
            const float x = random(0, 1), y = random(0, 1);
            const float3 p = broadcast(corner + glm::vec3(x, y, random(0, 1)) * size);
            if (!lamp) CHECK(strength(kLamp, p) == 0.0f);
            if (!spot) CHECK(strength(kSpot, p) == 0.0f);
        }
    }
    CHECK(unreached > 1000);
}

TEST_CASE("lights: S-817 a light per vertex has 1/26 left at its range, with the window it has none")
{
    const auto at = [](float distance, bool window) {
        return Shade4PointLights(lampAt({0, distance, 0}, 2.0f), {0, 0, 0}, {0, 1, 0}, window).x[0];
    };
    CHECK(at(2.0f, false) == doctest::Approx(1.0 / 26.0));
    CHECK(at(1.0f, false) == doctest::Approx(1.0 / 7.25));
    measured("left at the range", at(2.0f, true), 1.0f / 255.0f);
    CHECK(at(1.5f, true) == doctest::Approx(at(1.5f, false)));
    CHECK(at(1.999f, true) <= 1.0f / 255.0f);
}

TEST_CASE("lights: four lights per vertex are the sum of each alone")
{
    VertexLights all{};
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const float x = static_cast<float>(i) - 1.5f;
        all.positionX[i] = x;
        all.positionY[i] = 1.0f;
        all.attenSq[i] = 1.0f;
        all.color[i] = float3(static_cast<float>(i + 1), 0, 0);
        sum += Shade4PointLights(lampAt({x, 1, 0}, 5.0f), {0, 0, 0}, {0, 1, 0}).x[0] * static_cast<float>(i + 1);
    }
    CHECK(Shade4PointLights(all, {0, 0, 0}, {0, 1, 0}).x[0] == doctest::Approx(sum).epsilon(1e-6));
}

TEST_CASE("lights: S-820 light per vertex comes closer to light per point with every subdivision")
{
    // A light over the middle of a square: the mean error of what triangles make of the values at their corners.
    const VertexLights lamp = lampAt({0, 0.3f, 0}, 2.0f);
    const auto exact = [&](float x, float z) { return Shade4PointLights(lamp, {x, 0, z}, {0, 1, 0}).x[0]; };
    double before = 1e9;
    for (const int cells : {1, 2, 4, 8, 16, 32}) {
        double sum = 0.0;
        const int samples = 64;
        for (int i = 0; i < samples * samples; ++i) {
            const float u = (static_cast<float>(i % samples) + 0.5f) / samples * static_cast<float>(cells);
            const float v = (static_cast<float>(i / samples) + 0.5f) / samples * static_cast<float>(cells);
            const float cu = std::floor(u), cv = std::floor(v), tu = u - cu, tv = v - cv;
            const auto corner = [&](float du, float dv) {
                return exact((cu + du) / static_cast<float>(cells) - 0.5f,
                             (cv + dv) / static_cast<float>(cells) - 0.5f);
            };
            const float a = corner(0, 0), b = corner(1, 1), c = tu > tv ? corner(1, 0) : corner(0, 1);
            const float interpolated =
                tu > tv ? a + (c - a) * (tu - tv) + (b - a) * tv : a + (c - a) * (tv - tu) + (b - a) * tu;
            sum += std::abs(interpolated -
                            exact(u / static_cast<float>(cells) - 0.5f, v / static_cast<float>(cells) - 0.5f));
        }
        CHECK(sum < before);
        before = sum;
    }
    measured("mean error after the last subdivision", before / 4096.0, 2e-3);
}

TEST_CASE("lights: spherical harmonics give sky, ground and horizon exactly, and S-815 a constant as a constant")
{
    const SphericalHarmonics sh = gradientSurroundings({0.2f, 0.4f, 0.9f}, {0.5f, 0.5f, 0.5f}, {0.1f, 0.05f, 0.0f});
    const auto check = [&](const float3& normal, double r, double g, double b) {
        const Vector color = lane(ShadeSH9(sh, normal));
        CHECK(color.x == doctest::Approx(r).epsilon(1e-6));
        CHECK(color.y == doctest::Approx(g).epsilon(1e-6));
        CHECK(color.z == doctest::Approx(b).epsilon(1e-6));
    };
    check({0, 1, 0}, 0.2, 0.4, 0.9);
    check({0, -1, 0}, 0.1, 0.05, 0.0);
    check({1, 0, 0}, 0.5, 0.5, 0.5);
    check({0, 0, -1}, 0.5, 0.5, 0.5);
    check({0.6f, 0, 0.8f}, 0.5, 0.5, 0.5);
    const SphericalHarmonics even = gradientSurroundings(glm::vec3(0.3f), glm::vec3(0.3f), glm::vec3(0.3f));
    for (const float3& normal : {float3(0, 0, 0), float3(0, 0.5f, 0), float3(0.6f, 0, 0.8f), float3(-1, 0, 0)})
        measured("off the constant 0.3", std::abs(static_cast<double>(ShadeSH9(even, normal).x[0]) - 0.3), 1e-6);
}

// Texels that triangles cover: counts known by algebra, no gap and no overlap along edges, wrapping.
#include "relief/mesh/texels.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "relief/mesh/primitives.h"

using namespace relief;

namespace {

// How often each texel is visited, row by row from the top.
std::vector<int> visits(const std::vector<std::array<glm::vec2, 3>>& triangles, int width, int height)
{
    std::vector<int> counts(static_cast<std::size_t>(width * height), 0);
    for (const std::array<glm::vec2, 3>& triangle : triangles) {
        visitTexels(triangle, width, height, [&](int x, int y, const std::array<double, 3>&) {
            ++counts[static_cast<std::size_t>(y * width + x)];
        });
    }
    return counts;
}

}  // namespace

TEST_CASE("texels: rows count from the top, and borders belong to the triangle")
{
    // The corners are texel centres of a 4 x 4 picture, in the lower left.
    const std::vector<int> counts = visits({{{{0.125f, 0.125f}, {0.625f, 0.125f}, {0.125f, 0.625f}}}}, 4, 4);
    CHECK(counts == std::vector<int>{0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0});
}

TEST_CASE("texels: weights give back the centre, whichever way the triangle turns")
{
    const std::array<glm::vec2, 3> turned[] = {{{{0.1f, 0.05f}, {0.9f, 0.3f}, {0.4f, 0.95f}}},
                                               {{{0.4f, 0.95f}, {0.9f, 0.3f}, {0.1f, 0.05f}}}};
    for (const std::array<glm::vec2, 3>& uvs : turned) {
        int visited = 0;
        visitTexels(uvs, 32, 16, [&](int x, int y, const std::array<double, 3>& weights) {
            const glm::dvec2 uv =
                weights[0] * glm::dvec2(uvs[0]) + weights[1] * glm::dvec2(uvs[1]) + weights[2] * glm::dvec2(uvs[2]);
            CHECK(uv.x == doctest::Approx((x + 0.5) / 32).epsilon(1e-12));
            CHECK(uv.y == doctest::Approx((15 - y + 0.5) / 16).epsilon(1e-12));
            CHECK(weights[0] + weights[1] + weights[2] == doctest::Approx(1).epsilon(1e-12));
            for (const double weight : weights) CHECK(weight >= 0);
            ++visited;
        });
        CHECK(visited > 150);
    }
}

TEST_CASE("texels: an edge function is the same number from both sides, for any rounding")
{
    std::uint64_t state = 1;
    const auto next = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state >> 11) * 0x1p-43;
    };
    const auto point = [&] {
        const double x = next(), y = next();
        return glm::dvec2(x, y);
    };
    int different = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec2 a = point(), b = point();
        const glm::dvec2 between = a + (b - a) * 0.3;  // where only the rounding decides
        different += texels::edgeFunction(a, b, between) != -texels::edgeFunction(b, a, between);
    }
    CHECK(different == 0);
}

TEST_CASE("texels: a picture cut into triangles has no gap, at any size and anywhere")
{
    for (const int size : {1, 7, 64, 101}) {
        for (const float shift : {0.0f, -3.3f, 0.1f}) {
            std::vector<std::array<glm::vec2, 3>> triangles;
            const auto at = [&](int x, int y) {  // bent, so that edges have any slope
                const float u = static_cast<float>(x) / 12, v = static_cast<float>(y) / 12;
                const float bend = 0.3f * u * (1 - u) * v * (1 - v);
                return glm::vec2(u + bend + shift, v - bend + shift);
            };
            for (int y = 0; y < 12; ++y) {
                for (int x = 0; x < 12; ++x) {
                    triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
                    triangles.push_back({at(x, y + 1), at(x, y), at(x + 1, y + 1)});
                }
            }
            CAPTURE(size);
            CAPTURE(shift);
            int gaps = 0, total = 0;
            for (const int count : visits(triangles, size, size)) {
                gaps += count == 0;
                total += count;
            }
            CHECK(gaps == 0);
            CHECK(total <= size * size + size);  // borders through centres are counted twice
        }
    }
}

TEST_CASE("texels: uvs outside wrap around, and a triangle larger than the picture comes again")
{
    const std::array<glm::vec2, 3> inside = {{{0.125f, 0.25f}, {0.8125f, 0.375f}, {0.3125f, 0.875f}}};
    std::array<glm::vec2, 3> outside = inside;
    for (glm::vec2& uv : outside) uv += glm::vec2(-2, 3);
    CHECK(visits({inside}, 20, 20) == visits({outside}, 20, 20));
    int least = 1000;
    for (const int count : visits({{{{-4, -4}, {8, -4}, {-4, 8}}}}, 4, 4)) least = std::min(least, count);
    CHECK(least >= 66);  // 12 * 12 / 2 periods, less those that the long side cuts
}

TEST_CASE("texels: triangles without area in the picture cover nothing")
{
    int sum = 0;
    for (const int count : visits({{{{0.1f, 0.1f}, {0.1f, 0.1f}, {0.1f, 0.1f}}},
                                   {{{0.125f, 0.125f}, {0.875f, 0.875f}, {0.375f, 0.375f}}},
                                   {{{0, 0.125f}, {1, 0.125f}, {0, 0.125f}}}},
                                  4, 4)) {
        sum += count;
    }
    CHECK(sum == 0);
}

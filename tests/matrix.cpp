// Matrices of lanes: every shape of mul, the same bits by `*`, transposition and determinants. tests/intrinsics.cpp has
// which way round matrices go.
#include "relief/hlsl/matrix.h"

#include <doctest/doctest.h>

#include "lane_check.h"
#include "relief/hlsl/types.h"

using namespace relief;
using namespace lane_check;

namespace {

// Pseudo-random numbers of [-1, 1), a different one in every lane.
Float randomFloat(RandomBits& random)
{
    Float v;
    for (int i = 0; i < kLanes; ++i) v.set(i, static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f);
    return v;
}
template <int n>
LaneMatrix<n> randomMatrix(RandomBits& random)
{
    LaneMatrix<n> m;
    for (int c = 0; c < n; ++c) {
        for (int r = 0; r < n; ++r) m[c][r] = randomFloat(random);
    }
    return m;
}

template <int n>
int differences(const LaneMatrix<n>& a, const LaneMatrix<n>& b)
{
    int different = 0;
    for (int c = 0; c < n; ++c) {
        for (int r = 0; r < n; ++r) different += count(a[c][r] != b[c][r]);
    }
    return different;
}
template <int n>
int differences(const FloatN<n>& a, const FloatN<n>& b)
{
    int different = 0;
    for (int i = 0; i < n; ++i) different += count(a[i] != b[i]);
    return different;
}

}  // namespace

TEST_CASE("matrix: mul(m, v) and m * v have the same bits: sums from left to right")
{
    // In pairs, (1e8 + 1) + (-1e8 + 1) would be 0.
    const float4x4 m(float4(1e8f), float4(1.0f), float4(-1e8f), float4(1.0f));
    CHECK(all(mul(m, float4(1.0f)).x == 1.0f));
    CHECK(all((m * float4(1.0f)).x == 1.0f));
    RandomBits random;
    for (int i = 0; i < 100; ++i) {
        const auto a = randomMatrix<4>(random), b = randomMatrix<4>(random);
        const auto c = randomMatrix<3>(random), d = randomMatrix<3>(random);
        CHECK(differences(mul(a, b[0]), a * b[0]) == 0);
        CHECK(differences(mul(b[0], a), b[0] * a) == 0);
        CHECK(differences(mul(a, b), a * b) == 0);
        CHECK(differences((a * b)[2], a * b[2]) == 0);
        CHECK(differences(mul(c, d[0]), c * d[0]) == 0);
        CHECK(differences(mul(d[0], c), d[0] * c) == 0);
        CHECK(differences(mul(c, d), c * d) == 0);
    }
}

TEST_CASE("matrix: a product of two is one after the other, a number scales")
{
    const float3x3 a = broadcast(glm::mat3(1, 2, 3, 4, 5, 6, 7, 8, 9)),
                   b = broadcast(glm::mat3(0, 1, 0, 0, 0, 1, 1, 0, 0));
    const float3 v(1, -2, 3);
    CHECK(differences((a * b) * v, a * (b * v)) == 0);
    CHECK(differences(mul(a, Float(2.0f)), float3x3(a[0] * 2, a[1] * 2, a[2] * 2)) == 0);
    CHECK(differences(mul(Float(2.0f), a), mul(a, Float(2.0f))) == 0);
}

TEST_CASE("matrix: transpose swaps rows and columns, twice makes nothing")
{
    RandomBits random;
    const auto m = randomMatrix<4>(random);
    const float4x4 t = transpose(m);
    for (int i = 0; i < 16; ++i) CHECK(all(t[i / 4][i % 4] == m[i % 4][i / 4]));
    CHECK(differences(transpose(t), m) == 0);
}

TEST_CASE("matrix: sums, multiples, and plain ones of GLM beside a vector")
{
    RandomBits random;
    const auto a = randomMatrix<4>(random), b = randomMatrix<4>(random);
    for (int c = 0; c < 4; ++c) {
        CHECK(differences((a + b)[c], a[c] + b[c]) == 0);
        CHECK(differences((a - b)[c], a[c] - b[c]) == 0);
    }
    CHECK(differences(-a, mul(-1.0f, a)) == 0);
    CHECK(differences(mul(a, 2), a + a) == 0);
    const glm::mat3 plain(1, 2, 3, 4, 5, 6, 7, 8, 10);
    const float3 v(2, -1, 0.5f);
    CHECK(firstLane(mul(plain, v)) == firstLane(mul(float3x3(plain), v)));
    CHECK(firstLane(mul(v, plain)) == firstLane(mul(v, float3x3(plain))));
}

TEST_CASE("matrix: determinants")
{
    CHECK(all(determinant(float3x3(glm::mat3(2, 0, 0, 5, 3, 0, 7, 11, 4))) == 24.0f));
    CHECK(all(determinant(float3x3(glm::mat3(0, 1, 0, 1, 0, 0, 0, 0, 1))) == -1.0f));
    CHECK(all(determinant(float4x4(glm::mat4(2, 0, 0, 0, 1, 3, 0, 0, 1, 1, 4, 0, 1, 1, 1, 5))) == 120.0f));
    CHECK(all(determinant(float4x4(glm::mat4(0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0))) == -1.0f));
    // Of a product it is the product, within rounding.
    RandomBits random;
    for (int i = 0; i < 50; ++i) {
        const auto a = randomMatrix<4>(random), b = randomMatrix<4>(random);
        CHECK(all(abs(determinant(a * b) - determinant(a) * determinant(b)) < 1e-4f));
    }
}

TEST_CASE("matrix: from GLM's and back, and the upper left of a larger one")
{
    const glm::mat4 plain(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
    const float4x4 m = plain;
    CHECK(firstLane(m) == plain);
    CHECK(firstLane(float3x3(m)) == glm::mat3(plain));
    CHECK(firstLane(float3(1, 2, 3)) == glm::vec3(1, 2, 3));
}

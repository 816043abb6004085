// ddx and ddy: differences of neighbours in a quad, fine and coarse, and where the lanes of a quad are.
#include "relief/hlsl/derivatives.h"

#include <cmath>
#include <set>
#include <utility>

#include <doctest/doctest.h>

#include "lane_check.h"
#include "stability.h"

using namespace relief;

namespace {

// Every quad: 1, 3 above 7, 23. All four differences are different.
Float quads()
{
    Float v;
    const float quad[4] = {1.0f, 3.0f, 7.0f, 23.0f};
    for (int i = 0; i < kLanes; ++i) v.set(i, quad[i % 4] * static_cast<float>(1 + i / 4));
    return v;
}

float quadFactor(int lane)
{
    return static_cast<float>(1 + lane / 4);
}

Float xs()
{
    return Float(laneXs());
}
Float ys()
{
    return Float(laneYs());
}

}  // namespace

TEST_CASE("lanes are the pixels of the block, each once")
{
    std::set<std::pair<int, int>> pixels;
    for (int i = 0; i < kLanes; ++i) {
        CHECK(laneX(i) >= 0);
        CHECK(laneX(i) < kBlockWidth);
        CHECK(laneY(i) >= 0);
        CHECK(laneY(i) < kBlockHeight);
        pixels.insert({laneX(i), laneY(i)});
        CHECK(laneXs()[i] == laneX(i));
        CHECK(laneYs()[i] == laneY(i));
    }
    CHECK(pixels.size() == static_cast<std::size_t>(kBlockWidth * kBlockHeight));
    CHECK(kBlockWidth * kBlockHeight == kLanes);
}

TEST_CASE("lanes of a quad: upper left, upper right, lower left, lower right, at even pixels")
{
    for (int quad = 0; quad < kLanes; quad += 4) {
        const int x = laneX(quad);
        const int y = laneY(quad);
        CHECK(x % 2 == 0);
        CHECK(y % 2 == 0);
        CHECK(laneX(quad + 1) == x + 1);
        CHECK(laneY(quad + 1) == y);
        CHECK(laneX(quad + 2) == x);
        CHECK(laneY(quad + 2) == y + 1);
        CHECK(laneX(quad + 3) == x + 1);
        CHECK(laneY(quad + 3) == y + 1);
    }
}

TEST_CASE("ddx: right minus left, in each row")
{
    const Float d = ddx(quads());
    for (int i = 0; i < kLanes; ++i) CHECK(d[i] == (i % 4 < 2 ? 2.0f : 16.0f) * quadFactor(i));
}

TEST_CASE("ddy: lower minus upper, in each column")
{
    const Float d = ddy(quads());
    for (int i = 0; i < kLanes; ++i) CHECK(d[i] == (i % 2 == 0 ? 6.0f : 20.0f) * quadFactor(i));
}

TEST_CASE("ddx_coarse and ddy_coarse: the upper left pixel's, for the whole quad")
{
    const Float dx = ddx_coarse(quads());
    const Float dy = ddy_coarse(quads());
    for (int i = 0; i < kLanes; ++i) {
        CHECK(dx[i] == 2.0f * quadFactor(i));
        CHECK(dy[i] == 6.0f * quadFactor(i));
    }
}

TEST_CASE("derivatives of a linear function are its slopes, in every lane")
{
    const Float f = 3.0f * xs() - 5.0f * ys() + 100.0f;
    for (int i = 0; i < kLanes; ++i) {
        CHECK(ddx(f)[i] == 3.0f);
        CHECK(ddy(f)[i] == -5.0f);
        CHECK(ddx_coarse(f)[i] == 3.0f);
        CHECK(ddy_coarse(f)[i] == -5.0f);
    }
}

TEST_CASE("derivatives of x * y: fine ones differ from row to row and column to column")
{
    const Float f = xs() * ys();
    for (int i = 0; i < kLanes; ++i) {
        CHECK(ddx(f)[i] == static_cast<float>(laneY(i)));
        CHECK(ddy(f)[i] == static_cast<float>(laneX(i)));
        CHECK(ddx_coarse(f)[i] == static_cast<float>(laneY(i) & ~1));
        CHECK(ddy_coarse(f)[i] == static_cast<float>(laneX(i) & ~1));
    }
}

TEST_CASE("derivatives of a constant are zero")
{
    for (int i = 0; i < kLanes; ++i) {
        CHECK(ddx(Float(7.0f))[i] == 0.0f);
        CHECK(ddy(Float(7.0f))[i] == 0.0f);
    }
}

TEST_CASE("derivatives of vectors are those of the components")
{
    const float3 v(xs(), 2.0f * ys(), xs() - 4.0f * ys());
    const float3 dx = ddx(v);
    const float3 dy = ddy(v);
    for (int i = 0; i < kLanes; ++i) {
        CHECK(dx.x[i] == 1.0f);
        CHECK(dx.y[i] == 0.0f);
        CHECK(dx.z[i] == 1.0f);
        CHECK(dy.x[i] == 0.0f);
        CHECK(dy.y[i] == 2.0f);
        CHECK(dy.z[i] == -4.0f);
    }
    const float2 uv(xs() * 0.25f, ys() * 0.5f);
    CHECK(ddx(uv).x[0] == 0.25f);
    CHECK(ddy(uv).y[kLanes - 1] == 0.5f);
}

TEST_CASE("derivatives: a NaN reaches the pixels that read it, and no others")
{
    Float v = quads();
    v.set(1, kNan);
    const Float dx = ddx(v);
    const Float dy = ddy(v);
    for (int i = 0; i < kLanes; ++i) {
        CHECK(std::isnan(dx[i]) == (i == 0 || i == 1));
        CHECK(std::isnan(dy[i]) == (i == 1 || i == 3));
    }
}

TEST_CASE("derivatives: coarse ones of a vector are those of its components")
{
    float lanes[kLanes];
    for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<float>(i * i);
    const Float a = Float::load(lanes), b = a * 3.0f + 1.0f;
    const float2 v(a, b);
    CHECK(all(ddx_coarse(v).x == ddx_coarse(a)));
    CHECK(all(ddx_coarse(v).y == ddx_coarse(b)));
    CHECK(all(ddy_coarse(v).x == ddy_coarse(a)));
    CHECK(all(ddy_coarse(v).y == ddy_coarse(b)));
}

TEST_CASE("derivatives: fwidth is the sum of both changes, the fine forms are the default")
{
    const Float f = 3.0f * xs() - 5.0f * ys();
    CHECK(all(fwidth(f) == 8.0f));
    CHECK(all(fwidth(float2(f, -f)).y == 8.0f));
    CHECK(all(ddx_fine(quads()) == ddx(quads())));
    CHECK(all(ddy_fine(float2(quads(), f)).x == ddy(quads())));
}

TEST_CASE("derivatives: S-516 coarse and fine ones are equal on a plane, and a choice by name elsewhere")
{
    const Float plane = 3.0f * xs() - 5.0f * ys() + 100.0f;
    stability::measured("lanes that differ on a plane",
                        count((ddx(plane) != ddx_coarse(plane)) | (ddy(plane) != ddy_coarse(plane))), 0);
    // A plane seen in perspective, 8 pixels from the horizon.
    const Float curved = 1.0f / (8.0f + ys()) * (xs() + 1.0f);
    CHECK(any(ddx(curved) != ddx_coarse(curved)));
    double largest = 0.0;
    for (int i = 0; i < kLanes; ++i) {
        largest = std::fmax(largest, std::abs(std::log2(static_cast<double>(ddx(curved)[i] / ddx_coarse(curved)[i]))));
    }
    stability::noted("levels between the two, 8 pixels from the horizon", largest);
}

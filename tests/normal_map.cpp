// Normals: known slopes give known vectors, borders wrap, what has no direction is flat, and codes are as near as codes
// can be.
#include "relief/texture/normal_map.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include <doctest/doctest.h>

#include "numbers.h"
#include "stability.h"

using namespace relief;
using stability::measured;

namespace {

constexpr NormalFilter kFilters[] = {NormalFilter::smooth, NormalFilter::sobel};

template <class Function>
HeightField fieldBy(int width, int height, Function f)  // f(x, y)
{
    HeightField field{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) field.values.push_back(static_cast<float>(f(x, y)));
    }
    return field;
}

bool sameBits(const float* texel, float x, float y, float z)
{
    const float expected[] = {x, y, z, 0.0f};
    return std::memcmp(texel, expected, sizeof(expected)) == 0;
}

float randomHeight(int x, int y)
{
    const auto hash = static_cast<std::uint32_t>(x * 73856093 ^ y * 19349663) * 2654435761u;
    return static_cast<float>(hash >> 8) / 16777216.0f;
}

}  // namespace

TEST_CASE("normal_map: a ramp gives the normal that its slope says, in both directions")
{
    // Heights in eighths, 8 texels wide, bumpiness 3/4: the slope is 3/4, and 3, 4, 5 is a right triangle.
    const HeightField right = fieldBy(8, 4, [](int x, int) { return x / 8.0; });
    const HeightField up = fieldBy(8, 8, [](int, int y) { return y / 8.0; });
    for (const NormalFilter filter : kFilters) {
        const MipLevel normals = normalsFromHeights(right, 0.75f, filter);
        const MipLevel upwards = normalsFromHeights(up, 0.75f, filter);
        for (int i = 1; i < 7; ++i) {
            CHECK(sameBits(normals.texel<float>(i, 2), -0.6f, 0.0f, 0.8f));
            CHECK(sameBits(upwards.texel<float>(3, i), 0.0f, -0.6f, 0.8f));
        }
    }
    // Where the ramp meets itself it falls by 7/8: a slope of -21/4.
    const MipLevel normals = normalsFromHeights(right, 0.75f, NormalFilter::smooth);
    CHECK(normals.texel<float>(7, 0)[0] == static_cast<float>(5.25 / std::sqrt(5.25 * 5.25 + 1.0)));
}

TEST_CASE("normal_map: bumpiness is in widths of the texture, so the same picture twice as large looks the same")
{
    const MipLevel small =
        normalsFromHeights(fieldBy(8, 8, [](int x, int y) { return (x + 2 * y) / 8.0; }), 0.3f, NormalFilter::smooth);
    const MipLevel large = normalsFromHeights(fieldBy(16, 16, [](int x, int y) { return (x + 2 * y) / 16.0; }), 0.3f,
                                              NormalFilter::smooth);
    CHECK(std::memcmp(small.texel<float>(2, 3), large.texel<float>(5, 6), 16) == 0);
}

TEST_CASE("normal_map: Sobel gives the slope of a plane exactly")
{
    const HeightField plane = fieldBy(16, 16, [](int x, int y) { return (3.0 * x - 2.0 * y) / 64.0; });
    const MipLevel sobel = normalsFromHeights(plane, 0.5f, NormalFilter::sobel);
    const MipLevel smooth = normalsFromHeights(plane, 0.5f, NormalFilter::smooth);
    const double x = -3.0 / 8.0, y = 2.0 / 8.0, length = std::sqrt(x * x + y * y + 1.0);
    for (int i = 1; i < 15; ++i) {
        const auto inFloat = [length](double v) { return static_cast<float>(v / length); };
        CHECK(sameBits(sobel.texel<float>(i, 15 - i), inFloat(x), inFloat(y), inFloat(1.0)));
        CHECK(sameBits(smooth.texel<float>(i, 15 - i), inFloat(x), inFloat(y), inFloat(1.0)));
    }
}

TEST_CASE("normal_map: a sine's slope is met within what a difference can know")
{
    constexpr int kSide = 128;
    constexpr double kWave = 2.0 * std::numbers::pi / kSide, kBumpiness = 0.0625;
    const HeightField sine = fieldBy(kSide, 2, [](int x, int) { return 0.5 + 0.5 * std::sin(kWave * x); });
    constexpr double kScale = kBumpiness * kSide;
    const double rounding = kScale * 1.2e-7 + 1e-6;  // of two heights, and of the normal
    for (const NormalFilter filter : kFilters) {
        const MipLevel normals = normalsFromHeights(sine, static_cast<float>(kBumpiness), filter);
        // Taylor: the difference to the neighbour is the slope half a texel on, within h''' / 24; the central
        // difference is the slope here, within h''' / 6.
        const double shift = filter == NormalFilter::smooth ? 0.5 : 0.0;
        const double bound = kScale * 0.5 * kWave * kWave * kWave / (filter == NormalFilter::smooth ? 24.0 : 6.0);
        for (int x = 0; x < kSide; ++x) {
            const float* n = normals.texel<float>(x, 1);
            const double slope = -static_cast<double>(n[0]) / static_cast<double>(n[2]);
            const double exact = kScale * 0.5 * kWave * std::cos(kWave * (x + shift));
            REQUIRE(std::abs(slope - exact) <= bound + rounding);
            REQUIRE(n[1] == 0.0f);
        }
    }
}

TEST_CASE("normal_map: equal heights and single texels are flat to the bit (S-606)")
{
    for (const NormalFilter filter : kFilters) {
        for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {1, 4}, {4, 1}}) {
            for (const float value : {0.0f, 0.3f, 1.0f, 1e38f}) {
                const HeightField field = fieldBy(width, height, [value](int, int) { return value; });
                const MipLevel normals = normalsFromHeights(field, 16.0f, filter);
                for (int y = 0; y < height; ++y) {
                    for (int x = 0; x < width; ++x) REQUIRE(sameBits(normals.texel<float>(x, y), 0.0f, 0.0f, 1.0f));
                }
            }
        }
        const MipLevel noBumps = normalsFromHeights(fieldBy(4, 4, randomHeight), 0.0f, filter);
        CHECK(std::abs(noBumps.texel<float>(1, 2)[2]) == 1.0f);
    }
}

TEST_CASE("normal_map: borders are like any other place: shifted heights give shifted normals (S-610)")
{
    constexpr int kWidth = 9, kHeight = 6;
    const HeightField field = fieldBy(kWidth, kHeight, randomHeight);
    for (const NormalFilter filter : kFilters) {
        const MipLevel normals = normalsFromHeights(field, 0.3f, filter);
        for (const auto& [right, up] : {std::pair{1, 0}, {0, 1}, {4, 3}, {8, 5}}) {
            const int dx = right, dy = up;
            const HeightField shifted = fieldBy(kWidth, kHeight, [dx, dy](int x, int y) {
                return randomHeight((x + dx) % kWidth, (y + dy) % kHeight);
            });
            const MipLevel there = normalsFromHeights(shifted, 0.3f, filter);
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    const float* expected = normals.texel<float>((x + dx) % kWidth, (y + dy) % kHeight);
                    REQUIRE(std::memcmp(there.texel<float>(x, y), expected, 16) == 0);
                }
            }
        }
    }
}

TEST_CASE("normal_map: heights are the red channel, of any depth, rows from below")
{
    const HeightField bytes = heightsOf(Image8{1, 2, {255, 1, 2, 3, 51, 4, 5, 6}});
    CHECK(bytes.values == std::vector{0.2f, 1.0f});
    const HeightField shorts = heightsOf(Image16{2, 1, {1, 9, 9, 9, 65535, 9, 9, 9}});
    CHECK(shorts.values == std::vector{static_cast<float>(1.0 / 65535.0), 1.0f});
    CHECK(heightsOf(ImageFloat{1, 1, {2.5f, 0, 0, 0}}).values == std::vector{2.5f});

    CHECK(isGreyscale(Image8{2, 1, {5, 5, 5, 1, 7, 7, 7, 2}}));
    CHECK(!isGreyscale(Image8{2, 1, {5, 5, 5, 1, 7, 7, 8, 2}}));
    CHECK(!isGreyscale(Image16{1, 1, {5, 6, 5, 1}}));
}

TEST_CASE("normal_map: colours become unit vectors, those below the surface too, and no direction is flat")
{
    const Image8 picture{5, 1, {255, 128, 128, 255, 0, 127, 127, 9, 128, 128, 255, 255, 128, 128, 0, 0, 64, 64, 64, 1}};
    const MipLevel normals = normalsFromColors(picture);
    for (int x = 0; x < 5; ++x) {
        const float* n = normals.texel<float>(x, 0);
        CHECK(std::abs(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) - 1.0f) < 2e-7f);
    }
    for (int c = 0; c < 3; ++c) CHECK(normals.texel<float>(0, 0)[c] == -normals.texel<float>(1, 0)[c]);
    CHECK(normals.texel<float>(2, 0)[2] > 0.9999f);
    CHECK(normals.texel<float>(3, 0)[2] < -0.9999f);
    CHECK(normals.texel<float>(4, 0)[0] == -static_cast<float>(1.0 / std::sqrt(3.0)));

    const ImageFloat strange{3, 1, {0.5f, 0.5f, 0.5f, 1.0f, kNan, 0.5f, 1.0f, 1.0f, kInfinity, 0.5f, 1.0f, 1.0f}};
    const MipLevel flat = normalsFromColors(strange);
    for (int x = 0; x < 3; ++x) CHECK(sameBits(flat.texel<float>(x, 0), 0.0f, 0.0f, 1.0f));
}

TEST_CASE("normal_map: opposite normals average to nothing, and that is flat (S-618)")
{
    const Image8 opposite{2, 2, {255, 200, 10, 255, 0, 55, 245, 255, 3, 4, 5, 6, 252, 251, 250, 6}};
    const MipLevel means = coarserLevel(TexelFormat::rgba32Float, normalsFromColors(opposite));
    CHECK(sameBits(normalizedNormals(means).texel<float>(0, 0), 0.0f, 0.0f, 1.0f));

    MipLevel shortened(TexelFormat::rgba32Float, 1, 1);
    shortened.texel<float>(0, 0)[0] = 0.25f;
    CHECK(sameBits(normalizedNormals(shortened).texel<float>(0, 0), 1.0f, 0.0f, 0.0f));
}

TEST_CASE("normal_map: fading turns normals towards flat and keeps them unit length")
{
    const HeightField right = fieldBy(8, 4, [](int x, int) { return x / 8.0; });
    const MipLevel normals = normalsFromHeights(right, 0.75f, NormalFilter::smooth);
    MipLevel untouched = normals, half = normals, gone = normals;
    fadeToFlat(untouched, 0.0);
    fadeToFlat(half, 0.5);
    fadeToFlat(gone, 1.0);
    CHECK(sameBits(untouched.texel<float>(2, 2), -0.6f, 0.0f, 0.8f));
    const float* n = half.texel<float>(2, 2);  // (-0.3, 0, 0.9), and the ratio stays
    CHECK(n[0] / n[2] == doctest::Approx(-1.0 / 3.0).epsilon(1e-6));
    CHECK(n[0] * n[0] + n[2] * n[2] == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(sameBits(gone.texel<float>(2, 2), 0.0f, 0.0f, 1.0f));
}

TEST_CASE("normal_map: codes are the nearest, in red, green and blue or in alpha and green")
{
    MipLevel normals(TexelFormat::rgba32Float, 3, 1);
    const float vectors[3][3] = {{0.0f, 0.0f, 1.0f}, {-1.0f, 0.0f, 0.0f}, {0.6f, -0.28f, 0.0f}};
    for (int x = 0; x < 3; ++x) std::memcpy(normals.texel<float>(x, 0), vectors[x], 12);
    const MipLevel rgb = encodeNormals(normals, NormalChannels::rgb);
    const MipLevel ag = encodeNormals(normals, NormalChannels::alphaGreen);
    const std::uint8_t codes[3][4] = {{128, 128, 255, 255}, {0, 128, 128, 255}, {204, 92, 128, 255}};
    for (int x = 0; x < 3; ++x) {
        const std::uint8_t swizzled[] = {255, codes[x][1], 255, codes[x][0]};
        CHECK(std::memcmp(rgb.texel<std::uint8_t>(x, 0), codes[x], 4) == 0);
        CHECK(std::memcmp(ag.texel<std::uint8_t>(x, 0), swizzled, 4) == 0);
    }
    CHECK(ag.texel<std::uint8_t>(-1, 1)[3] == 204);  // the frame
}

TEST_CASE("normal_map: S-609 of an 8-bit staircase the slope is off by less than a code, of 16 bits by a 256th of that")
{
    // 1/16 of a code per texel. Bumpiness makes one code per texel a slope of 1.
    const auto worst = [](auto height) {
        const HeightField field = fieldBy(256, 1, height);
        const MipLevel normals = normalsFromHeights(field, 255.0f / 256.0f, NormalFilter::smooth);
        double off = 0.0;
        for (int x = 0; x < 255; ++x) {
            const float* n = normals.texel<float>(x, 0);
            off = std::fmax(off, std::abs(-static_cast<double>(n[0]) / static_cast<double>(n[2]) - 1.0 / 16.0));
        }
        return off;
    };
    const double coarse = worst([](int x, int) { return std::floor(x / 16.0 + 0.5) / 255.0; });
    measured("slope off in 8 bits, of 1 a code", coarse, 1.0);
    CHECK(coarse > 0.9);  // flat and steep in turn
    measured("slope off in 16 bits", worst([](int x, int) { return std::floor(x / 16.0 * 257.0 + 0.5) / 65535.0; }),
             1.0 / 256.0);
}

// Levels of detail: the table of reference values, and what must hold for any derivatives. Then the same through a
// sampler, with limits and bias.
#include "relief/texture/level_of_detail.h"

#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "numbers.h"
#include "relief/texture/sampler.h"
#include "sampler_fixture.h"

using namespace sampler_fixture;

namespace {

float isotropic(float xu, float xv, float yu, float yv)
{
    return isotropicLevel({Float(xu), Float(xv)}, {Float(yu), Float(yv)})[0];
}

AnisotropicFootprint anisotropic(float xu, float xv, float yu, float yv, float limit = 16.0f)
{
    return anisotropicFootprint({Float(xu), Float(xv)}, {Float(yu), Float(yv)}, limit);
}

// A square texture whose neighbouring texels differ, and so do its levels.
Texture ramp(int side)
{
    std::vector<float> pixels;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const auto value = static_cast<float>((x * 7 + y * 13) % 16);
            pixels.insert(pixels.end(), {value, value, value, 1.0f});
        }
    }
    return *Texture::fromRgbaFloat(side, side, pixels);
}

// The level that a sampler uses for a given change of u per pixel to the right, in texels.
float levelFor(const sampler2D& s, float texelsPerPixel)
{
    const float perPixel = texelsPerPixel / static_cast<float>(s.texture->width());
    const Float u = perLane([=](int i) { return static_cast<float>(laneX(i)) * perPixel; });
    return calculateLevelOfDetail(s, {u, Float(0.0f)})[0];
}

}  // namespace

TEST_CASE("level_of_detail: isotropic levels of the reference table (T-06, A-27)")
{
    struct Row
    {
        float xu, xv, yu, yv, level;
    };
    const std::array rows = {Row{1, 0, 0, 1, 0.0f},  Row{4, 0, 0, 1, 2.0f},       Row{3, 4, -4, 3, 2.32193f},
                             Row{2, 2, 2, 2, 1.5f},  Row{1, 0, 0.8f, 0.6f, 0.0f}, Row{16, 0, 0, 0.25f, 4.0f},
                             Row{64, 0, 0, 1, 6.0f}, Row{0.5f, 0, 0, 0.5f, -1.0f}};
    for (const Row& row : rows) {
        CHECK(isotropic(row.xu, row.xv, row.yu, row.yv) == doctest::Approx(row.level).epsilon(1e-5));
    }
    CHECK(isotropic(0, 0, 0, 0) == -kInfinity);
}

TEST_CASE("level_of_detail: anisotropic ratios and levels of the reference table (T-06, A-30, S-504, S-506)")
{
    struct Row
    {
        float xu, xv, yu, yv, ratio, level;
    };
    const std::array rows = {Row{1, 0, 0, 1, 1.0f, 0.0f},
                             Row{4, 0, 0, 1, 4.0f, 0.0f},
                             Row{3, 4, -4, 3, 1.0f, 2.32193f},
                             Row{2, 2, 2, 2, 2.82843f, -2.5f},
                             Row{1, 0, 0.8f, 0.6f, 1.0f, -0.736966f},
                             Row{16, 0, 0, 0.25f, 16.0f, 0.0f},
                             Row{64, 0, 0, 1, 16.0f, 2.0f},
                             Row{0.5f, 0, 0, 0.5f, 1.0f, -1.0f}};
    for (const Row& row : rows) {
        CAPTURE(row.xu);
        const AnisotropicFootprint footprint = anisotropic(row.xu, row.xv, row.yu, row.yv);
        CHECK(footprint.ratio[0] == doctest::Approx(row.ratio).epsilon(1e-5));
        CHECK(footprint.lod[0] == doctest::Approx(row.level).epsilon(1e-5));
        CHECK(footprint.taps[0] == std::ceil(footprint.ratio[0]));
    }
    CHECK(anisotropic(0, 0, 0, 0).ratio[0] == 1.0f);
    CHECK(anisotropic(0, 0, 0, 0).lod[0] == -kInfinity);
}

TEST_CASE("level_of_detail: taps stay in 1..16 for any ratio, and lie along the longer derivative (S-562)")
{
    for (const float ratio : {1e6f, 1e-6f, 0.0f, 1e30f, 17.0f, 15.5f, kInfinity, kNan}) {
        const AnisotropicFootprint footprint = anisotropic(8.0f * ratio, 0, 0, 8.0f);
        CHECK(footprint.taps[0] >= 1.0f);
        CHECK(footprint.taps[0] <= 16.0f);
        CHECK(footprint.taps[0] == std::floor(footprint.taps[0]));
    }
    CHECK(anisotropic(1, 2, 8, 4).axis.x[0] == 8.0f);
    CHECK(anisotropic(8, 4, 1, 2).axis.y[0] == 4.0f);
    CHECK(anisotropic(12, 0, 0, 1, 4.0f).taps[0] == 4.0f);
}

TEST_CASE("level_of_detail: a million random derivatives: never falls when one grows, and within bounds (S-507, S-508)")
{
    Random random(1);
    int fell = 0, outside = 0;
    for (int block = 0; block < 1000000 / kLanes; ++block) {
        const Float scale = perLane([&](int) { return std::exp2(random(-10.0f, 10.0f)); });
        Float partials[4];
        for (Float& partial : partials) partial = perLane([&](int) { return random(-1.0f, 1.0f); }) * scale;
        Float grown[4] = {partials[0], partials[1], partials[2], partials[3]};
        grown[block % 4] *= perLane([&](int) { return 1.0f + random(0.0f, 0.01f); });
        const Float level = isotropicLevel({partials[0], partials[1]}, {partials[2], partials[3]});
        const Float larger = isotropicLevel({grown[0], grown[1]}, {grown[2], grown[3]});
        fell += count(larger < level);
        const Float mu = max(abs(partials[0]), abs(partials[2])), mv = max(abs(partials[1]), abs(partials[3]));
        const float slack = 1.0f / 256.0f;
        outside += count((level < log2(max(mu, mv)) - slack) | (level > log2(mu + mv) + slack));
    }
    measured("levels that fell", fell, 0);
    measured("levels out of the limits", outside, 0);
}

TEST_CASE("level_of_detail: no step back between any two neighbouring floats, across octaves (S-507)")
{
    float last = -kInfinity;
    int fell = 0;
    for (int mantissa = 0; mantissa < 1 << 24; mantissa += kLanes) {
        Float square = asFloat(Int(0x3f800000 + mantissa) + laneNumbers());
        const Float level = 0.5f * log2(square);
        fell += count(permuteQuad<1, 2, 3, 3>(level) < level) + (level[0] < last ? 1 : 0);
        last = level[kLanes - 1];
    }
    measured("levels that fell", fell, 0);
}

TEST_CASE("level_of_detail: NaN and infinite derivatives give the sampler's maxLod, none at all minLod (S-504, S-505)")
{
    const Texture texture = ramp(64);
    sampler2D s{.texture = &texture, .minLod = 0.5f, .maxLod = 3.25f};
    CHECK(levelFor(s, kNan) == 3.25f);
    CHECK(levelFor(s, kInfinity) == 3.25f);
    CHECK(levelFor(s, 0.0f) == 0.5f);
    CHECK(isnan(longestSquare({Float(kNan), Float(0.0f)}, {Float(4.0f), Float(4.0f)})).bits() == kAllLanes);
    CHECK(isnan(longestSquare({Float(4.0f), Float(4.0f)}, {Float(0.0f), Float(kNan)})).bits() == kAllLanes);

    // The same through gradients given directly, in colours: maxLod 0 is level 0, maxLod 100 the last level.
    const float2 centre = {Float(0.5f / 64.0f), Float(0.5f / 64.0f)}, bad = {Float(kNan), Float(kNan)};
    s = {.texture = &texture, .maxLod = 0.0f};
    CHECK(tex2Dgrad(s, centre, bad, bad).x[0] == texture.texel(0, 0).x);
    s.maxLod = 100.0f;
    CHECK(tex2Dgrad(s, centre, bad, bad).x[0] == *texture.level(6).texel<float>(0, 0));
}

TEST_CASE("level_of_detail: minLod wins over maxLod, any bias stays within the levels (S-510, S-511)")
{
    const Texture texture = ramp(64);
    sampler2D s{.texture = &texture};
    s.minLod = 4.0f;
    s.maxLod = 2.0f;
    CHECK(levelFor(s, 1.0f) == 4.0f);
    s = {.texture = &texture};
    CHECK(levelFor(s, 4.0f) == 2.0f);
    for (const float bias : {-16.0f, 16.0f, -1e30f, 1e30f, kNan, kInfinity, -kInfinity}) {
        s.lodBias = bias;
        CAPTURE(bias);
        CHECK(levelFor(s, 4.0f) >= 0.0f);
        CHECK(levelFor(s, 4.0f) <= 6.0f);
        CHECK(tex2D(s, {Float(0.3f), Float(0.3f)}).x[0] >= 0.0f);
        CHECK(tex2Dbias(s, float4(Float(0.3f), Float(0.3f), Float(0.0f), Float(bias))).x[0] >= 0.0f);
    }
    s.lodBias = 1.5f;
    CHECK(levelFor(s, 4.0f) == 3.5f);
    s.lodBias = 0.0f;
    const float last = *texture.level(6).texel<float>(0, 0);
    CHECK(tex2Dlod(s, float4(Float(0.3f), Float(0.7f), Float(0.0f), Float(1e9f))).x[0] == last);
    CHECK(tex2Dlod(s, float4(Float(0.3f), Float(0.7f), Float(0.0f), Float(kNan))).x[0] == last);
}

TEST_CASE("level_of_detail: colours change without a step where levels meet (S-509, A-26)")
{
    const Texture texture = ramp(64);
    const sampler2D s{.texture = &texture};
    const float range = 15.0f;
    int steps = 0, changes = 0;
    float last = tex2Dlod(s, float4(Float(0.21f), Float(0.37f), Float(0.0f), Float(0.9f))).x[0];
    for (int i = 1; i < 3000; ++i) {
        const float lod = 0.9f + static_cast<float>(i) / 2048.0f;
        const float colour = tex2Dlod(s, float4(Float(0.21f), Float(0.37f), Float(0.0f), Float(lod))).x[0];
        steps += std::abs(colour - last) > range / 256.0f + range / 255.0f ? 1 : 0;
        changes += colour != last ? 1 : 0;
        last = colour;
    }
    measured("steps", steps, 0);
    CHECK(changes > 300);
}

TEST_CASE("level_of_detail: a seam in uv reaches the smallest level, gradients given by hand do not (S-503)")
{
    const Texture texture = ramp(256);
    const sampler2D s{.texture = &texture};
    const Float u = perLane([](int i) { return (laneX(i) & 1) != 0 ? 0.005f : 0.995f; });
    const float2 uv = {u, Float(0.5f)};
    CHECK(calculateLevelOfDetail(s, uv)[0] > 7.9f);

    const float2 dx = {Float(0.01f), Float(0.0f)}, dy = {Float(0.0f), Float(0.01f)};
    const float expected = isotropic(2.56f, 0.0f, 0.0f, 2.56f);
    const float4 byGradients = tex2Dgrad(s, uv, dx, dy);
    const float4 byLevel = tex2Dlod(s, float4(uv.x, uv.y, Float(0.0f), Float(expected)));
    for (int i = 0; i < kLanes; ++i) CHECK(byGradients.x[i] == byLevel.x[i]);
}

TEST_CASE("level_of_detail: a plane near the horizon is off by log2(1 + 1/D), as differences must be (S-502, S-512)")
{
    const Texture texture = ramp(256);
    const sampler2D s{.texture = &texture};
    for (const int distance : {1, 2, 4, 8, 16, 32, 64, 128, 256}) {
        // v = c / D, D pixels from the horizon: the exact derivative is c / D^2, the quad's c / D - c / (D + 1).
        const double c = 0.5 * distance * distance;
        const Float v = perLane([=](int i) { return static_cast<float>(c / (distance + (laneY(i) & 1))); });
        const float level = calculateLevelOfDetailUnclamped(s, {Float(0.0f), v})[0];
        const double exact = std::log2(256.0 * c / (distance * distance));
        measured("levels off", std::abs(exact - level - std::log2(1.0 + 1.0 / distance)), 1.0 / 256.0);
    }
}

TEST_CASE("level_of_detail: coordinates as large as 1e7 give a finite level (S-513)")
{
    const Texture texture = ramp(256);
    const sampler2D s{.texture = &texture};
    const Float u = perLane([](int i) { return 1e7f + static_cast<float>(laneX(i)); });
    const float level = calculateLevelOfDetail(s, {u, u})[0];
    CHECK(level >= 0.0f);
    CHECK(level <= 8.0f);
}

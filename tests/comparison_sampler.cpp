// SampleCmp against the definition, in double.
#include "relief/texture/comparison_sampler.h"

#include <doctest/doctest.h>

#include <bit>

#include "numbers.h"
#include "pipeline_fixture.h"
#include "sampler_fixture.h"

using namespace fixture;
using sampler_fixture::address;
using sampler_fixture::kModes;
using sampler_fixture::randomTexture;

namespace {

bool holds(Compare compare, float a, float b)
{
    return any(compareBy(compare, Float(a), Float(b)));
}

// The share of the four texels that pass; texel centres are half a texel from the edges.
double shareOf(const SamplerComparisonState& s, double u, double v, float reference)
{
    const Texture& t = *s.texture;
    const double x = u * t.width() - 0.5, y = v * t.height() - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const auto passes = [&](int dx, int dy) {
        const int a = address(s.u, i + dx, t.width()), b = address(s.v, j + dy, t.height());
        return holds(s.comparison, reference, a < 0 || b < 0 ? s.border : t.texel(a, b).x) ? 1.0 : 0.0;
    };
    const double fx = x - i, fy = y - j;
    return (passes(0, 0) * (1.0 - fx) + passes(1, 0) * fx) * (1.0 - fy) +
           (passes(0, 1) * (1.0 - fx) + passes(1, 1) * fx) * fy;
}

}  // namespace

TEST_CASE("SampleCmp: the comparisons' results are weighted, in every mode and format")
{
    Random random(81);
    double largest = 0.0;
    int wrongWhole = 0;
    for (const TexelFormat format : sampler_fixture::kFormats) {
        const Texture texture = randomTexture(format, 13, 9);
        for (const AddressMode mode : kModes) {
            for (int compare = 0; compare < 8; ++compare) {
                const SamplerComparisonState s = {&texture, static_cast<Compare>(compare), mode,
                                                  kModes[random.between(0, 3)], 0.25f};
                for (int trial = 0; trial < trials(40); ++trial) {
                    // Multiples of 1/64 of a texel: positions are exact.
                    const auto place = [&](int side) {
                        return static_cast<float>(random.between(-64 * side, 128 * side)) /
                               static_cast<float>(64 * side);
                    };
                    float2 uv;
                    Float reference;
                    for (int lane = 0; lane < kLanes; ++lane) {
                        uv.x.set(lane, place(13));
                        uv.y.set(lane, place(9));
                        const glm::vec4 texel = texture.texel(random.between(0, 12), random.between(0, 8));
                        reference.set(lane, random.chance(2) ? texel.x : random.chance(9) ? 0.25f : 0.1f);
                    }
                    const Float share = SampleCmp(s, uv, reference);
                    for (int lane = 0; lane < kLanes; ++lane) {
                        const auto expected = shareOf(s, static_cast<double>(uv.x[lane]),
                                                      static_cast<double>(uv.y[lane]), reference[lane]);
                        largest = std::max(largest, std::abs(expected - static_cast<double>(share[lane])));
                        if (expected == 0.0 || expected == 1.0)
                            wrongWhole += static_cast<double>(share[lane]) != expected;
                    }
                }
            }
        }
    }
    // A coordinate's rounding, times a texture's side, is a part of a texel.
    measured("error of a share", largest, 1.0 / 2048.0);
    CHECK(wrongWhole <= 2);
}

TEST_CASE("SampleCmp: NaN, infinities, one texel, and no texture at all")
{
    const Texture one = *Texture::fromRed(1, 1, std::array{0.5f});
    SamplerComparisonState s = {&one, Compare::lessEqual, AddressMode::clamp, AddressMode::clamp};
    const auto share = [&](float u, float reference) {
        return SampleCmp(s, float2(Float(u), Float(0.5f)), reference)[0];
    };
    for (const float u : {0.5f, kNan, kInfinity, -kInfinity, 3e38f}) {
        CHECK(share(u, 0.5f) == 1.0f);
        CHECK(share(u, 0.6f) == 0.0f);
        CHECK(share(u, kNan) == 0.0f);
        CHECK(share(u, -kInfinity) == 1.0f);
    }
    s.u = s.v = AddressMode::border;
    CHECK(share(17.0f, 0.75f) == 1.0f);
    s.border = 0.0f;
    CHECK(share(17.0f, 0.75f) == 0.0f);
    s.texture = nullptr;
    s.u = s.v = AddressMode::clamp;
    CHECK(share(0.5f, 1.0f) == 1.0f);
    CHECK(share(0.5f, 1.5f) == 0.0f);
}

TEST_CASE("SampleCmp: of a cube, each lane asks the face that its direction passes through")
{
    std::vector<Texture> faces;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        faces.push_back(randomTexture(TexelFormat::r32Float, 16, 16, face + 1));
    SamplerCubeComparisonState s;
    for (std::size_t face = 0; face < faces.size(); ++face) s.faces[face] = &faces[face];
    Random random(5);
    int different = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        int face[kLanes];
        float2 uv;
        float3 direction;
        for (int lane = 0; lane < kLanes; ++lane) {
            face[lane] = random.between(0, 5);
            different += face[lane] != face[0];
            // Multiples of 1/64 of a texel, not on the edge itself, which two faces share.
            const float u = static_cast<float>(random.between(1, 1023)) / 1024.0f;
            const float v = static_cast<float>(random.between(1, 1023)) / 1024.0f;
            uv.x.set(lane, u);
            uv.y.set(lane, v);
            const float3 d = cubeDirection(face[lane], 2.0f * u - 1.0f, 2.0f * v - 1.0f) * 4.0f;  // any length
            for (int c = 0; c < 3; ++c) direction[c].set(lane, d[c][0]);
        }
        const Float reference = static_cast<float>(random.between(0, 1000)) / 1000.0f;
        const Float share = SampleCmp(s, direction, reference);
        for (int lane = 0; lane < kLanes; ++lane) {
            const SamplerComparisonState one = {s.faces[static_cast<std::size_t>(face[lane])], s.comparison,
                                                AddressMode::clamp, AddressMode::clamp};
            CHECK(share[lane] == SampleCmp(one, uv, reference)[lane]);
        }
    }
    CHECK(different > trials(300) * (kLanes - 1) / 2);

    const float3 nowhere(Float(0.0f));
    const Float share = SampleCmp(s, nowhere, 0.5f);
    CHECK((share[0] >= 0.0f && share[0] <= 1.0f));
    CHECK(SampleCmp(SamplerCubeComparisonState{}, nowhere, 1.0f)[0] == 1.0f);
    CHECK(SampleCmp(SamplerCubeComparisonState{}, nowhere, 1.5f)[0] == 0.0f);
}

TEST_CASE("SampleCmp: of a cube, every lane that counts is counted once")
{
    const ShadingScope scope;
    float3 direction;
    for (int lane = 0; lane < kLanes; ++lane) {
        const float3 d = cubeDirection(lane % kCubeFaces, 0.25f, 0.5f);
        for (int c = 0; c < 3; ++c) direction[c].set(lane, d[c][0]);
    }
    SampleCmp(SamplerCubeComparisonState{}, direction, 0.5f);
    CHECK(shading.fetches.bilinear == static_cast<std::uint64_t>(kLanes));
    CHECK(shading.activeLanes == kAllLanes);
}

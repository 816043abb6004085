// SampleCmp against the definition, in double; and targets as textures.
#include "texture/comparison_sampler.h"

#include <doctest/doctest.h>

#include <bit>
#include <limits>

#include "pipeline/target_texture.h"
#include "pipeline_fixture.h"
#include "sampler_fixture.h"
#include "shading/loop.h"

using namespace fixture;
using sampler_fixture::address;
using sampler_fixture::kFormats;
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
    for (const TexelFormat format : kFormats) {
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
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
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

TEST_CASE("target as a texture: the pixels of every format, with row 0 above")
{
    constexpr Format kAll[] = {Format::rgba8, Format::rgba8Srgb, Format::rgba16f, Format::r32f, Format::rgba32f};
    Mesh mesh;
    addTriangle(mesh, {{Point{0, 0}, Point{40 * 256, 0}, Point{0, 40 * 256}}}, {0.25f, 0.5f, 0.75f, 1.0f}, 0.125f);
    for (const Format format : kAll) {
        Framebuffer target = *Framebuffer::create(19, 33, {{format}, {Format::depth32f}});
        const Viewport viewport = exactViewport(19, 33);
        Frame frame(target, {1, 16});
        frame.setViewport(viewport);
        frame.clear(glm::vec4(0.0f));
        REQUIRE(frame.draw(mesh, FromPixels(viewport), Value{}, kDepthTested));
        frame.run();
        const Texture color = *textureOf(target, 0), depth = *textureOf(target, 1);
        CHECK(color.width() == 19);
        CHECK(color.height() == 33);
        int wrong = 0;
        for (int y = 0; y < 33; ++y) {
            for (int x = 0; x < 19; ++x) {
                const auto at = static_cast<std::size_t>(y * 19 + x);
                const bool isDrawn = target.depth()[at] != 1.0f;
                const glm::vec4 texel = color.texel(x, 32 - y);
                const auto isNear = [](float a, float b) { return std::abs(a - b) < 0.01f; };
                wrong += depth.texel(x, 32 - y) != glm::vec4(target.depth()[at], 0.0f, 0.0f, 1.0f);
                wrong += !isNear(texel.x, isDrawn ? 0.25f : 0.0f);
                if (format == Format::r32f) continue;
                wrong += !isNear(texel.y, isDrawn ? 0.5f : 0.0f) || !isNear(texel.z, isDrawn ? 0.75f : 0.0f);
            }
        }
        CHECK(wrong == 0);
        CHECK(color.levelsBuilt() == 1);
        color.level(3);
        CHECK(color.levelsBuilt() == 4);
        CHECK_FALSE(std::isnan(color.level(2).texel<std::uint8_t>(0, 0)[0]));
    }
}

TEST_CASE("target as a texture: read while it is drawn into, it is what the last frame left")
{
    struct ReadsTarget
    {
        sampler2D last;
        float4 operator()(const Interpolated& i) const
        {
            const float2 uv = float2(i.position.x, 16.0f - i.position.y) / 16.0f;
            return tex2D(last, uv) * 2.0f + 1.0f;
        }
    };
    Framebuffer target = makeTarget(16, 16);
    const Mesh mesh = meshOf({{Point{0, 0}, Point{9000, 0}, Point{0, 9000}}});
    float expected = 0.0f;
    for (int pass = 0; pass < 4; ++pass) {
        const Texture last = *textureOf(target, 0);
        ReadsTarget program;
        program.last.texture = &last;
        program.last.filter = Filter::nearest;
        program.last.mipmaps = false;
        Frame frame(target, {2, 16});
        const Viewport viewport = exactViewport(16, 16);
        frame.setViewport(viewport);
        REQUIRE(frame.draw(mesh, FromPixels(viewport), program, kPaint));
        frame.run();
        expected = expected * 2.0f + 1.0f;
        CHECK(pixelsNotEqualTo(target, expected) == 0);
    }
}

TEST_CASE("target as a texture: what cannot be one is an error of one line")
{
    const Framebuffer target =
        *Framebuffer::create(8, 8, {{Format::rgba8}, {Format::depth32f, Store::discard}, {Format::stencil8}});
    const auto message = [&](int attachment) {
        const Expected<Texture> texture = textureOf(target, attachment);
        REQUIRE_FALSE(texture.has_value());
        CHECK(texture.error().message.find('\n') == std::string::npos);
        return texture.error().message;
    };
    CHECK(textureOf(target, 0).has_value());
    CHECK(message(1).find("Store::keep") != std::string::npos);
    CHECK(message(2).find("stencil") != std::string::npos);
    CHECK(message(3).find("has 3") != std::string::npos);
    CHECK(message(-1).find("counted from 0") != std::string::npos);
}

TEST_CASE("whileAny: each pixel goes on for itself, and only those that count keep it going")
{
    Int steps = 0;
    Mask running = true;
    int rounds = 0;
    whileAny(running, [&] {
        steps = select(running, steps + 1, steps);
        running &= steps < laneXs() + laneYs() * 2 + 1;
        ++rounds;
    });
    const Int expected = laneXs() + laneYs() * 2 + 1;
    CHECK(all(steps == expected));
    int most = 0;
    for (int lane = 0; lane < kLanes; ++lane) most = std::max(most, expected[lane]);
    CHECK(rounds == most);

    const ShadingScope scope;
    shading.activeLanes = 1;
    running = true;
    rounds = 0;
    whileAny(running, [&] {
        ++rounds;
        running &= Mask::fromBits(rounds < 3 ? kAllLanes : kAllLanes & ~1u);
    });
    CHECK(rounds == 3);
    running = false;
    whileAny(running, [&] { ++rounds; });
    CHECK(rounds == 3);
}

// Fading: where it begins and ends, even steps between, grey to the bit, and alpha untouched.
#include "relief/texture/mip_fade.h"

#include <algorithm>
#include <cstdlib>

#include <doctest/doctest.h>

#include "relief/shading/lighting.h"
#include "relief/texture/pixels.h"
#include "relief/texture/texture.h"
#include "stability.h"

using namespace relief;
using stability::measured;

namespace {

template <class Channel>
MipLevel oneTexel(TexelFormat format, Channel red, Channel alpha)
{
    MipLevel level(format, 1, 1);
    const Channel channels[] = {red, red, red, alpha};
    std::copy_n(channels, 4, level.texel<Channel>(0, 0));
    level.fillFrame();
    return level;
}

}  // namespace

TEST_CASE("mip_fade: nothing up to the first level, all from the last, even steps between")
{
    for (int level = 0; level < 8; ++level) {
        const Fade fade = fadeOfLevel(level, 1, 3);
        CHECK(fade.span == 2);
        CHECK(fade.step == (level <= 1 ? 0 : level >= 3 ? 2 : 1));
        const Fade sudden = fadeOfLevel(level, 2, 2);
        CHECK(sudden.step == (level >= 2 ? 1 : 0));
        CHECK(sudden.span == 1);
        CHECK(fadeOfLevel(level, 0, 7).step == level);
    }
}

TEST_CASE("mip_fade: codes are mixed with grey and rounded to nearest, alpha is not")
{
    for (int code = 0; code < 256; ++code) {
        for (int step = 0; step <= 3; ++step) {
            MipLevel level = oneTexel<std::uint8_t>(TexelFormat::rgba8, static_cast<std::uint8_t>(code), 7);
            fadeToGrey(TexelFormat::rgba8, ColorSpace::linear, level, {step, 3});
            const std::uint8_t* texel = level.texel<std::uint8_t>(0, 0);
            REQUIRE(std::abs(3 * texel[0] - (code * (3 - step) + 128 * step)) <= 1);
            REQUIRE(texel[3] == 7);
            REQUIRE(level.texel<std::uint8_t>(-1, 1)[2] == texel[2]);  // the frame too
        }
    }
    MipLevel wide = oneTexel<std::uint16_t>(TexelFormat::rgba16, 65535, 9);
    fadeToGrey(TexelFormat::rgba16, ColorSpace::linear, wide, {1, 2});
    CHECK(wide.texel<std::uint16_t>(0, 0)[1] == (65535 + 128 * 257 + 1) / 2);
    MipLevel bright = oneTexel<float>(TexelFormat::rgba32Float, 2.5f, 9.0f);
    fadeToGrey(TexelFormat::rgba32Float, ColorSpace::srgb, bright, {1, 2});
    CHECK(bright.texel<float>(0, 0)[0] == 1.5f);
    CHECK(bright.texel<float>(0, 0)[3] == 9.0f);
}

TEST_CASE("mip_fade: light is faded in sRGB codes, and ends at exactly Texture::grey()")
{
    const std::uint16_t light = srgbToLinear16(std::uint8_t{200});
    for (int step = 0; step <= 4; ++step) {
        MipLevel level = oneTexel<std::uint16_t>(TexelFormat::rgba16, light, 500);
        fadeToGrey(TexelFormat::rgba16, ColorSpace::srgb, level, {step, 4});
        const std::uint16_t* texel = level.texel<std::uint16_t>(0, 0);
        CHECK(std::abs(encodeSrgb16(texel[0]) - (200 * (4 - step) + 128 * step) * 257 / 4) <= 20);  // 0.08 of a code
        CHECK(texel[3] == 500);
        if (step == 0) CHECK(texel[0] == light);
        if (step == 4) CHECK(texel[0] == Texture::grey().level(0).texel<std::uint16_t>(0, 0)[0]);
    }
}

TEST_CASE("mip_fade: S-565 a detail texture that has faded to grey darkens by less than 2 %, as documented")
{
    // Unity's factor is 2 in gamma space brought to linear light; 128 is a little more than one half, 0.5 a little
    // less.
    const double byCode =
        static_cast<double>(Texture::grey().texel(0, 0).x) * static_cast<double>(unity_ColorSpaceDouble);
    const double byHalf = decodeSrgb(0.5) * static_cast<double>(unity_ColorSpaceDouble);
    measured("off 0.991834, code 128", std::abs(byCode - 0.991834), 4e-5);  // 16 bits of light
    measured("off 0.983475, 0.5", std::abs(byHalf - 0.983475), 1e-6);
}

// Pixels to level 0: formats and orders are held by texture.cpp; here what importers add, and the tables of the curve.
#include "relief/texture/pixels.h"

#include <cstdlib>

#include <doctest/doctest.h>

using namespace relief;

TEST_CASE("pixels: a picture's format follows its codes and what they mean")
{
    const ImageFile bytes = Image8{1, 1, {1, 2, 3, 4}}, shorts = Image16{1, 1, {1, 2, 3, 4}};
    const ImageFile floats = ImageFloat{1, 1, {1.0f, 2.0f, 3.0f, 4.0f}};
    CHECK(formatOf(bytes, ColorSpace::linear) == TexelFormat::rgba8);
    CHECK(formatOf(bytes, ColorSpace::srgb) == TexelFormat::rgba16);
    CHECK(formatOf(shorts, ColorSpace::linear) == TexelFormat::rgba16);
    CHECK(formatOf(shorts, ColorSpace::srgb) == TexelFormat::rgba16);
    CHECK(formatOf(floats, ColorSpace::srgb) == TexelFormat::rgba32Float);
    CHECK(levelFromPicture(bytes, ColorSpace::linear).texel<std::uint8_t>(0, 0)[2] == 3);
    CHECK(levelFromPicture(bytes, ColorSpace::srgb).texel<std::uint16_t>(0, 0)[3] == 4 * 257);
    CHECK(levelFromPicture(shorts, ColorSpace::linear).texel<std::uint16_t>(0, 0)[0] == 1);
    CHECK(levelFromPicture(floats, ColorSpace::srgb).texel<float>(0, 0)[1] == 2.0f);
}

TEST_CASE("pixels: a picture that is no texture is one line")
{
    CHECK(problemWithPixels(ImageFile(Image8{1, 1, {1, 2, 3, 4}})).empty());
    for (const ImageFile& bad : {ImageFile(Image8{2, 1, {1, 2, 3, 4}}), ImageFile(Image16{0, 1, {}}),
                                 ImageFile(ImageFloat{16385, 1, {}}), ImageFile(Image8{1, -1, {}})}) {
        const std::string problem = problemWithPixels(bad);
        CHECK(!problem.empty());
        CHECK(problem.find('\n') == std::string::npos);
    }
}

TEST_CASE("pixels: every 8-bit sRGB code survives the way to 16 bits of light and back")
{
    for (int code = 0; code < 256; ++code) {
        const std::uint16_t light = srgbToLinear16(static_cast<std::uint8_t>(code));
        const auto wide = static_cast<std::uint16_t>(code * 257);
        REQUIRE(decodeSrgb16(wide) == light);
        REQUIRE((encodeSrgb16(light) + 128) / 257 == code);
        REQUIRE(std::abs(encodeSrgb16(light) - wide) <= 10);  // 0.04 of a code
    }
    CHECK(encodeSrgb16(0) == 0);
    CHECK(encodeSrgb16(65535) == 65535);
}

// What a comparison has to find: ranges whose both ends hold, floats by bits and ULP, squares of 8x8 pixels.
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "relief/check/compare.h"
#include "relief/check/golden.h"
#include "temporary_folder.h"

namespace {

using namespace relief;

template <class Channel>
ImageOf<Channel> grey(int width, int height, Channel value)
{
    return {width, height, std::vector<Channel>(static_cast<std::size_t>(width * height) * 4, value)};
}

Comparison compared(const ImageFile& a, const ImageFile& b)
{
    const Expected<Comparison> comparison = compare(a, b);
    REQUIRE(comparison);
    return *comparison;
}

bool sameAs(const ImageFile& file, const Image8& picture)
{
    const auto* const image = std::get_if<Image8>(&file);
    return image != nullptr && image->width == picture.width && image->height == picture.height &&
           image->pixels == picture.pixels;
}

float after(float value, int steps)
{
    for (int i = 0; i < steps; ++i) value = std::nextafter(value, std::numeric_limits<float>::infinity());
    return value;
}

}  // namespace

TEST_CASE("check: a tolerance fails where the picture is worse, and where it is better")
{
    const Image8 golden = grey<std::uint8_t>(20, 20, 100);
    Image8 picture = golden;
    for (std::size_t i = 0; i < 50; ++i) picture.pixels[i * 4] = i < 25 ? 101 : 102;
    const Comparison comparison = compared(picture, golden);
    CHECK(comparison.differing == 50);
    CHECK(comparison.largest == 2);
    CHECK(comparison.breaks({.pixels = {40, 60}, .largest = {1, 2}, .window8x8 = {}}) == "");
    CHECK(comparison.breaks({.pixels = {50, 50}, .largest = {2, 2}, .window8x8 = 24}) == "");
    CHECK(comparison.breaks({.pixels = {40, 49}, .largest = {1, 2}, .window8x8 = {}}) ==
          "50 pixels differ, the tolerance is 40-49");
    CHECK(comparison.breaks({.pixels = {51, 60}, .largest = {1, 2}, .window8x8 = {}}) ==
          "50 pixels differ, the tolerance is 51-60 (the picture is better than that: measure the range again)");
    CHECK(
        comparison.breaks({.pixels = {40, 60}, .largest = {3, 4}, .window8x8 = {}}) ==
        "the largest difference is 2, the tolerance is 3-4 (the picture is better than that: measure the range again)");
    CHECK(comparison.breaks({.pixels = {40, 60}, .largest = {1, 2}, .window8x8 = 23}) ==
          "24 of them lie in a square of 8x8, the tolerance is 0-23");
    CHECK(comparison.breaks({}) == "50 pixels differ");
    CHECK(compared(golden, golden).breaks({.pixels = {1, 60}, .largest = {1, 2}, .window8x8 = {}}).find("better") !=
          std::string::npos);
}

TEST_CASE("check: a tolerance as text and back, and words that are none")
{
    for (const char* text : {"", "pixels=40-60,largest=1-2,window8x8=3", "pixels=7,largest=1"}) {
        const Expected<Tolerance> tolerance = toleranceOf(text);
        REQUIRE(tolerance);
        CHECK(textOf(*tolerance) == text);
    }
    CHECK(textOf(*toleranceOf("largest=1-2 pixels=0-9")) == "pixels=0-9,largest=1-2");
    for (const char* text : {"pixels", "pixels=", "pixels=x", "pixels=9-3,largest=1", "pixels=1-",
                             "pixels=1,largest=1,size=3", "pixels=-3,largest=1", "pixels=3", "largest=1",
                             "window8x8=2-3,pixels=1,largest=1", "pixels=99999999999999999999,largest=1"}) {
        CAPTURE(text);
        const Expected<Tolerance> tolerance = toleranceOf(text);
        REQUIRE_FALSE(tolerance);
        CHECK(tolerance.error().message.find(text) != std::string::npos);
    }
}

TEST_CASE("check: the densest square of 8x8 is found wherever it lies, in pictures of any size")
{
    std::mt19937 random(5);
    for (int trial = 0; trial < 60; ++trial) {
        const int width = 1 + static_cast<int>(random() % 30), height = 1 + static_cast<int>(random() % 30);
        const Image8 golden = grey<std::uint8_t>(width, height, 9);
        Image8 picture = golden;
        const auto rarity = 2 + random() % 20;
        for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
            if (random() % rarity == 0) picture.pixels[i + 3] = 8;
        std::uint64_t most = 0;
        for (int top = 0; top < height; ++top) {
            for (int left = 0; left < width; ++left) {
                std::uint64_t count = 0;
                for (int y = top; y < std::min(height, top + 8); ++y) {
                    for (int x = left; x < std::min(width, left + 8); ++x)
                        count += picture.pixels[static_cast<std::size_t>(y * width + x) * 4 + 3] != 9 ? 1 : 0;
                }
                most = std::max(most, count);
            }
        }
        CHECK(compared(picture, golden).window8x8 == most);
    }
}

TEST_CASE("check: floats are the same where their bits are, and as far apart as there are floats between them")
{
    const auto steps = [](float a, float b) {
        ImageFloat picture = grey<float>(1, 1, 1.0f), golden = picture;
        picture.pixels[1] = a;
        golden.pixels[1] = b;
        const Comparison comparison = compared(picture, golden);
        CHECK(comparison.same() == (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b)));
        CHECK(compared(golden, picture).largest == comparison.largest);
        return comparison.largest;
    };
    CHECK(steps(0.5f, 0.5f) == 0);
    CHECK(steps(after(0.5f, 1), 0.5f) == 1);
    CHECK(steps(after(1.0f, 7), 1.0f) == 7);
    CHECK(steps(after(-1.0f, 7), -1.0f) == 7);
    CHECK(steps(0.0f, -0.0f) == 1);  // two different bits
    CHECK(steps(after(0.0f, 2), after(-0.0f, 3)) == 1);
    CHECK(steps(1e-45f, -1e-45f) == 2);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(steps(nan, nan) == 0);
    CHECK(steps(nan, 1.0f) == std::uint64_t{1} << 32);
    CHECK(steps(1.7e38f, -1.7e38f) < std::uint64_t{1} << 32);
}

TEST_CASE("check: pictures of 16 bits are compared with all of them, and with no picture of 8")
{
    const Image16 golden = grey<std::uint16_t>(4, 4, 1000);
    Image16 picture = golden;
    picture.pixels[4 * 5 + 2] = 1003;
    const Comparison comparison = compared(picture, golden);
    CHECK(comparison.differing == 1);
    CHECK(comparison.largest == 3);
    CHECK(comparison.first[0].actual[2] == 1003.0);
    CHECK(comparison.amplified[4 * 5 + 2] == 32);  // two doublings
    CHECK_FALSE(compare(picture, grey<std::uint8_t>(4, 4, 3)));
    CHECK_FALSE(compare(golden, grey<std::uint16_t>(4, 5, 1000)));
}

TEST_CASE("check: a damaged PNG is an error or a picture, and a comparison stays within both")
{
    const TemporaryFolder folder;
    Image8 golden = grey<std::uint8_t>(17, 11, 40);
    for (std::size_t i = 0; i < golden.pixels.size(); ++i) golden.pixels[i] = static_cast<std::uint8_t>(i * 7);
    const Expected<std::vector<std::uint8_t>> png = encodePng("golden", 17, 11, golden.pixels);
    REQUIRE(png);
    std::mt19937 random(7);
    int pictures = 0, errors = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<std::uint8_t> bytes = *png;
        for (unsigned k = 0; k <= random() % 4; ++k)
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        if (random() % 3 == 0) bytes.resize(random() % bytes.size());
        const Expected<ImageFile> file = decodeImage(bytes, "damaged");
        file ? ++pictures : ++errors;
        const GoldenRecord record = judge({.name = "damaged",
                                           .golden = folder.path.string() + "/golden.png",
                                           .actual = "",
                                           .failures = folder.path.string(),
                                           .tolerance = {},
                                           .updating = ""},
                                          ImageFile(golden), file);
        CHECK(record.passes() == (file && sameAs(*file, golden)));
    }
    CHECK(pictures > 5);
    CHECK(errors > 300);
}

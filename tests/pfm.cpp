// PFM files: what is written comes back bit for bit, other programs' kinds decode, bad ones are one clear line.
#include "relief/texture/pfm.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "contents.h"
#include "relief/pipeline/save.h"
#include "temporary_folder.h"

using namespace relief;

namespace {

std::string bigEndian(std::initializer_list<float> numbers)
{
    std::string bytes;
    for (const float number : numbers) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &number, 4);
        for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(bits >> shift));
    }
    return bytes;
}

std::string errorOf(const TemporaryFolder& folder, const std::string& bytes)
{
    const Expected<ImageFile> image = readImage(folder.write("file.pfm", bytes));
    REQUIRE(!image.has_value());
    CHECK(image.error().message.find('\n') == std::string::npos);
    return image.error().message;
}

}  // namespace

TEST_CASE("pfm: what is written comes back, bit for bit")
{
    const TemporaryFolder folder;
    std::vector<float> rgb;
    for (int i = 0; i < 5 * 3 * 3; ++i) rgb.push_back(std::ldexp(1.0f + 0.01f * static_cast<float>(i), i * 5 - 110));
    rgb[7] = -rgb[7];
    rgb[8] = 0x1p-149f;
    REQUIRE(writePfm(folder / "p.pfm", 5, 3, rgb));
    const Expected<ImageFile> read = readImage(folder / "p.pfm");
    REQUIRE(read);
    const auto& image = std::get<ImageFloat>(*read);
    CHECK(image.width == 5);
    CHECK(image.height == 3);
    for (std::size_t i = 0; i < 15; ++i) {
        CHECK(std::memcmp(&image.pixels[i * 4], &rgb[i * 3], 12) == 0);
        CHECK(image.pixels[i * 4 + 3] == 1.0f);
    }
}

TEST_CASE("pfm: of a target's kinds of floats the first is written")
{
    const TemporaryFolder folder;
    Expected<Framebuffer> target =
        Framebuffer::create(5, 3, {{Format::r32f, Store::keep}, {Format::rgba16f, Store::keep}, {Format::rgba32f}});
    REQUIRE(target);
    for (glm::vec4& color : target->color32f()) color = {1.0f, 2.0f, 3.0f, 4.0f};
    REQUIRE(writePfm(folder / "p.pfm", *target));
    const Expected<ImageFile> read = readImage(folder / "p.pfm");
    REQUIRE(read);
    const auto& image = std::get<ImageFloat>(*read);
    for (std::size_t i = 0; i < 15; ++i) {
        CHECK(image.pixels[i * 4] == 1.0f);
        CHECK(image.pixels[i * 4 + 2] == 3.0f);
    }
}

TEST_CASE("pfm: the first byte may be the largest, and one channel is grey")
{
    const TemporaryFolder folder;
    const Expected<ImageFile> read = readImage(folder.write("grey.pfm", "Pf 1\n2 1.0\n" + bigEndian({0.25f, -3.0f})));
    REQUIRE(read);
    CHECK(std::get<ImageFloat>(*read).pixels ==
          std::vector<float>{-3.0f, -3.0f, -3.0f, 1.0f, 0.25f, 0.25f, 0.25f, 1.0f});
}

TEST_CASE("pfm: lines may end with two characters")
{
    const TemporaryFolder folder;
    // The number's first byte is a line feed.
    for (const std::string header : {"Pf\n1 1\n1.0\n", "Pf\r\n1 1\r\n1.0\r\n", "Pf\r1 1\r1.0 "}) {
        const Expected<ImageFile> image = readImage(folder.write("file.pfm", header + bigEndian({0x1.4p-107f})));
        REQUIRE(image.has_value());
        CHECK(std::get<ImageFloat>(*image).pixels[0] == 0x1.4p-107f);
    }
}

TEST_CASE("pfm: bad files are an error of one line")
{
    const TemporaryFolder folder;
    for (const std::string header : {"PF\n", "PF\n2\n", "PF\n2 2\n", "PF\nx 2\n-1\n", "PF\n2 2\n0\n", "PF\n2 2\nred\n",
                                     "PF\n99999999999 2\n-1\n"}) {
        CAPTURE(header);
        CHECK(contains(errorOf(folder, header), "is damaged (bad PFM header)"));
    }
    CHECK(contains(errorOf(folder, "PF\n0 4\n-1\n"), "is 0x4; each side must be in 1..16384"));
    CHECK(contains(errorOf(folder, "PF\n-4 4\n-1\n"), "is -4x4; each side"));
    CHECK(contains(errorOf(folder, "PF\n20000 1\n-1\n"), "is 20000x1; each side"));
    CHECK(contains(errorOf(folder, "PF\n16384 16384\n-1\n"), "takes more than 1 GiB"));
    CHECK(
        contains(errorOf(folder, "PF\n2 1\n1\n" + bigEndian({1, 1, 1, 1, 1}) + "abc"), "is truncated (32 bytes, but"));
    for (const float number :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -2e38f}) {
        CHECK(contains(errorOf(folder, "PF\n2 1\n1\n" + bigEndian({1, 1, 1, 1, number, 1})),
                       "pixel (1, 0) is NaN, infinite or larger than 1.7e38"));
    }
}

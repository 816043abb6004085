// Palettes that are shorter than what pixels name, and those of OS/2's BMPs.
#include "relief/texture/full_palette.h"

#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "png16.h"
#include "relief/texture/image.h"
#include "temporary_folder.h"

using namespace relief;

namespace {

// One row of indices with this palette, not compressed.
std::string png(const std::string& palette, const std::string& indices)
{
    const std::string row = std::string(1, '\0') + indices;
    const auto length = static_cast<std::uint32_t>(row.size());
    const std::string zlib = "\x78\x01\x01" + little(length, 2) + little(~length, 2) + row + bigEndian(0);
    const std::string header =
        bigEndian(static_cast<std::uint32_t>(indices.size())) + bigEndian(1) + std::string({8, 3, 0, 0, 0});
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("PLTE", palette) + chunk("IDAT", zlib) +
           chunk("IEND", "");
}

// Of one row that is four bytes long; `header` is 12 (OS/2) or 40.
std::string bmp(std::uint32_t header, std::uint32_t bits, std::uint32_t width, const std::string& palette,
                const std::string& row)
{
    const std::uint32_t offset = 14 + header + static_cast<std::uint32_t>(palette.size());
    const std::string file = "BM" + little(offset + 4, 4) + little(0, 4) + little(offset, 4) + little(header, 4);
    const int side = header == 12 ? 2 : 4;
    return file + little(width, side) + little(1, side) + little(1, 2) + little(bits, 2) +
           std::string(header == 12 ? 0 : 24, '\0') + palette + row;
}

std::vector<std::uint8_t> pixelsOf(const std::string& bytes)
{
    const TemporaryFolder folder;
    const Expected<ImageFile> image = readImage(folder.write("picture", bytes));
    REQUIRE_MESSAGE(image.has_value(), image.error().message);
    return std::get<Image8>(*image).pixels;
}

// What stb would find on the stack of a decoder that left it uncleared.
const std::string kBright = std::string(3 * 256, '\xcc');
const std::string kBright4 = std::string(4 * 256, '\xcc');
const std::string kIndices = {0, 1, 2, '\xc8'};

}  // namespace

TEST_CASE("full palette: indices beyond a PNG's palette are black, whatever was read before")
{
    CHECK(pixelsOf(png(kBright, kIndices)) == pixelsOf(png(kBright, std::string(4, '\0'))));
    const std::vector<std::uint8_t> expected = {1, 2, 3, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255};
    CHECK(pixelsOf(png({1, 2, 3}, kIndices)) == expected);
}

TEST_CASE("full palette: indices beyond a BMP's palette are black, whatever was read before")
{
    CHECK(pixelsOf(bmp(40, 8, 4, kBright4, kIndices)).front() == 0xcc);
    const std::vector<std::uint8_t> expected = {3, 2, 1, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255};
    CHECK(pixelsOf(bmp(40, 8, 4, {1, 2, 3, 0}, kIndices)) == expected);
    CHECK(pixelsOf(bmp(12, 8, 4, {1, 2, 3}, kIndices)) == expected);
}

TEST_CASE("full palette: an OS/2 BMP has all of its colours")
{
    std::string palette;
    for (int i = 0; i < 256; ++i) palette += std::string({static_cast<char>(i), 7, 9});
    const std::vector<std::uint8_t> last = {9, 7, 255, 255, 9, 7, 254, 255, 9, 7, 253, 255, 9, 7, 0, 255};
    CHECK(pixelsOf(bmp(12, 8, 4, palette, {'\xff', '\xfe', '\xfd', 0})) == last);
    const std::vector<std::uint8_t> four = {9, 7, 15, 255, 9, 7, 1, 255};
    CHECK(pixelsOf(bmp(12, 4, 2, palette.substr(0, 48), {'\xf1', 0, 0, 0})) == four);
    const std::vector<std::uint8_t> two = {9, 7, 1, 255, 9, 7, 0, 255};
    CHECK(pixelsOf(bmp(12, 1, 2, palette.substr(0, 6), {'\x80', 0, 0, 0})) == two);
}

TEST_CASE("full palette: files with a full one or with none stay as they are")
{
    const auto unchanged = [](const std::string& text) {
        std::vector<std::uint8_t> bytes(text.begin(), text.end());
        fillPalette(bytes);
        return std::string(bytes.begin(), bytes.end()) == text;
    };
    CHECK(unchanged(png(kBright, kIndices)));
    CHECK(unchanged(bmp(40, 24, 1, "", {1, 2, 3, 0})));
    CHECK(unchanged("BM"));
    CHECK(unchanged("\x89PNG"));
    // An empty palette is the decoder's to refuse; a length beyond the end, too.
    CHECK(unchanged(png("", kIndices)));
    std::string cut = png({1, 2, 3}, kIndices);
    cut[33] = '\x7f';
    CHECK(unchanged(cut));
    const std::string whole = bmp(12, 1, 2, std::string(6, '\0'), {0, 0, 0, 0});
    for (std::size_t length = 0; length < 32; ++length) CHECK(unchanged(whole.substr(0, length)));
}

TEST_CASE("full palette: no random damage makes it read or write beyond the file")
{
    std::uint32_t state = 9;
    const auto next = [&](std::size_t limit) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::size_t>(state >> 8) % limit;
    };
    const TemporaryFolder folder;
    int read = 0;
    for (int round = 0; round < 500; ++round) {
        for (std::string bytes : {png({1, 2, 3}, kIndices), bmp(12, 8, 4, {1, 2, 3}, kIndices),
                                  bmp(40, 4, 2, std::string(8, '\x22'), {'\xf1', 0, 0, 0})}) {
            for (std::size_t damages = 1 + next(3); damages > 0; --damages) {
                bytes[next(bytes.size())] = static_cast<char>(next(256));
            }
            bytes.resize(bytes.size() - next(8) / 7 * next(bytes.size()));
            if (readImage(folder.write("damaged", bytes))) ++read;
        }
    }
    CHECK(read > 0);
    CHECK(read < 1500);
}

// Image files: what is written comes back, every supported format decodes, and every kind of bad file is one clear
// line.
#include "relief/texture/image.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <sys/resource.h>

#include <doctest/doctest.h>

#include "contents.h"
#include "png16.h"
#include "relief/file.h"
#include "relief/texture/import.h"
#include "temporary_folder.h"

using namespace relief;

namespace {

namespace fs = std::filesystem;

// Pixels that no filter or palette can shorten much, alpha included.
std::vector<std::uint8_t> noisyPixels(int count)
{
    std::vector<std::uint8_t> pixels;
    std::uint32_t state = 1;
    for (int i = 0; i < count * 4; ++i) {
        state = state * 1664525u + 1013904223u;
        pixels.push_back(static_cast<std::uint8_t>(state >> 24));
    }
    return pixels;
}

// 2 x 2, 24 bit, bottom row first: blue, green / red, white.
const std::string kPixelsBgr = {'\xff', 0, 0, 0, '\xff', 0, 0, 0, '\xff', '\xff', '\xff', '\xff'};

std::string tga2x2()
{
    return std::string({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 24, 0}) + kPixelsBgr;
}

std::string bmp2x2()
{
    const std::string row0 = kPixelsBgr.substr(0, 6) + std::string(2, '\0');
    const std::string row1 = kPixelsBgr.substr(6, 6) + std::string(2, '\0');
    return "BM" + little(70) + little(0) + little(54) + little(40) + little(2) + little(2) +
           std::string({1, 0, 24, 0}) + little(0) + little(16) + little(0) + little(0) + little(0) + little(0) + row0 +
           row1;
}

std::string hdr(const std::string& rgbe, int width)
{
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X " + std::to_string(width) + "\n" + rgbe;
}

// A baseline JPEG of one 8 x 8 block, grey, of the mean value given by its one DC coefficient.
std::string jpeg8x8()
{
    std::string file = "\xff\xd8";
    file += std::string("\xff\xdb\x00\x43\x00", 5) + std::string(64, '\x01');
    file += std::string("\xff\xc0\x00\x0b\x08\x00\x08\x00\x08\x01\x01\x11\x00", 13);
    const std::string lengths = std::string(1, '\x01') + std::string(15, '\0');  // one code, of one bit
    file += std::string("\xff\xc4\x00\x14\x00", 5) + lengths + std::string(1, '\0');
    file += std::string("\xff\xc4\x00\x14\x10", 5) + lengths + std::string(1, '\0');
    file += std::string("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00", 10);
    return file + "\x3f" + "\xff\xd9";  // bits 0 (DC difference 0) and 0 (end of block), filled up with ones
}

std::string errorOf(const fs::path& path)
{
    const Expected<ImageFile> image = readImage(path);
    if (image) return "";
    CHECK(image.error().message.find('\n') == std::string::npos);
    CHECK(image.error().message.find(path.string()) == 0);
    return image.error().message;
}

Image8 read8(const fs::path& path)
{
    const Expected<ImageFile> image = readImage(path);
    REQUIRE_MESSAGE(image.has_value(), image.error().message);
    REQUIRE(std::holds_alternative<Image8>(*image));
    return std::get<Image8>(*image);
}

const std::vector<std::uint8_t> kRedWhiteBlueGreen = {255, 0, 0,   255, 255, 255, 255, 255,
                                                      0,   0, 255, 255, 0,   255, 0,   255};

}  // namespace

TEST_CASE("image: a PNG comes back exactly, and the same pixels give the same bytes")
{
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 5}, {64, 2}, {257, 31}}) {
        const std::vector<std::uint8_t> pixels = noisyPixels(width * height);
        REQUIRE(writePng(folder / "a.png", width, height, pixels).has_value());
        REQUIRE(writePng(folder / "b.png", width, height, pixels).has_value());
        CHECK(contents(folder / "a.png") == contents(folder / "b.png"));
        const Image8 image = read8(folder / "a.png");
        CHECK(image.width == width);
        CHECK(image.height == height);
        CHECK(image.pixels == pixels);
    }
    CHECK(folder.fileCount() == 2);
}

TEST_CASE("image: 16-bit PNG keeps its 16 bits")
{
    const TemporaryFolder folder;
    const Expected<ImageFile> image = readImage(folder.write("a.png", png16(3, 1, {0, 258, 65535})));
    REQUIRE_MESSAGE(image.has_value(), image.error().message);
    REQUIRE(std::holds_alternative<Image16>(*image));
    const std::vector<std::uint16_t> expected = {0, 0, 0, 65535, 258, 258, 258, 65535, 65535, 65535, 65535, 65535};
    CHECK(std::get<Image16>(*image).pixels == expected);
}

TEST_CASE("image: the bytes of a file are read as the file is, and errors begin with the name that they are given")
{
    const std::string file = png16(3, 1, {0, 258, 65535});
    const Expected<ImageFile> image = decodeImage({file.begin(), file.end()}, "a.glb: images[2]");
    REQUIRE(image.has_value());
    CHECK(std::get<Image16>(*image).pixels[4] == 258);
    const Expected<ImageFile> cut = decodeImage({file.begin(), file.end() - 30}, "a.glb: images[2]");
    REQUIRE(!cut.has_value());
    CHECK(cut.error().message.starts_with("a.glb: images[2]: is "));
}

TEST_CASE("image: a 16-bit PNG becomes a texture of 16 bits, code by code")
{
    const TemporaryFolder folder;
    const Expected<std::shared_ptr<const Texture>> texture = importTexture(
        folder.write("a.png", png16(4, 1, {0, 1, 32769, 65535})).string(), {.colorSpace = ColorSpace::linear});
    REQUIRE(texture.has_value());
    CHECK((*texture)->format() == TexelFormat::rgba16);
    int x = 0;
    for (const float code : {0.0f, 1.0f, 32769.0f, 65535.0f}) CHECK((*texture)->texel(x++, 0).x == code / 65535.0f);
}

TEST_CASE("image: TGA and BMP, whose first row is the lowest, come with row 0 on top")
{
    const TemporaryFolder folder;
    CHECK(read8(folder.write("a.tga", tga2x2())).pixels == kRedWhiteBlueGreen);
    CHECK(read8(folder.write("a.bmp", bmp2x2())).pixels == kRedWhiteBlueGreen);
}

TEST_CASE("image: a TGA whose rows begin at the right is not mirrored")
{
    const TemporaryFolder folder;
    std::string tga = tga2x2();
    tga[17] = 0x10;
    const std::vector<std::uint8_t> expected = {255, 255, 255, 255, 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255};
    CHECK(read8(folder.write("a.tga", tga)).pixels == expected);
    // Three columns, of which the middle one stays; the top row first.
    const std::string three = {0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 1, 0, 8, 0x30, 1, 2, 3};
    const std::vector<std::uint8_t> grey = {3, 3, 3, 255, 2, 2, 2, 255, 1, 1, 1, 255};
    CHECK(read8(folder.write("b.tga", three)).pixels == grey);
}

TEST_CASE("image: JPEG")
{
    const TemporaryFolder folder;
    const Image8 image = read8(folder.write("a.jpg", jpeg8x8()));
    CHECK(image.width == 8);
    CHECK(image.pixels.size() == 256);
    CHECK(image.pixels[0] == 128);
}

TEST_CASE("image: HDR is linear and its largest number is finite")
{
    const TemporaryFolder folder;
    const std::string rgbe = {'\x80', 64, 0, '\x81', '\xff', '\xff', '\xff', '\xff', 0, 0, 0, 0};
    const Expected<ImageFile> image = readImage(folder.write("a.hdr", hdr(rgbe, 3)));
    REQUIRE_MESSAGE(image.has_value(), image.error().message);
    REQUIRE(std::holds_alternative<ImageFloat>(*image));
    const std::vector<float>& pixels = std::get<ImageFloat>(*image).pixels;
    REQUIRE(pixels.size() == 12);
    CHECK(pixels[0] == 1.0f);  // 128 * 2^(129 - 136)
    CHECK(pixels[1] == 0.5f);
    CHECK(pixels[3] == 1.0f);
    CHECK(std::all_of(pixels.begin(), pixels.end(), [](float value) { return std::isfinite(value); }));
    CHECK(pixels[4] > 1.6e38f);
}

TEST_CASE("image: bad paths and files that are no images")
{
    const TemporaryFolder folder;
    CHECK(contains(errorOf(folder / "missing.png"), "cannot open (No such file or directory); check the path"));
    CHECK(contains(errorOf(folder.path), "is a directory"));
    CHECK(contains(errorOf(folder.write("empty.png", "")), "is empty"));
    CHECK(contains(errorOf(folder.write("text.png", "This is a text and no picture at all.\n")), "is not a PNG"));
    CHECK(contains(errorOf(folder.write("zeros.png", std::string(1000, '\0'))), "is not a PNG"));
    CHECK(contains(errorOf(folder.write("gif.png", "GIF89a" + std::string(100, '\1'))), "is not a PNG"));
    if (fs::exists("/dev/null")) CHECK(contains(errorOf("/dev/null"), "is not a regular file"));
}

TEST_CASE("image: a file that is cut off anywhere is an error in every format")
{
    const TemporaryFolder folder;
    REQUIRE(writePng(folder / "whole.png", 9, 7, noisyPixels(63)).has_value());
    const std::vector<std::pair<std::string, std::string>> files = {
        {"png", contents(folder / "whole.png")},
        {"png", png16(3, 1, {1, 2, 3})},
        {"tga", tga2x2()},
        {"bmp", bmp2x2().substr(0, 68)},  // without the padding behind the last pixel, which carries nothing
        {"jpg", jpeg8x8()},
        {"hdr", hdr(std::string(12, '\x40'), 3)},
    };
    for (const auto& file : files) {
        const auto& [extension, bytes] = file;
        CAPTURE(file.first);
        REQUIRE(readImage(folder.write("cut." + extension, bytes)).has_value());
        for (std::size_t length = 0; length < bytes.size(); ++length) {
            // A PNG's last chunk is empty; only its length and name are read.
            if (extension == "png" && length + 4 >= bytes.size()) continue;
            CAPTURE(length);
            CHECK(errorOf(folder.write("cut." + extension, bytes.substr(0, length))) != "");
        }
    }
    CHECK(contains(errorOf(folder.write("half.png", contents(folder / "whole.png").substr(0, 100))), "is truncated"));
    CHECK(contains(errorOf(folder.write("half.tga", tga2x2().substr(0, 25))), "is truncated"));
}

TEST_CASE("image: a row of a TGA that is cut off after a multiple of 128 bytes")
{
    // stb's own buffer is 128 bytes long too, so that a short read of the pixels looks like one of the buffer.
    const TemporaryFolder folder;
    const std::string header = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 64, 0, 8, 0, 32, 0};
    for (std::size_t length = 0; length < 64 * 8 * 4; ++length) {
        CAPTURE(length);
        CHECK(contains(errorOf(folder.write("a.tga", header + std::string(length, 'x'))), "is truncated"));
    }
    CHECK(errorOf(folder.write("a.tga", header + std::string(64 * 8 * 4, 'x'))) == "");
}

TEST_CASE("image: a TGA that is too short for the size in its header is refused before any pixel is decoded")
{
    // 9986x8228 pixels of 24 bits, and 4 bytes of them. The message with numbers comes before the decoder does; the
    // decoder says of what is too short that it is truncated, and no more.
    const TemporaryFolder folder;
    const auto tga = [](char type, char bits, std::size_t length) {
        return std::string({0, 0, type, 0, 0, 0, 0, 0, 0, 0, 0, 0, '\x02', '\x27', '\x24', '\x20', bits, 0}) +
               std::string(length, '\x7f');
    };
    CHECK(contains(errorOf(folder.write("a.tga", tga(2, 24, 4))),
                   "is truncated (22 bytes, but 9986x8228 takes at least 246494442); copy or export it again"));
    CHECK(contains(errorOf(folder.write("b.tga", tga(10, 24, 4))), "takes at least 2567670)"));  // 641913 packets of 4
    CHECK(contains(errorOf(folder.write("c.tga", tga(11, 8, 4))), "takes at least 1283844)"));   // of 2

    // As short as can be: 3x43 pixels are one packet of 128, and one of 1.
    std::string runs = {0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 43, 0, 24, 0, '\xff', 1, 2, 3, '\x80', 4, 5, 6};
    const Image8 image = read8(folder.write("d.tga", runs));
    CHECK(image.pixels.size() == 3 * 43 * 4);
    CHECK(image.pixels[0] == 3);
    CHECK(image.pixels[2 * 4] == 6);  // the last one, at the right of the top row
    const std::string onePacket = {0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 16, 0, 8, 0, 24, 0, '\xff', 1, 2, 3};
    CHECK(read8(folder.write("e.tga", onePacket)).pixels.size() == 16 * 8 * 4);
    runs.pop_back();
    CHECK(contains(errorOf(folder.write("d.tga", runs)), "is truncated (25 bytes, but 3x43 takes at least 26)"));
}

TEST_CASE("image: an HDR that ends within a run-length encoded row is an error, and not a run of nothing for ever")
{
    const TemporaryFolder folder;
    const std::string row = {2, 2, 0, 64};  // 64 pixels, run-length encoded
    const std::string runs = {'\xc0', 9, '\xc0', 9, '\xc0', 9, '\xc0', '\x80'};
    REQUIRE(readImage(folder.write("a.hdr", hdr(row + runs, 64))).has_value());
    for (std::size_t length = 0; length < runs.size(); ++length) {
        CAPTURE(length);
        CHECK(contains(errorOf(folder.write("a.hdr", hdr(row + runs.substr(0, length), 64))), "is truncated"));
    }
}

TEST_CASE("image: sizes are checked in the header")
{
    const TemporaryFolder folder;
    CHECK(contains(errorOf(folder.write("a.png", png16(60000, 60000, {}))),
                   "60000x60000 is larger than 16384x16384; scale it down"));
    CHECK(contains(errorOf(folder.write("b.png", png16(1, 16385, {}))), "1x16385 is larger than 16384x16384"));
    CHECK(contains(errorOf(folder.write("c.png", png16(16384, 16384, {}))), "more than 1 GiB"));
    CHECK(contains(errorOf(folder.write("d.png", png16(0, 5, {}))), "damaged"));
    std::string jpeg = jpeg8x8();
    jpeg[jpeg.find("\xff\xc0") + 7] = '\x41';  // 16648 wide
    CHECK(contains(errorOf(folder.write("a.jpg", jpeg)), "a side is larger than 16384x16384"));
    std::string tga = tga2x2();
    tga[13] = '\x7f';  // 32514 wide
    CHECK(contains(errorOf(folder.write("a.tga", tga)), "32514x2 is larger"));
    std::string bmp = bmp2x2();
    bmp.replace(22, 4, std::string(3, '\0') + "\x80");  // the smallest height of 32 bits
    CHECK(errorOf(folder.write("a.bmp", bmp)) != "");
}

TEST_CASE("image: damaged compressed data")
{
    const TemporaryFolder folder;
    REQUIRE(writePng(folder / "a.png", 9, 7, noisyPixels(63)).has_value());
    std::string bytes = contents(folder / "a.png");
    for (std::size_t i = 41; i < 47; ++i) bytes[i] = '\xff';
    CHECK(contains(errorOf(folder.write("b.png", bytes)), "is damaged"));
}

TEST_CASE("image: an unknown chunk of a PNG whose type has line ends or zeros in it is an error of one line")
{
    const TemporaryFolder folder;
    REQUIRE(writePng(folder / "a.png", 9, 7, noisyPixels(63)).has_value());
    const std::string bytes = contents(folder / "a.png");
    for (const std::string& type : {std::string("\nA\nB"), std::string("A\nB\0", 4), std::string("\nA\0B", 4),
                                    std::string("\n\0AB", 4), std::string("\0\nAB", 4)}) {
        const std::string error =
            errorOf(folder.write("b.png", bytes.substr(0, 33) + chunk(type, "") + bytes.substr(33)));
        CHECK(contains(error, "is damaged (PNG chunk not known)"));
        CHECK(error.find('\n') == std::string::npos);
    }
}

TEST_CASE("image: an empty chunk of compressed data before the full one changes nothing")
{
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> pixels = noisyPixels(63);
    REQUIRE(writePng(folder / "a.png", 9, 7, pixels).has_value());
    const std::string bytes = contents(folder / "a.png");
    const Expected<ImageFile> image =
        readImage(folder.write("b.png", bytes.substr(0, 33) + chunk("IDAT", "") + bytes.substr(33)));
    REQUIRE(image.has_value());
    CHECK(std::get<Image8>(*image).pixels == pixels);
}

// What stb is fed beyond the end must not make the table longer than it can be: the sanitizers would see that.
TEST_CASE("image: a JPEG that ends among a Huffman table's counts")
{
    const TemporaryFolder folder;
    const std::string jpeg = jpeg8x8();
    const std::string counts = {1, 0, 0, 0, 1, 1, 1, '\xd9'};
    const std::string file = jpeg.substr(0, jpeg.find("\xff\xc4") + 5) + counts;
    CHECK(contains(errorOf(folder.write("a.jpg", file)), "copy or export it again"));
}

TEST_CASE("image: a JPEG whose Huffman table is too long")
{
    const TemporaryFolder folder;
    const std::string jpeg = jpeg8x8();
    const std::size_t counts = jpeg.find("\xff\xc4") + 5;
    std::string header = jpeg;
    header[counts + 12] = '\xff';
    header[counts + 13] = '\x02';
    CHECK(contains(errorOf(folder.write("a.jpg", header)), "bad Huffman table"));

    // Behind the scan, where progressive files have tables too.
    const std::string table = std::string("\xff\xff\xc4\x01\x20\x00", 6) + std::string(14, '\0') + "\xff\x02";
    const std::string late = jpeg.substr(0, jpeg.size() - 2) + table + std::string(257, '\0') + "\xff\xd9";
    CHECK(contains(errorOf(folder.write("a.jpg", late)), "bad Huffman table"));

    // Behind something in the compressed data that looks like a long segment.
    const std::string hidden = jpeg.substr(0, jpeg.size() - 2) + std::string("\xff\x00\x7f\xff", 4) + table;
    CHECK(contains(errorOf(folder.write("a.jpg", hidden)), "bad Huffman table"));

    // Behind the end of the image, as in some cameras' films, tables and all else are none of our business.
    CHECK(errorOf(folder.write("a.jpg", jpeg + table + std::string(1000, '\x7f'))) == "");

    // Nor are the same bytes in a comment.
    const std::string comment = jpeg.substr(0, 2) + std::string("\xff\xfe\x00\x18", 4) + table + jpeg.substr(2);
    CHECK(errorOf(folder.write("a.jpg", comment)) == "");
}

TEST_CASE("image: no random damage crashes the reader")
{
    const TemporaryFolder folder;
    REQUIRE(writePng(folder / "a.png", 9, 7, noisyPixels(63)).has_value());
    const std::vector<std::string> files = {contents(folder / "a.png"), tga2x2(), bmp2x2(), jpeg8x8(),
                                            hdr(std::string(12, '\x40'), 3)};
    std::uint32_t state = 7;
    const auto next = [&](std::size_t limit) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::size_t>(state >> 8) % limit;
    };
    int read = 0;
    for (int round = 0; round < 200; ++round) {
        for (std::string bytes : files) {
            for (std::size_t damages = 1 + next(4); damages > 0; --damages) {
                bytes[next(bytes.size())] = static_cast<char>(next(256));
            }
            if (readImage(folder.write("damaged", bytes))) ++read;
        }
    }
    CHECK(read > 0);
    CHECK(read < 1000);
}

TEST_CASE("image: writing where that is impossible leaves nothing behind")
{
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> pixels = noisyPixels(4);
    const auto writeError = [&](const fs::path& path) {
        const Expected<void> written = writePng(path, 2, 2, pixels);
        return written ? std::string() : written.error().message;
    };
    CHECK(contains(writeError(folder / "missing/a.png"), "its folder does not exist; create it"));
    CHECK(contains(writeError(folder.path), "is a directory"));
    CHECK(contains(writeError(folder.write("file", "x") / "a.png"), "its folder does not exist"));
    if (fs::exists("/dev/null")) CHECK(contains(writeError("/dev/null"), "is not a regular file"));
    if (fs::is_directory("/proc/self")) CHECK(contains(writeError("/proc/self/a.png"), "cannot write in its folder"));
    CHECK(folder.fileCount() == 1);

    const fs::path locked = folder / "locked";
    fs::create_directory(locked);
    fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
    std::ofstream probe(locked / "probe");
    if (probe) {
        MESSAGE("skipped: this user may write into read-only folders");
    } else {
        CHECK(contains(writeError(locked / "a.png"), "cannot write in its folder (Permission denied)"));
    }
    fs::permissions(locked, fs::perms::owner_all);
}

TEST_CASE("image: a full disk is an error, and the old file stays as it was")
{
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.png", "old");
    rlimit old{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
    const auto oldHandler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = old;
    small.rlim_cur = 4096;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    const Expected<void> written = writePng(path, 64, 64, noisyPixels(64 * 64));
    setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, oldHandler);
    REQUIRE(!written.has_value());
    CHECK(contains(written.error().message, "cannot write (File too large)"));
    CHECK(contents(path) == "old");
    CHECK(folder.fileCount() == 1);
}

TEST_CASE("image: writing replaces a file, and follows a link")
{
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.png", "old");
    fs::create_symlink("a.png", folder / "link.png");
    REQUIRE(writePng(folder / "link.png", 1, 1, noisyPixels(1)).has_value());
    CHECK(fs::is_symlink(folder / "link.png"));
    CHECK(read8(path).pixels == noisyPixels(1));
    CHECK(folder.fileCount() == 2);
}

TEST_CASE("image: wrong sizes are refused when writing")
{
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> pixels = noisyPixels(4);
    CHECK(!writePng(folder / "a.png", 2, 3, pixels).has_value());
    CHECK(!writePng(folder / "a.png", 0, 2, pixels).has_value());
    CHECK(!writePng(folder / "a.png", -2, -2, pixels).has_value());
    CHECK(!writePng(folder / "a.png", 16385, 1, pixels).has_value());
    CHECK(!writePfm(folder / "a.pfm", 2, 2, std::vector<float>(11)).has_value());
    CHECK(folder.fileCount() == 0);
}

TEST_CASE("image: PFM is little-endian, bottom row first")
{
    const TemporaryFolder folder;
    REQUIRE(writePfm(folder / "a.pfm", 1, 2, std::vector<float>{1, 2, 3, -0.0f, 0.5f, 4}).has_value());
    const std::string header = "PF\n1 2\n-1.0\n";
    const std::string bottom = std::string("\0\0\0\x80\0\0\0\x3f\0\0\x80\x40", 12);
    const std::string top = std::string("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12);
    CHECK(contents(folder / "a.pfm") == header + bottom + top);
}

TEST_CASE("image: what is written as HDR comes back within 1/255 of a pixel's largest channel")
{
    const TemporaryFolder folder;
    std::vector<float> rgb = {0.0f,    0.0f,   0.0f,   1.0f,  0.5f,          0.25f,   255.0f,
                              255.4f,  255.6f, -3.0f,  1e-3f, std::nanf(""), 1.7e38f, 1e30f,
                              3.4e38f, 1e-45f, 1e-39f, 0.0f,  2.01f,         2.02f,   2.03f};
    for (int i = 0; i < 600; ++i) rgb.push_back(std::ldexp(static_cast<float>(i * 37 % 101), i % 200 - 100));
    const int width = static_cast<int>(rgb.size()) / 3;
    REQUIRE(writeHdr(folder / "p.hdr", width, 1, rgb));
    const auto read = readImage(folder / "p.hdr");
    REQUIRE(read);
    const auto& image = std::get<ImageFloat>(*read);
    REQUIRE(image.width == width);
    constexpr float kLargest = 0x1.fep126f;
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
        float largest = 0.0f;
        const auto wanted = [&](std::size_t c) {
            return std::min(rgb[i * 3 + c] > 0.0f ? rgb[i * 3 + c] : 0.0f, kLargest);
        };
        for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, wanted(c));
        for (std::size_t c = 0; c < 3; ++c) {
            CAPTURE(i);
            CHECK(std::abs(image.pixels[i * 4 + c] - wanted(c)) <= largest / 255.0f + 1e-38f);
        }
    }
    CHECK(errorOf(folder / "no") != "");
    CHECK(!writeHdr(folder / "wrong.hdr", 2, 2, rgb).has_value());
    CHECK(!writeHdr(folder / "missing/p.hdr", width, 1, rgb).has_value());
}

// Intact files of kinds that are not read: the message names the kind, and a remedy that helps.
#include "relief/texture/unsupported.h"

#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "bytes.h"
#include "relief/texture/image.h"
#include "temporary_folder.h"

using namespace relief;

namespace {

std::string bmp(std::uint32_t header, std::uint32_t bits, std::uint32_t compression, const std::string& rest)
{
    return "BM" + little(200) + little(0) + little(14 + header) + little(header) + little(2) + little(2) +
           little(1, 2) + little(bits, 2) + little(compression) + little(0) + little(0) + little(0) + little(0) +
           little(0) + rest + std::string(200, '\x55');
}

std::string hdr(const std::string& format, const std::string& layout, const std::string& pixels)
{
    return "#?RADIANCE\nFORMAT=" + format + "\n\n" + layout + "\n" + pixels;
}

// The feature that the message names, between its brackets.
std::string unsupported(const std::string& bytes)
{
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("picture", bytes);
    const Expected<ImageFile> image = readImage(path);
    if (image) return "";
    const std::string begin = path.string() + ": is not supported (", end = "); convert it to PNG";
    const std::string& message = image.error().message;
    if (!message.starts_with(begin) || !message.ends_with(end)) return message;
    return message.substr(begin.size(), message.size() - begin.size() - end.size());
}

}  // namespace

TEST_CASE("unsupported: BMP")
{
    CHECK(unsupported(bmp(40, 8, 1, "")) == "run-length encoded BMP");
    CHECK(unsupported(bmp(40, 4, 2, "")) == "run-length encoded BMP");
    CHECK(unsupported(bmp(40, 24, 4, "")) == "BMP of compression 4");
    CHECK(unsupported(bmp(40, 2, 0, "")) == "BMP of 2 bits per pixel");
    CHECK(unsupported(bmp(64, 24, 0, std::string(24, '\0'))) == "BMP with a header of 64 bytes");
    const std::string masks = little(0xff0000) + little(0xff00) + little(0xff) + little(0xff000000);
    CHECK(unsupported(bmp(56, 32, 3, masks)) == "BMP with a header of 56 bytes");
    // Ten bits a channel, and one that the file lacks.
    CHECK(unsupported(bmp(40, 32, 3, little(0x3ff00000) + little(0xffc00) + little(0x3ff))) ==
          "BMP with unusual channel masks");
    CHECK(unsupported(bmp(40, 16, 3, little(0xf800) + little(0x7e0) + little(0))) == "BMP with unusual channel masks");
    CHECK(unsupported(bmp(40, 16, 3, little(0xf800) + little(0x7a0) + little(31))) == "BMP with unusual channel masks");
}

TEST_CASE("unsupported: what is supported among BMPs stays so")
{
    CHECK(unsupported(bmp(40, 24, 0, "")) == "");
    CHECK(unsupported(bmp(40, 32, 0, "")) == "");
    CHECK(unsupported(bmp(56, 24, 0, std::string(16, '\0'))) == "");
    std::string masks = bmp(40, 16, 3, little(0xf800) + little(0x7e0) + little(31));
    masks[10] = 14 + 40 + 12;  // the masks lie between header and pixels
    CHECK(unsupported(masks) == "");
}

TEST_CASE("unsupported: HDR")
{
    const std::string rgbe = "32-bit_rle_rgbe", pixel = {'\x80', 64, 0, '\x81'};
    CHECK(unsupported(hdr(rgbe, "-Y 1 +X 3", pixel + pixel + pixel)) == "");
    CHECK(unsupported(hdr(rgbe, "-Y 1 +X 9", pixel + std::string({1, 1, 1, 8}))) == "HDR with runs of the old kind");
    CHECK(unsupported(hdr(rgbe, "+X 3 -Y 1", pixel + pixel + pixel)) == "unsupported data layout");
    CHECK(unsupported(hdr("32-bit_rle_xyze", "-Y 1 +X 3", pixel + pixel + pixel)) == "unsupported format");
}

TEST_CASE("unsupported: TGA whose colour map does not begin at 0")
{
    const std::string tga = {0, 1, 1, 3, 0, 2, 0, 24, 0, 0, 0, 0, 2, 0, 1, 0, 8, 0, 1, 2, 3, 4, 5, 6, 3, 4};
    CHECK(unsupported(tga) == "TGA whose colour map does not begin at 0");
    std::string fromZero = tga;
    fromZero[3] = 0;
    CHECK(unsupported(fromZero) == "");
}

TEST_CASE("unsupported: JPEG and PNG")
{
    const auto jpeg = [](char frame, char bits) {
        return std::string("\xff\xd8\xff\xe0\x00\x04\x41\x42\xff", 9) + frame + std::string("\x00\x0b", 2) + bits +
               std::string("\x00\x08\x00\x08\x01\x01\x11\x00", 8) + std::string(20, '\0');
    };
    CHECK(unsupported(jpeg('\xc9', 8)) == "arithmetic coded JPEG");
    CHECK(unsupported(jpeg('\xc3', 8)) == "lossless or hierarchical JPEG");
    CHECK(unsupported(jpeg('\xc1', 12)) == "JPEG of 12 bits");
    CHECK(unsupported(jpeg('\xc0', 8)).find("not supported") == std::string::npos);
    const std::string apple = std::string("\x89PNG\r\n\x1a\n\0\0\0\4CgBI\x50\0\x20\x06", 20);
    CHECK(unsupported(apple + std::string(50, '\0')) == "PNG in Apple's form");
}

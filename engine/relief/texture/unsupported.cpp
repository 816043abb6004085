// One function a format. Each looks at what its specification says about the header, and leaves files that are too
// short for theirs to the decoder.
#include "relief/texture/unsupported.h"

#include <bit>
#include <cstddef>
#include <string_view>

#include "relief/little_endian.h"

namespace relief {
namespace {

using Bytes = std::span<const std::uint8_t>;

bool beginsWith(Bytes file, std::string_view signature)
{
    return std::string_view(reinterpret_cast<const char*>(file.data()), file.size()).starts_with(signature);
}

// At most 4 bytes.
std::uint32_t little(Bytes file, std::size_t at, std::size_t count)
{
    return static_cast<std::uint32_t>(littleEndian(file, at, count));
}

// One run of at most 8 bits; stb scales such a channel to 8 bits and nothing else.
bool isChannelMask(std::uint32_t mask)
{
    return mask != 0 && std::popcount(mask) <= 8 && std::has_single_bit((mask >> std::countr_zero(mask)) + 1);
}

// Microsoft's BITMAPINFOHEADER and its relatives, which begin behind 14 bytes with their own length.
std::string unsupportedBmp(Bytes file)
{
    constexpr std::size_t kInfo = 14;
    constexpr std::uint32_t kOs2 = 12, kV1 = 40, kV2 = 52, kV3 = 56, kV4 = 108, kV5 = 124, kBitFields = 3;
    const std::uint32_t length = little(file, kInfo, 4);
    if (length != kOs2 && length != kV1 && length != kV2 && length != kV3 && length != kV4 && length != kV5) {
        return "BMP with a header of " + std::to_string(length) + " bytes";
    }
    const bool isOs2 = length == kOs2;
    const std::uint32_t bits = little(file, isOs2 ? 24 : 28, 2);
    const std::uint32_t compression = isOs2 ? 0 : little(file, 30, 4);
    if (compression == 1 || compression == 2) return "run-length encoded BMP";
    if (compression > kBitFields) return "BMP of compression " + std::to_string(compression);
    if (bits == 2 || (isOs2 && (bits == 16 || bits == 32))) return "BMP of " + std::to_string(bits) + " bits per pixel";
    if (length == kV2 || (length == kV3 && compression == kBitFields)) {
        return "BMP with a header of " + std::to_string(length) + " bytes";
    }
    if (compression != kBitFields || (bits != 16 && bits != 32)) return {};
    for (const std::size_t at : {54u, 58u, 62u}) {
        if (file.size() >= at + 4 && !isChannelMask(little(file, at, 4))) return "BMP with unusual channel masks";
    }
    const std::uint32_t alpha = length >= kV4 ? little(file, 66, 4) : 0;
    return alpha == 0 || isChannelMask(alpha) ? "" : "BMP with unusual channel masks";
}

// "TGA file header" of the TGA specification 2.0. The caller has ruled out the other formats.
std::string unsupportedTga(Bytes file)
{
    constexpr std::size_t kHeader = 18;
    const bool isColorMapped = file.size() >= kHeader && file[1] == 1 && (file[2] == 1 || file[2] == 9);
    if (!isColorMapped || little(file, 3, 2) == 0) return {};
    return "TGA whose colour map does not begin at 0";
}

// The start of frame names the process (ITU-T T.81, table B.1) and the bits of a sample.
std::string unsupportedJpeg(Bytes file)
{
    for (std::size_t at = 2; at + 9 < file.size();) {
        if (file[at] != 0xff) return {};
        const int marker = file[at + 1];
        if (marker == 0xff) {
            ++at;  // a fill byte
            continue;
        }
        const bool isFrame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (isFrame && marker >= 0xc9) return "arithmetic coded JPEG";
        if (isFrame && marker > 0xc2) return "lossless or hierarchical JPEG";
        if (isFrame) return file[at + 4] == 8 ? "" : "JPEG of " + std::to_string(file[at + 4]) + " bits";
        if (marker == 0xda) return {};
        at += 2 + (std::size_t{file[at + 2]} << 8 | file[at + 3]);
    }
    return {};
}

// Radiance's first run-length encoding: the pixel (1, 1, 1, n) repeats the one before it n times. No pixel of a picture
// is that, since the largest of its first three numbers is at least 128. The present encoding begins each row with
// 2, 2.
std::string unsupportedHdr(Bytes file)
{
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    const std::size_t header = text.find("\n\n");
    const std::size_t size = header == std::string_view::npos ? header : text.find('\n', header + 2);
    if (size == std::string_view::npos) return {};
    const Bytes pixels = file.subspan(size + 1);
    if (pixels.size() >= 4 && pixels[0] == 2 && pixels[1] == 2 && pixels[2] < 128) return {};
    for (std::size_t at = 0; at + 4 <= pixels.size(); at += 4) {
        if (pixels[at] == 1 && pixels[at + 1] == 1 && pixels[at + 2] == 1) return "HDR with runs of the old kind";
    }
    return {};
}

}  // namespace

std::string unsupportedFeature(std::span<const std::uint8_t> file)
{
    if (beginsWith(file, "BM")) return file.size() < 26 ? "" : unsupportedBmp(file);
    if (beginsWith(file, "\xff\xd8")) return unsupportedJpeg(file);
    if (beginsWith(file, "#?")) return unsupportedHdr(file);
    // Apple's PNGs begin with a chunk of their own, and hold blue where red should be.
    if (beginsWith(file, "\x89PNG\r\n\x1a\n")) return little(file, 12, 4) == 0x49426743 ? "PNG in Apple's form" : "";
    return unsupportedTga(file);
}

}  // namespace relief

// Both formats keep their palette in front of the pixels, so that a longer one moves what follows.
#include "relief/texture/full_palette.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "relief/little_endian.h"

namespace relief {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kEntries = 256;

// A PNG is its signature and then chunks: length, type, data, checksum (PNG specification, section 5). stb_image does
// not look at checksums.
void fillPngPalette(Bytes& file)
{
    constexpr std::size_t kSignature = 8, kAroundData = 12, kColorType = 25, kPalette = 3;
    if (file.size() <= kColorType || file[kColorType] != kPalette) return;
    for (std::size_t at = kSignature; at + kAroundData <= file.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | file[at + i];
        if (length > file.size() - at - kAroundData) return;
        // An empty one is an error that the decoder finds, and then looks for another one.
        if (std::memcmp(&file[at + 4], "PLTE", 4) == 0 && length > 0) {
            if (length % 3 != 0 || length >= 3 * kEntries) return;
            const auto end = file.begin() + static_cast<std::ptrdiff_t>(at + 8 + length);
            file.insert(end, 3 * kEntries - length, 0);
            file[at + 2] = 3 * kEntries >> 8;
            file[at + 3] = 0;
            return;
        }
        at += kAroundData + length;
    }
}

// A BMP of 14 + 40 bytes of header, 256 entries and the pixels. The header of OS/2 has sizes of 16 bits and entries of
// three bytes.
void fillBmpPalette(Bytes& file)
{
    constexpr std::size_t kFileHeader = 14, kOs2 = 12, kInfo = 40, kPixels = kFileHeader + kInfo + 4 * kEntries;
    const auto little = [&file](std::size_t at, std::size_t count) {
        return static_cast<std::size_t>(littleEndian(file, at, count));
    };
    if (file.size() < kFileHeader + kOs2) return;
    const std::size_t pixels = little(10, 4), header = little(14, 4);
    const bool isOs2 = header == kOs2;
    const std::size_t bits = little(isOs2 ? 24 : 28, 2), planes = little(isOs2 ? 22 : 26, 2);
    const std::size_t palette = kFileHeader + header, bytesPerEntry = isOs2 ? 3 : 4;
    const bool isCompressed = !isOs2 && little(30, 4) != 0;
    if ((bits != 1 && bits != 4 && bits != 8) || planes != 1 || isCompressed) return;
    if ((!isOs2 && header < kInfo) || pixels > file.size() || pixels < palette + bytesPerEntry) return;

    Bytes full(kPixels, 0);
    const auto put = [&full](std::size_t at, std::size_t number) {
        for (std::size_t i = 0; i < 4; ++i) full[at + i] = static_cast<std::uint8_t>(number >> 8 * i);
    };
    full[0] = 'B';
    full[1] = 'M';
    put(10, kPixels);
    put(14, kInfo);
    put(18, isOs2 ? little(18, 2) : little(18, 4));
    put(22, isOs2 ? little(20, 2) : little(22, 4));
    put(26, 1 | bits << 16);
    const std::size_t entries = std::min((pixels - palette) / bytesPerEntry, kEntries);
    for (std::size_t i = 0; i < entries; ++i) std::copy_n(&file[palette + i * bytesPerEntry], 3, &full[54 + 4 * i]);
    full.insert(full.end(), file.begin() + static_cast<std::ptrdiff_t>(pixels), file.end());
    file = std::move(full);
}

}  // namespace

void fillPalette(std::vector<std::uint8_t>& file)
{
    constexpr std::uint8_t kPng[] = {0x89, 'P', 'N', 'G'};
    if (file.size() >= 4 && std::memcmp(file.data(), kPng, 4) == 0) fillPngPalette(file);
    if (file.size() >= 2 && file[0] == 'B' && file[1] == 'M') fillBmpPalette(file);
}

}  // namespace relief

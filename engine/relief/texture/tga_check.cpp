// The header's fields are those of the TGA specification 2.0, section "TGA file header".
#include "relief/texture/tga_check.h"

#include "relief/little_endian.h"

namespace relief {
namespace {

constexpr std::uint64_t kHeader = 18;

// Nothing but TGA, of the formats that we read, has a 0 or 1 for its second byte: without and with a colour map.
bool isTga(std::span<const std::uint8_t> file)
{
    return file.size() >= kHeader && file[1] <= 1;
}

}  // namespace

std::uint64_t fewestTgaBytes(std::span<const std::uint8_t> file)
{
    if (!isTga(file)) return 0;
    const std::uint64_t pixels = littleEndian(file, 12, 2) * littleEndian(file, 14, 2),
                        bytesPerPixel = (file[16] + 7u) / 8u;
    const bool isRunLengthEncoded = (file[2] & 8) != 0;
    if (!isRunLengthEncoded) return kHeader + pixels * bytesPerPixel;
    return kHeader + (pixels + 127) / 128 * (1 + bytesPerPixel);  // each packet is a count and at least one pixel
}

bool tgaRunsLeftwards(std::span<const std::uint8_t> file)
{
    return isTga(file) && (file[17] & 0x10) != 0;
}

}  // namespace relief

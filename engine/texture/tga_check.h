// How long a TGA file has to be for the size in its header: stb_image decodes what is missing as zeros, and a header of
// 18 bytes can ask for 16384x16384 of them.
#pragma once

#include <cstdint>
#include <span>

namespace relief {

// The fewest bytes that hold the header and the pixels of this TGA file: 128 pixels to a packet where they are
// run-length encoded. 0 for files of other formats.
std::uint64_t fewestTgaBytes(std::span<const std::uint8_t> file);

}  // namespace relief

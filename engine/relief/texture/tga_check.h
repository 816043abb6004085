// What stb_image does not look at in the header of a TGA file: how long the file has to be for the size that it names
// (what is missing is decoded as zeros, and 18 bytes can ask for 16384x16384 of them), and on which side rows begin.
#pragma once

#include <cstdint>
#include <span>

namespace relief {

// The fewest bytes that hold the header and the pixels of this TGA file: 128 pixels to a packet where they are
// run-length encoded. 0 for files of other formats.
std::uint64_t fewestTgaBytes(std::span<const std::uint8_t> file);

// Whether the rows of this TGA file run from right to left. False for files of other formats.
bool tgaRunsLeftwards(std::span<const std::uint8_t> file);

}  // namespace relief

// Whether stb_image can be given a JPEG file: the releases up to 2.28 do not count the codes of a Huffman table, and a
// damaged table makes them write past an array.
#pragma once

#include <cstdint>
#include <span>

namespace relief {

// False if the file starts like a JPEG and a Huffman table that a decoder can come across has more than 256 codes
// (ITU-T T.81, B.2.4.2: as many as there are bytes is all that can be used). True for every other file.
bool jpegTablesFit(std::span<const std::uint8_t> file);

}  // namespace relief

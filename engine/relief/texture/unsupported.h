// Intact files of a kind that stb_image does not decode, or takes for another one and decodes wrongly. It calls most of
// them damaged, and then it would not help to copy them again.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace relief {

// What the file has that is not supported ("run-length encoded BMP"), by its header, and in HDR files by its pixels
// too. Empty for every other file, damaged ones included.
std::string unsupportedFeature(std::span<const std::uint8_t> file);

}  // namespace relief

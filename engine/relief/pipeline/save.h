// A target's pictures as files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "relief/error.h"
#include "relief/pipeline/framebuffer.h"

namespace relief {

// The colours of an 8-bit target as RGBA, row 0 on top, whatever the machine's byte order.
std::vector<std::uint8_t> bytesOf(const Framebuffer& target);

// Writes the colours of an 8-bit target as PNG. An error as of texture/image.h, or for a target of another format.
Expected<void> writePng(const std::string& path, const Framebuffer& target);

// Writes what a target holds as floats, as PFM, bit for bit: red, green and blue of rgba32f and rgba16f, the one number
// of r32f three times, and the depth, three times, of a target without such a colour. An error as above.
Expected<void> writePfm(const std::string& path, const Framebuffer& target);

}  // namespace relief

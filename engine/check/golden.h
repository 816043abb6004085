// Golden pictures: what a test's picture must look like, byte for byte, kept as a PNG file beside the tests.
#pragma once

#include <filesystem>

#include "check/compare.h"
#include "error.h"
#include "pipeline/framebuffer.h"

namespace relief {

// Compares an 8-bit target with a golden file. An error, whose message says what to do, where the file is missing or
// cannot be read, has another size, or differs in any pixel. Then the picture and the difference (8 times enlarged) are
// written to `failures` as NAME.actual.png and NAME.difference.png, and the first differing pixels are in the message.
Expected<void> checkGolden(const Framebuffer& target, const std::filesystem::path& golden,
                           const std::filesystem::path& failures);

// Writes the target as the new golden; makes its folder where needed.
Expected<void> updateGolden(const Framebuffer& target, const std::filesystem::path& golden);

}  // namespace relief

// Golden pictures: what a test's picture must look like, byte for byte, kept as a PNG file beside the tests.
#pragma once

#include <string>

#include "relief/check/compare.h"
#include "relief/error.h"
#include "relief/pipeline/framebuffer.h"

namespace relief {

// Compares an 8-bit target with a golden file. An error, whose message says what to do, where the file is missing or
// cannot be read, has another size, or differs in any pixel. Then the picture is written to `failures` as
// NAME.actual.png, and the message names that file. Where pixels differ the first ones are in the message, and the
// difference (8 times enlarged) is written to NAME.difference.png. Paths are UTF-8.
Expected<void> checkGolden(const Framebuffer& target, const std::string& golden, const std::string& failures);

// Writes the target as the new golden; makes its folder where needed.
Expected<void> updateGolden(const Framebuffer& target, const std::string& golden);

}  // namespace relief

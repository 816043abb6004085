// Golden pictures: what a test's picture must look like, kept as a file beside the tests: PNG, or PFM for floats.
// golden_run.h makes a workflow of it.
#pragma once

#include <functional>
#include <string>

#include "relief/check/compare.h"
#include "relief/check/record.h"
#include "relief/error.h"
#include "relief/pipeline/framebuffer.h"
#include "relief/texture/image.h"

namespace relief {

// A picture and the golden that it is held to.
struct GoldenCase
{
    std::string name;      // of the files in the folder of failures, and in messages
    std::string golden;    // the golden's file
    std::string actual;    // the picture's file; empty: it is in memory alone, and kept where it fails
    std::string failures;  // where that goes, and the difference: NAME.actual.png, NAME.difference.png
    Tolerance tolerance;
    std::string updating;  // how this picture becomes the golden: the end of every message
    std::function<std::string(int x, int y)> tell = {};  // says more about the first differing pixel
};

// Compares, and tells what came of it. An error of `expected` or `picture` is a failure of its own kind.
GoldenRecord judge(const GoldenCase& check, const Expected<ImageFile>& picture, const Expected<ImageFile>& expected);

// The colours that a target keeps (SV_Target<n>): 8 bits, or floats with all their bits. A target without such a colour
// gives its depth. Of r32f and depth the number is all three channels. PFM has no alpha: of floats it is 1.
Expected<ImageFile> pictureOf(const Framebuffer& target, int n = 0);

// The alpha of such a target, as grey; an error where it is not one of floats with alpha.
Expected<ImageFile> alphaOf(const Framebuffer& target, int n = 0);

// 8 bits as PNG, floats as PFM; an error for 16 bits, for floats that no such file can be read with (image.h), and as
// of file.h. Makes the folder where needed.
Expected<void> writePicture(const std::string& path, const ImageFile& picture);

// Compares an 8-bit target with a golden file. An error, whose message says what to do, where the file is missing or
// cannot be read, has another size, or differs in any pixel. Then the picture is written to `failures` as
// NAME.actual.png, and the message names that file. Where pixels differ the first ones are in the message, and the
// difference (8 times enlarged) is written to NAME.difference.png. Paths are UTF-8.
Expected<void> checkGolden(const Framebuffer& target, const std::string& golden, const std::string& failures);

// Writes the target as the new golden; makes its folder where needed.
Expected<void> updateGolden(const Framebuffer& target, const std::string& golden);

}  // namespace relief

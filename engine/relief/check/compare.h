// Comparing pictures of any program: 8 and 16 bits a channel, and floats. Nothing may differ, unless a tolerance says
// how much has to.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "relief/error.h"
#include "relief/texture/image.h"

namespace relief {

struct Between
{
    std::uint64_t least = 0, most = 0;
};

// What a comparison has to find. The default: no difference. Anything else is a range that was measured, and both its
// ends hold: a picture that has become better than its tolerance says needs a new one.
//   {.pixels = {40, 60}, .largest = {1, 2}, .window8x8 = 3}
struct Tolerance
{
    Between pixels;   // how many differ
    Between largest;  // the largest difference of a channel: in codes, of floats in ULP (steps from float to float)
    std::optional<std::uint64_t> window8x8;  // and in no square of 8x8 pixels do more than these differ

    bool isExact() const { return pixels.most == 0; }
};

// "pixels=40-60,largest=1-2,window8x8=3"; a comma or a space between, and one number where both ends are the same. An
// error for other words, and for a range that contradicts itself.
Expected<Tolerance> toleranceOf(const std::string& text);
std::string textOf(const Tolerance& tolerance);

struct PixelDifference
{
    int x, y;                                // row 0 on top
    std::array<double, 4> actual, expected;  // R, G, B, A as the pictures have them
};

struct Comparison
{
    std::uint64_t differing = 0;          // pixels
    std::uint64_t largest = 0;            // difference of a channel, in codes or ULP; 2^32 between a number and NaN
    std::uint64_t window8x8 = 0;          // the most that differ in any square of 8x8 pixels
    std::vector<PixelDifference> first;   // the first ten of them, row by row
    std::vector<std::uint8_t> amplified;  // RGBA, opaque: 8 times each channel's difference; of 16 bits and floats 16
                                          // for every doubling of it. Empty where nothing differs

    bool same() const { return differing == 0; }

    // What breaks the tolerance, such as "61 pixels differ, the tolerance is 40-60"; empty where nothing does.
    std::string breaks(const Tolerance& tolerance) const;

    // One line for all of it, and one for each of the first differing pixels.
    std::string report() const;
};

// Two RGBA pictures of width * height * 4 bytes each. A pixel that one of them is too short for differs; what is
// missing counts as 0.
Comparison compare(int width, int height, std::span<const std::uint8_t> actual, std::span<const std::uint8_t> expected);

// Two pictures as files hold them. Floats are equal where their bits are. An error where their sizes are not the same,
// or one has more bits than the other.
Expected<Comparison> compare(const ImageFile& actual, const ImageFile& expected);

// "640x480", and "8-bit", "16-bit" or "float".
std::string sizeOf(const ImageFile& picture);
const char* kindOf(const ImageFile& picture);

}  // namespace relief

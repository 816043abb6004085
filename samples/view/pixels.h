// Pictures beside pictures: two in one, and their difference.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "relief/error.h"

namespace relief::samples {

// R, G, B, A from the lowest byte up; row 0 is the top row.
struct Pixels
{
    int width = 0, height = 0;
    std::vector<std::uint32_t> colors;

    bool empty() const { return colors.empty(); }
    bool sameSize(const Pixels& other) const { return width == other.width && height == other.height; }
    std::uint32_t at(int x, int y) const
    {
        return colors[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

Expected<Pixels> readPixels(const std::string& path);
Expected<void> writePixels(const std::string& path, const Pixels& picture);

// `left` up to the column, `right` from there on. Both of the same size.
Pixels beside(const Pixels& left, const Pixels& right, int column);

// Four in one: `first` and `second` above, `third` below `first`, the rest black. All of the same size.
Pixels grid(const Pixels& first, const Pixels& second, const Pixels& third);

struct Difference
{
    Pixels picture;            // of each channel, so many times enlarged, opaque
    int largest = 0;           // of all channels, 0 to 255
    int x = 0, y = 0;          // the first pixel that has it
    std::uint64_t pixels = 0;  // that differ
};

// Of two pictures of the same size.
Difference differenceOf(const Pixels& a, const Pixels& b, int enlargement);

// A pixel as it is stored, and as the linear light that it stands for: "188 120 90 255" and "0.5029 0.1878 ...".
std::string storedText(std::uint32_t color);
std::string decodedText(std::uint32_t color);

// The mean of all pixels below each pixel of a smaller picture.
Pixels shrunk(const Pixels& picture, int width, int height);

}  // namespace relief::samples

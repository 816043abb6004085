// Comparing pictures, exactly: for anybody's pixel tests. No tolerance: the engine gives the same bits everywhere, so a
// single different byte is a finding.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relief {

struct PixelDifference
{
    int x, y;  // row 0 on top
    std::uint8_t actual[4], expected[4];
};

struct Comparison
{
    std::uint64_t differing = 0;          // pixels
    std::vector<PixelDifference> first;   // the first ten of them, row by row
    std::vector<std::uint8_t> amplified;  // RGBA: 8 times the absolute difference of each channel, opaque

    bool same() const { return differing == 0; }

    // One line for each of the first differing pixels.
    std::string report() const;
};

// Two RGBA pictures of width * height * 4 bytes each. A pixel that one of them is too short for differs; what is
// missing counts as 0.
Comparison compare(int width, int height, std::span<const std::uint8_t> actual, std::span<const std::uint8_t> expected);

}  // namespace relief

#include "relief/check/compare.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace relief {

Comparison compare(int width, int height, std::span<const std::uint8_t> actual, std::span<const std::uint8_t> expected)
{
    constexpr std::size_t kReported = 10;
    const auto columns = static_cast<std::size_t>(std::max(width, 0)),
               rows = static_cast<std::size_t>(std::max(height, 0));
    const std::size_t shorter = std::min(actual.size(), expected.size());
    const auto pixelOf = [](std::span<const std::uint8_t> picture, std::size_t at, std::uint8_t pixel[4]) {
        if (at < picture.size()) std::copy_n(&picture[at], std::min<std::size_t>(4, picture.size() - at), pixel);
    };
    Comparison result;
    result.amplified.resize(columns * rows * 4);
    for (std::size_t at = 0; at < result.amplified.size(); at += 4) {
        const std::size_t number = at / 4;
        PixelDifference pixel{static_cast<int>(number % columns), static_cast<int>(number / columns), {}, {}};
        pixelOf(actual, at, pixel.actual);
        pixelOf(expected, at, pixel.expected);
        for (std::size_t c = 0; c < 4; ++c) {
            const int difference = std::abs(pixel.actual[c] - pixel.expected[c]);
            result.amplified[at + c] = c == 3 ? 255 : static_cast<std::uint8_t>(std::min(255, difference * 8));
        }
        if (at + 4 <= shorter && std::memcmp(pixel.actual, pixel.expected, 4) == 0) continue;
        ++result.differing;
        if (result.first.size() < kReported) result.first.push_back(pixel);
    }
    return result;
}

std::string Comparison::report() const
{
    std::string text = std::to_string(differing) + " pixels differ\n";
    for (const PixelDifference& p : first) {
        char line[128];
        std::snprintf(line, sizeof line, "  (%d, %d)  is %3d %3d %3d %3d  should be %3d %3d %3d %3d\n", p.x, p.y,
                      p.actual[0], p.actual[1], p.actual[2], p.actual[3], p.expected[0], p.expected[1], p.expected[2],
                      p.expected[3]);
        text += line;
    }
    return text;
}

}  // namespace relief

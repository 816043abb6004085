#include "check/compare.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace relief {

Comparison compare(int width, int height, std::span<const std::uint8_t> actual, std::span<const std::uint8_t> expected)
{
    constexpr std::size_t kReported = 10;
    Comparison result;
    result.amplified.resize(actual.size());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t at =
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
            PixelDifference pixel{x, y, {}, {}};
            std::memcpy(pixel.actual, actual.data() + at, 4);
            std::memcpy(pixel.expected, expected.data() + at, 4);
            for (std::size_t c = 0; c < 4; ++c) {
                const int difference = std::abs(pixel.actual[c] - pixel.expected[c]);
                result.amplified[at + c] = c == 3 ? 255 : static_cast<std::uint8_t>(std::min(255, difference * 8));
            }
            if (std::memcmp(pixel.actual, pixel.expected, 4) == 0) continue;
            ++result.differing;
            if (result.first.size() < kReported) result.first.push_back(pixel);
        }
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

// A scale of colours for numbers: from dark violet over green to yellow, evenly brighter, so that it is read in grey
// and by colour-blind people too. Nine of viridis' colours (Smith, van der Walt, Firing; CC0), and straight lines
// between.
#pragma once

#include <array>
#include <cstdint>

namespace relief::samples {

using SrgbCode = std::array<std::uint8_t, 3>;

// `part` is 0 ... 1; what is outside, and NaN, is moved to the nearest end.
constexpr SrgbCode ramp(float part)
{
    constexpr SrgbCode kColors[] = {{0x44, 0x01, 0x54}, {0x47, 0x2d, 0x7b}, {0x3b, 0x52, 0x8b},
                                    {0x2c, 0x72, 0x8e}, {0x21, 0x91, 0x8c}, {0x27, 0xad, 0x81},
                                    {0x5d, 0xc8, 0x63}, {0xaa, 0xdc, 0x32}, {0xfd, 0xe7, 0x25}};
    const float inside = part > 0.0f ? (part < 1.0f ? part : 1.0f) : 0.0f;
    const int position = static_cast<int>(inside * 2048.0f + 0.5f);  // 256 between two of them
    const int first = position < 2048 ? position >> 8 : 7, rest = position - first * 256;
    SrgbCode color{};
    for (std::size_t c = 0; c < 3; ++c) {
        const int from = kColors[first][c], to = kColors[first + 1][c];
        color[c] = static_cast<std::uint8_t>((from * (256 - rest) + to * rest + 128) / 256);
    }
    return color;
}

}  // namespace relief::samples

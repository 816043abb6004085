// The decoding side of sRGB. A power of 2.4 is a square times a fifth root, and the root comes from Newton's method on
// doubles: slow, exact to the last bits, and needed only when an image is imported.
#include "relief/texture/color_space.h"

#include <cstddef>

#include "relief/lanes/environment.h"
#include "relief/lanes/settled.h"

namespace relief {
namespace {

// The fifth root of a number in [0.001, 1]. From above, Newton's steps fall until rounding stops them.
constexpr double fifthRoot(double a)
{
    double root = 1.0;
    for (;;) {
        const double square = root * root;
        const double next = root - (square * square * root - a) / (5.0 * square * square);
        if (next >= root) return root;
        root = next;
    }
}

// D3D 11.3, 3.2.3.7: encoded / 12.92 up to 0.04045, ((encoded + 0.055) / 1.055)^2.4 above.
constexpr double decode(double encoded)
{
    if (encoded <= 0.04045) return encoded / 12.92;
    const double base = (encoded + 0.055) / 1.055;
    const double square = base * base;
    return square * fifthRoot(square);
}

constexpr std::uint16_t toUnorm16(double value)
{
    return static_cast<std::uint16_t>(value * 65535.0 + 0.5);
}

}  // namespace

constexpr std::array<float, 256> color_space::kSrgbToLinear = [] {
    std::array<float, 256> table{};
    for (std::size_t code = 0; code < 256; ++code)
        table[code] = static_cast<float>(decode(static_cast<double>(code) / 255.0));
    return table;
}();

double decodeSrgb(double encoded)
{
    const DefaultFloatingPoint environment;
    return settled(decode(encoded));
}

// The 8-bit codes are among the 16-bit ones: code / 255 = code * 257 / 65535.
std::uint16_t srgbToLinear16(std::uint8_t code)
{
    const DefaultFloatingPoint environment;
    return settled(toUnorm16(decode(code / 255.0)));
}

std::uint16_t srgbToLinear16(std::uint16_t code)
{
    const DefaultFloatingPoint environment;
    return settled(toUnorm16(decode(code / 65535.0)));
}

}  // namespace relief

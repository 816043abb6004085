// Slopes, unit vectors and their codes, in doubles: heights of any size neither overflow nor lose the small slopes.
#include "relief/texture/normal_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "relief/lanes/environment.h"

namespace relief {
namespace {

constexpr TexelFormat kFloats = TexelFormat::rgba32Float;

// The direction of (x, y, z), or (0, 0, 1) where there is none. NaN fails both comparisons.
void storeUnit(double x, double y, double z, float* texel)
{
    const double length = std::sqrt(x * x + y * y + z * z);
    const bool hasDirection = length > 1e-6 && length < 1e150;
    texel[0] = hasDirection ? static_cast<float>(x / length) : 0.0f;
    texel[1] = hasDirection ? static_cast<float>(y / length) : 0.0f;
    texel[2] = hasDirection ? static_cast<float>(z / length) : 1.0f;
    texel[3] = 0.0f;
}

// A level of unit vectors: vectorAt(x, y) gives one of any length.
struct Vector
{
    double x, y, z;
};

template <class Function>
MipLevel unitLevel(int width, int height, Function vectorAt)
{
    MipLevel level(kFloats, width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Vector v = vectorAt(x, y);
            storeUnit(v.x, v.y, v.z, level.texel<float>(x, y));
        }
    }
    level.fillFrame();
    return level;
}

// 2 * code - 1 for a code of `one` = 255 or 65535: codes as far from the middle are exactly opposite. Floats have no
// code, `one` is 1.
template <class Channel>
double toSigned(Channel code, double one)
{
    return (2.0 * static_cast<double>(code) - one) / one;
}

constexpr double oneOf(std::uint8_t)
{
    return 255.0;
}
constexpr double oneOf(std::uint16_t)
{
    return 65535.0;
}
constexpr double oneOf(float)
{
    return 1.0;
}

// The pixel at (x, y), counted from below; pictures have row 0 on top.
template <class Channel>
const Channel* pixelAt(const ImageOf<Channel>& image, int x, int y)
{
    const auto row = static_cast<std::size_t>(image.height - 1 - y);
    return &image.pixels[(row * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 4];
}

// Heights as a filter asks for them: (x, y) may be one texel outside.
class Neighbours
{
public:
    explicit Neighbours(const HeightField& field) : heights(field) {}
    double operator()(int x, int y) const
    {
        const auto column = static_cast<std::size_t>(wrap(x, heights.width));
        const auto row = static_cast<std::size_t>(wrap(y, heights.height));
        return static_cast<double>(heights.values[row * static_cast<std::size_t>(heights.width) + column]);
    }

private:
    static int wrap(int i, int side) { return i < 0 ? side - 1 : i >= side ? 0 : i; }
    const HeightField& heights;
};

// What the heights fall per texel, to the right and up. Falling is what the normal leans towards, and it makes the
// zero of equal heights a positive one.
struct Fall
{
    double right, up;
};

Fall smoothFall(const Neighbours& h, int x, int y)
{
    return {h(x, y) - h(x + 1, y), h(x, y) - h(x, y + 1)};
}

Fall sobelFall(const Neighbours& h, int x, int y)
{
    double right = 0.0, up = 0.0;
    for (int i = -1; i <= 1; ++i) {
        const double weight = i == 0 ? 2.0 : 1.0;
        right += weight * (h(x - 1, y + i) - h(x + 1, y + i));
        up += weight * (h(x + i, y - 1) - h(x + i, y + 1));
    }
    return {right / 8.0, up / 8.0};
}

// n = 1 may be a rounding error above 1; the code is still 255.
std::uint8_t toCode(float n)
{
    return static_cast<std::uint8_t>(std::clamp(static_cast<double>(n) * 127.5 + 128.0, 0.0, 255.0));
}

}  // namespace

HeightField heightsOf(const ImageFile& picture)
{
    const DefaultFloatingPoint environment;
    return std::visit(
        [](const auto& image) {
            HeightField field{image.width, image.height, {}};
            field.values.reserve(image.pixels.size() / 4);
            for (int y = 0; y < image.height; ++y) {
                for (int x = 0; x < image.width; ++x) {
                    const auto red = *pixelAt(image, x, y);
                    field.values.push_back(static_cast<float>(static_cast<double>(red) / oneOf(red)));
                }
            }
            return field;
        },
        picture);
}

bool isGreyscale(const ImageFile& picture)
{
    return std::visit(
        [](const auto& image) {
            for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4) {
                const auto* pixel = &image.pixels[i];
                if (pixel[0] != pixel[1] || pixel[1] != pixel[2]) return false;
            }
            return true;
        },
        picture);
}

MipLevel normalsFromHeights(const HeightField& heights, float bumpiness, NormalFilter filter)
{
    const DefaultFloatingPoint environment;
    const double scale = static_cast<double>(bumpiness) * heights.width;  // texels per unit of height
    const Neighbours neighbours(heights);
    return unitLevel(heights.width, heights.height, [&](int x, int y) {
        const Fall fall = filter == NormalFilter::smooth ? smoothFall(neighbours, x, y) : sobelFall(neighbours, x, y);
        return Vector{fall.right * scale, fall.up * scale, 1.0};
    });
}

MipLevel normalsFromColors(const ImageFile& picture)
{
    const DefaultFloatingPoint environment;
    return std::visit(
        [](const auto& image) {
            return unitLevel(image.width, image.height, [&image](int x, int y) {
                const auto* pixel = pixelAt(image, x, y);
                const double one = oneOf(*pixel);
                return Vector{toSigned(pixel[0], one), toSigned(pixel[1], one), toSigned(pixel[2], one)};
            });
        },
        picture);
}

MipLevel normalizedNormals(const MipLevel& vectors)
{
    const DefaultFloatingPoint environment;
    return unitLevel(vectors.width(), vectors.height(), [&vectors](int x, int y) {
        const float* v = vectors.texel<float>(x, y);
        return Vector{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    });
}

void fadeToFlat(MipLevel& normals, double amount)
{
    const DefaultFloatingPoint environment;
    if (!(amount > 0.0)) return;
    const double rest = std::max(1.0 - amount, 0.0);
    normals = unitLevel(normals.width(), normals.height(), [&](int x, int y) {
        if (rest == 0.0) return Vector{0.0, 0.0, 1.0};  // no negative zeros
        const float* n = normals.texel<float>(x, y);
        return Vector{n[0] * rest, n[1] * rest, n[2] * rest + amount};
    });
}

MipLevel encodeNormals(const MipLevel& normals, NormalChannels channels)
{
    const DefaultFloatingPoint environment;
    MipLevel codes(TexelFormat::rgba8, normals.width(), normals.height());
    for (int y = 0; y < normals.height(); ++y) {
        for (int x = 0; x < normals.width(); ++x) {
            const float* n = normals.texel<float>(x, y);
            std::uint8_t* code = codes.texel<std::uint8_t>(x, y);
            const bool rgb = channels == NormalChannels::rgb;
            code[0] = rgb ? toCode(n[0]) : std::uint8_t{255};
            code[1] = toCode(n[1]);
            code[2] = rgb ? toCode(n[2]) : std::uint8_t{255};
            code[3] = rgb ? std::uint8_t{255} : toCode(n[0]);
        }
    }
    codes.fillFrame();
    return codes;
}

}  // namespace relief

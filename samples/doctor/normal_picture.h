// A picture as a field of vectors, under an assumption about how it is stored; and a field back as a picture. Row 0 is
// the lowest, so that +y is up, and neighbours wrap around.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "relief/texture/image.h"

namespace relief::samples::doctor {

using Vector = std::array<float, 3>;

// A picture's channels, 0 ... 1, and how finely they are stored.
struct Channels
{
    int width = 0, height = 0;
    float step = 1.0f / 255.0f;  // from code to code; 0: floats
    std::vector<std::array<float, 4>> texels;

    // What no triangle uses has one colour, often white or black: the most frequent one, if it is no direction at all
    // and more than a twentieth of the texels have it.
    std::optional<std::array<float, 4>> background = {};

    std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>((y + height) % height) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>((x + width) % width);
    }
};

Channels channelsOf(const ImageFile& picture);

// Where x and y are. In `alphaGreen` z is what makes the length 1.
enum class Layout
{
    rgb,
    alphaGreen
};

// What was done to the codes on their way: nothing, or what is for colours alone.
enum class Transfer
{
    none,
    wasEncoded,  // linear to sRGB: 128 became 188
    wasDecoded   // sRGB to linear: 128 became 55
};

// One code as it was before.
float restored(float code, Transfer transfer);

struct NormalField
{
    int width = 0, height = 0;
    std::vector<Vector> normals;

    std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>((y + height) % height) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>((x + width) % width);
    }
};

// 2 c - 1, not made unit length. Of the background a flat normal, which no code stands for.
NormalField fieldOf(const Channels& channels, Layout layout, Transfer transfer);

inline bool isBackground(const Vector& normal)
{
    return normal == Vector{0, 0, 1};
}

float lengthOf(const Vector& v);

// To the nearest codes, halves up, as Relief stores normals (texture/normal_map.h).
Image8 pictureOf(const NormalField& field);

}  // namespace relief::samples::doctor

// Normal maps: unit vectors in a surface's own space, one per texel, from heights or from a picture's colours. What
// enters is a picture; what leaves are levels of floats (rgba32Float: x to the right, y up, z out of the surface, w 0)
// and their codes. Axes are +Y: green is up, and texel row y + 1 lies above row y.
#pragma once

#include <vector>

#include "relief/texture/image.h"
#include "relief/texture/mip_chain.h"

namespace relief {

// How slopes are taken from heights; all neighbours wrap around.
//   smooth: forward differences, h(x + 1, y) - h(x, y) and h(x, y + 1) - h(x, y).
//   sobel: the 3x3 Sobel operator, whose weights 1 2 1 and -1 0 1 are divided by 8: the slope of a plane comes out as
//   it is. Unity's importer calls it sharp.
enum class NormalFilter
{
    smooth,
    sobel
};

// One height per texel, rows from below: values[y * width + x]. Usually in 0..1.
struct HeightField
{
    int width = 0;
    int height = 0;
    std::vector<float> values;
};

// The picture's red channel: code / 255, code / 65535 or the float itself, never decoded as sRGB. A picture's
// numbers are as many as its size says.
HeightField heightsOf(const ImageFile& picture);

// Whether every texel has red = green = blue.
bool isGreyscale(const ImageFile& picture);

// normalize(-dh/du, -dh/dv, 1). `bumpiness`, finite and at least 0, is how far heights 0 and 1 lie apart, in widths of
// the texture: a picture of twice the size has the same slopes. Texels are square. Equal heights give exactly (0, 0,
// 1).
MipLevel normalsFromHeights(const HeightField& heights, float bumpiness, NormalFilter filter);

// 2 * colour - 1, made unit length. Directions below the surface (blue below one half) are kept.
MipLevel normalsFromColors(const ImageFile& picture);

// The vectors of a level, made unit length; coarserLevel() of unit vectors gives shorter ones. A vector without
// direction becomes (0, 0, 1): shorter than 1e-6, where only rounding errors of opposite normals are left, or not
// finite.
MipLevel normalizedNormals(const MipLevel& vectors);

// Turns every normal towards (0, 0, 1) and makes it unit length again: `amount` 0 leaves it, 1 gives exactly (0, 0, 1).
void fadeToFlat(MipLevel& normals, double amount);

// Where the components go.
//   rgb: x, y, z in red, green, blue, and alpha 255.
//   alphaGreen: y in green and x in alpha; red and blue are 255. Unity's DXT5nm, (1, y, 1, x). The sign of z is not
//   stored. A shader that multiplies red by alpha gets x, so it can read (x, y, ., 1) as well.
enum class NormalChannels
{
    rgb,
    alphaGreen
};

// rgba8, frame filled: n * 0.5 + 0.5 to the nearest code, halves up, so that 0 becomes 128. A flat normal read back is
// tilted by asin(sqrt(2) / 255) = 0.318 degrees: no code is one half.
MipLevel encodeNormals(const MipLevel& normals, NormalChannels channels);

}  // namespace relief

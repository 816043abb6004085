// How many texels a pixel covers, and so which mip level it wants (D3D 11.3, 7.18.10 and 7.18.11). What enters are the
// changes of the texture coordinate from one pixel to the next, in texels of level 0; what leaves is a level of detail:
// 0 is one texel per pixel, 1 is two, below 0 is magnified.
#pragma once

#include "relief/hlsl/types.h"
#include "relief/lanes/math.h"

namespace relief::inline RELIEF_WIDTH {

// The square of the longer of the two derivatives. NaN where any of the four numbers is NaN.
inline Float longestSquare(const float2& dX, const float2& dY)
{
    const Float xx = dX.x * dX.x + dX.y * dX.y;
    const Float yy = dY.x * dY.x + dY.y * dY.y;
    return Float(native::maxOrNaN(xx.value, yy.value));
}

// log2 of the longer derivative's length: -infinity for zero, +infinity from lengths of 2^64 texels on.
inline Float isotropicLevel(const float2& dX, const float2& dY)
{
    return 0.5f * log2(longestSquare(dX, dY));
}

// The same for a caller that limits it to the levels of a texture, -16..15.99 of bias included: what is farther away is
// only roughly right: 64 or more for infinity and NaN, whose sign may be set, and about -63 for zero.
inline Float limitedIsotropicLevel(Float longestSquare)
{
    return 0.5f * detail::log2OfNormal(abs(longestSquare));
}

// The area that a pixel covers, as a row of `taps` samples along the vector `axis`, each taken at level `lod`.
struct AnisotropicFootprint
{
    float2 axis;  // texels, the longer of the derivatives
    Float taps;   // 1..maxAnisotropy, whole numbers
    Float ratio;  // before rounding up to taps
    Float lod;
};

// The ratio is that of the longer derivative to the width of the parallelogram that the two span, but at most
// `maxAnisotropy` (1..16); the level follows the shorter side, which is drawn out where the ratio was limited. Where
// the shorter side is magnified, fewer samples do (7.18.11). NaN and infinities give one sample at the isotropic level.
inline AnisotropicFootprint anisotropicFootprint(const float2& dX, const float2& dY, float maxAnisotropy)
{
    const Float xx = dX.x * dX.x + dX.y * dX.y;
    const Float yy = dY.x * dY.x + dY.y * dY.y;
    const Mask xIsLonger = xx >= yy;
    const Float square = longestSquare(dX, dY);
    const Float length = sqrt(square);
    const Float area = abs(dX.x * dY.y - dY.x * dX.y);

    // Where nothing changes at all 0 / 0 makes a NaN, and clamp() a ratio of 1.
    Float ratio = clamp(square / area, 1.0f, maxAnisotropy);
    const Float minor = select(square > area * maxAnisotropy, length / maxAnisotropy, area / length);
    const Mask magnified = minor < 1.0f;
    ratio = select(magnified, max(ratio * minor, 1.0f), ratio);

    const Mask ordinary = (square > 0.0f) & (square < std::numeric_limits<float>::infinity());
    AnisotropicFootprint footprint;
    footprint.axis = {select(xIsLonger, dX.x, dY.x), select(xIsLonger, dX.y, dY.y)};
    footprint.ratio = select(ordinary, ratio, Float(1.0f));
    footprint.taps = ceil(footprint.ratio);
    footprint.lod = select(ordinary, log2(minor), 0.5f * log2(square));
    return footprint;
}

}  // namespace relief::inline RELIEF_WIDTH

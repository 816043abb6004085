// A surface of waves, whose slope along x is A sin t over one period: its normals, and the mean of a whole texture.
#pragma once

#include <cmath>
#include <numbers>

#include "relief/texture/mip_chain.h"

namespace relief::experiments {

// In one row.
inline MipLevel sineNormals(double slope, int texels)
{
    MipLevel level(TexelFormat::rgba32Float, texels, 1);
    for (int x = 0; x < texels; ++x) {
        const double falls = -slope * std::sin(2.0 * std::numbers::pi * (x + 0.5) / texels),
                     length = std::hypot(falls, 1.0);
        float* n = level.texel<float>(x, 0);
        n[0] = static_cast<float>(falls / length);
        n[2] = static_cast<float>(1.0 / length);
    }
    return level;
}

// The last of its mip levels.
inline MipLevel coarsest(MipLevel level)
{
    while (level.width() > 1 || level.height() > 1) level = coarserLevel(TexelFormat::rgba32Float, level);
    return level;
}

}  // namespace relief::experiments

// The sRGB curve as it is defined (IEC 61966-2-1), in double.
#pragma once

#include <algorithm>
#include <cmath>

namespace relief::experiments {

// Of linear light; 0 and 1 beyond them.
inline double encodedSrgb(double linear)
{
    const double x = std::clamp(linear, 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

}  // namespace relief::experiments

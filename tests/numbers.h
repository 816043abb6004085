// Numbers that many tests name.
#pragma once

#include <limits>
#include <numbers>

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr double kPi = std::numbers::pi;

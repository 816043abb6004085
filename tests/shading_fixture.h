// What the tests of shading share: vectors of one lane in double, the angle between two of them, and codes of textures.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include <doctest/doctest.h>

#include "relief/hlsl/intrinsics.h"
#include "stability.h"

namespace fixture {

using namespace relief;
using stability::measured;
using stability::trials;

struct Vector
{
    double x, y, z;
};

inline Vector lane(const float3& v, int i = 0)
{
    return {static_cast<double>(v.x[i]), static_cast<double>(v.y[i]), static_cast<double>(v.z[i])};
}

inline double length(const Vector& v)
{
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

inline Vector unit(const Vector& v)
{
    const double l = length(v);
    return {v.x / l, v.y / l, v.z / l};
}

// In degrees, of vectors of any length. Not by acos of the dot product, which cannot see small angles.
inline double angle(const Vector& a, const Vector& b)
{
    const Vector p = unit(a), q = unit(b);
    const Vector difference = {p.x - q.x, p.y - q.y, p.z - q.z}, sum = {p.x + q.x, p.y + q.y, p.z + q.z};
    return 2.0 * std::atan2(length(difference), length(sum)) * 180.0 / 3.14159265358979323846;
}

inline bool isFinite(const Vector& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool sameBits(const float3& a, const float3& b)
{
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < kLanes; ++i) {
            if (std::bit_cast<std::uint32_t>(a[c][i]) != std::bit_cast<std::uint32_t>(b[c][i])) return false;
        }
    }
    return true;
}

// A DXT5nm texel of these codes.
inline float4 codes(int x, int y)
{
    return {1.0f, static_cast<float>(y) / 255.0f, 1.0f, static_cast<float>(x) / 255.0f};
}

// The normal of a surface with these slopes.
inline float3 sloped(float alongU, float alongV)
{
    return normalize(float3(-alongU, -alongV, 1.0f));
}

}  // namespace fixture

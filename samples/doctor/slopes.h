// What the slopes of a normal map say: whether they are of one surface, which heights give them, and how strong they
// are. Slopes are dh/du to the right and dh/dv up, in texels a texel.
#pragma once

#include <span>
#include <vector>

#include "doctor/normal_picture.h"

namespace relief::samples::doctor {

struct Slopes
{
    int width = 0, height = 0;
    std::vector<float> u, v;

    std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>((y + height) % height) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>((x + width) % width);
    }
};

inline constexpr float kSteepest = 8.0f;  // 83 degrees: beyond it a code says nothing of a slope

// -x / z and -y / z, limited to kSteepest.
Slopes slopesOf(const NormalField& field);

// Central differences of heights, times `scale`.
Slopes slopesOfHeights(const Channels& heights, float scale);

// Of one surface, the slope along u changes along v as the slope along v does along u: both are the same second
// derivative. Their correlation over all texels is 1 then, -1 where one of the axes is mirrored, and near 0 for slopes
// of no surface. 0, too, where nothing changes.
double curlCorrelation(const Slopes& slopes);

// How well one list is a multiple of another: the factor with the least squares, and the correlation.
struct Fit
{
    double factor = 0.0, correlation = 0.0;
};
Fit fit(std::span<const float> of, std::span<const float> to);

// The heights whose slopes are nearest (least squares, repeated at the sides; mean 0, in texels), by conjugate
// gradients on levels of twice the size each. `residual`: the part of the slopes' energy that no heights have, 0 ... 1.
struct Heights
{
    int width = 0, height = 0;
    std::vector<float> values;
    double residual = 0.0, range = 0.0;
};
Heights integrate(const Slopes& slopes);

struct Strength
{
    double rootMeanSquare = 0.0;                  // of both slopes together
    double meanDegrees = 0.0, mostDegrees = 0.0;  // between normal and surface; most: of 99.9 %
};
Strength strengthOf(const Slopes& slopes);

}  // namespace relief::samples::doctor

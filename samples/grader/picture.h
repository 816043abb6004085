// The picture that is judged: a stage at rest, in floats, with its depths; and what is made of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/stage.h"
#include "relief/pipeline/framebuffer.h"
#include "relief/texture/image.h"

namespace relief::samples::grader {

inline constexpr int kWidth = 480, kHeight = 270;

// Every tenth pixel of every tenth row: enough to recognise a picture by, since what is drawn exactly the same way has
// exactly these codes.
inline constexpr int kStep = 10, kSmallWidth = kWidth / kStep, kSmallHeight = kHeight / kStep;

// Colours and depths that hashOf() is taken of. An error is the stage's, or no memory.
Expected<Framebuffer> draw(const Stage& stage, int threads);

// All that draw() gives as bytes, and back; an error where there are fewer or more.
std::vector<std::uint8_t> rawBytes(const Framebuffer& picture);
Expected<Framebuffer> pictureOf(std::span<const std::uint8_t> bytes);

// Colours as they are shown: sRGB codes, R, G, B, A.
Image8 codesOf(const Framebuffer& picture);

Image8 smallOf(const Image8& codes);

// How far two pictures of one size are apart.
struct Distance
{
    double mean = 0.0;  // codes, over all channels but alpha
    int largest = 0;
    int x = 0, y = 0;   // where that is, the first of them
    int differing = 0;  // pixels
};
Distance distanceOf(std::span<const std::uint8_t> first, std::span<const std::uint8_t> second, int width);

}  // namespace relief::samples::grader

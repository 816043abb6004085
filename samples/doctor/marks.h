// What a picture's codes tell of its past: levels that are missing, blocks of a lossy format, a side that does not go
// on.
#pragma once

#include "doctor/normal_picture.h"

namespace relief::samples::doctor {

// Codes of red and green that no texel has, at even distances, though those around them are common.
struct Levels
{
    double missing = 0.0;  // their part of all codes that should be there, 0 ... 1
    double spacing = 1.0;  // from a code that is there to the next, on average
};
Levels levelsOf(const Channels& channels, Layout layout);

// How much steps at every eighth (fourth) column and row stand out among the others: the ratio of the mean changes of
// slope, the larger of the two directions. 1: not at all.
struct Blocks
{
    double eight = 1.0, four = 1.0;
    double fewColors =
        0.0;  // part of the 4x4 squares with variety both ways that have four colours at most: DXT1 and DXT5
};
Blocks blocksOf(const Channels& channels);

// How much larger the step over a side is than those beside it, and than nearly all others.
struct Seam
{
    double leftRight = 1.0, bottomTop = 1.0;
};
Seam seamOf(const Channels& channels);

}  // namespace relief::samples::doctor

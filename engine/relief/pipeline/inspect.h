// Looking inside a frame: for every pixel the numbers of one view (views.h), noted while the frame runs as it always
// does. A client of the pipeline: as long as it looks, each draw has another table of programs, which runs the draw's
// own and notes what is asked for beside it. A frame that nobody looks into knows nothing of it.
#pragma once

#include <cstdint>

#include "relief/pipeline/views.h"

namespace relief::inline RELIEF_WIDTH {

// What the numbers of a pixel are, and so how to show them.
enum class ShowAs
{
    picture,  // there are none: the frame's picture is meant
    scale,    // one number, between `lowest` and `highest`
    vector,   // two to four, all of them between these
    names,    // one number that names something: equal or different
    parity    // 0 or 1 in turn, from block to block
};

struct Inspection
{
    View view;
    ShowAs showAs = ShowAs::scale;
    int width = 0, height = 0, components = 0, tileSize = 0;
    std::vector<glm::vec4> values;    // row by row; empty for a picture
    std::vector<std::uint8_t> drawn;  // 1 where there is a value
    float lowest = 0.0f, highest = 0.0f;
    Statistics statistics;  // of the frame, as run() gives them
};

// Sets the scale's ends to the smallest and the largest finite number of the pixels that have a value.
void fitRange(Inspection& result, bool fromZero);

// Runs the frame and looks. Where several draws cover a pixel it has the value of the last one that was not hidden or
// thrown away; overdraw, samples and time are sums over all of them. What
// a program hides by its own depth or coverage, or alpha to coverage does, has its value all the same: that is known
// only after it was noted. All but time are the same for every number of
// threads; lanes and blocks are the processor's. Draws onto targets without colour are not seen. An error for a view
// that the frame does not have.
Expected<Inspection> inspect(Frame& frame, const std::string& view);

}  // namespace relief::inline RELIEF_WIDTH

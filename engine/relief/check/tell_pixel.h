// How a pixel of a frame came about, in a few lines: what a failing golden test says of the first differing one.
#pragma once

#include <string>

#include "relief/pipeline/frame.h"

namespace relief::inline RELIEF_WIDTH {

// Of each triangle that the pixel was drawn with, the last ones of many: draw, mesh, number, what the fragment program
// gave. The frame's tile is drawn once more (trace/pixel_trace.h), so what it draws must still be there; of a
// frame that does not clear it is drawn onto itself, and the triangles' fate may be another one.
std::string tellPixel(Frame& frame, int x, int y);

}  // namespace relief::inline RELIEF_WIDTH

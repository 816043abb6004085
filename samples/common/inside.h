// What lies behind a picture, as a picture: the numbers of a view (pipeline/views.h) in colours, with a legend that
// says which colour is which number.
#pragma once

#include <string>

#include "pipeline/inspect.h"

namespace relief::samples {

// Runs a frame that was recorded for this target, whose colours are 8-bit sRGB, and shows one of its views on it; empty
// or "color": its picture, with nothing on it. An error for a view that is not there names those that are.
Expected<Statistics> runInside(Frame& frame, Framebuffer& target, const std::string& show);

// A number as a legend writes it: four digits, "0.9873", "1.5e-05".
std::string shortNumber(float number);

}  // namespace relief::samples

// A frame as people see it: its picture with its labels, or what lies behind it: the numbers of a view
// (pipeline/views.h) in colours, with a legend that says which colour is which number.
#pragma once

#include <string>
#include <vector>

#include "common/overlay.h"
#include "relief/pipeline/inspect.h"

namespace relief::samples {

// Runs a frame that was recorded for this target, whose colours are 8-bit sRGB, and shows one of its views on it; empty
// or "color": its picture; of a traced stage also a line's value (trace/variable.h). An error for a view that is not
// there names those that are.
Expected<Statistics> runInside(Frame& frame, Framebuffer& target, const std::string& show,
                               const std::vector<Label>& labels = {});

}  // namespace relief::samples

// From the words of the command line to what is drawn.
#pragma once

#include "common/render.h"
#include "options.h"

namespace relief::samples {

struct Size
{
    int width, height;
};

// "WIDTHxHEIGHT", 1 to 16384 each.
Expected<Size> parseSize(const std::string& text);

// The stage that the options name, with their settings and files.
Expected<PreparedStage> prepare(const RenderOptions& options);

}  // namespace relief::samples

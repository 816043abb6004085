// The commands that render what the window shows, and that tell the life of one of its pixels.
#pragma once

#include <string>

#include "live/renderer.h"

namespace relief::samples {

// For a shell, in the folder that holds `relief`: "./relief render 1.12 --set bumpScale=2 -o picture.png"; `program`:
// "./relief".
std::string renderCommand(const std::string& program, const live::StageSource& source, const live::Look& look,
                          const std::string& output);

// "./relief trace 1.12 --pixel 3,4 --set bumpScale=2"; `words`: what is told of the picture, and how.
std::string traceCommand(const std::string& program, const live::StageSource& source, const std::string& words,
                         const live::Look& look);

}  // namespace relief::samples

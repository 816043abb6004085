// The command that renders what the window shows.
#pragma once

#include <string>

#include "live/renderer.h"

namespace relief::samples {

// For a shell, in the folder that holds `relief`: "./relief render 1.12 --set bumpScale=2 -o picture.png".
std::string renderCommand(const live::StageSource& source, const live::Look& look, const std::string& output);

}  // namespace relief::samples

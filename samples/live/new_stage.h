// `relief new`: a stage of one's own, in one file.
#pragma once

#include <string>

#include "relief/error.h"

namespace relief::samples::live {

// Writes a complete stage: the template, or a copy of a stage's file (`from`, by number, name or path). The function
// that gives the stage gets the file's name. A file that is there already is an error, and nothing is written.
Expected<void> writeNewStage(const std::string& path, const std::string& from);

}  // namespace relief::samples::live

// From a shared object to the stage in it.
#pragma once

#include <cstdint>
#include <vector>

#include "common/stage.h"
#include "live/compile.h"

namespace relief::samples::live {

struct LoadedStage
{
    Stage stage;
    std::vector<std::uint64_t> programs;  // their names, for divided()
};

// Loads an object and calls its function. It stays loaded: nobody knows what still refers to it.
Expected<LoadedStage> loadObject(const std::string& object, const StageSource& source);

// The stage of a file, compiled and loaded into this very program, which keeps it: for commands that run once. What the
// compiler has to say goes to stderr, above the error.
Expected<const Stage*> loadStage(const std::string& path);

}  // namespace relief::samples::live

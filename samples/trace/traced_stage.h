// A stage that tells what its lines give: its source, instrumented, compiled beside the one that does not.
#pragma once

#include "common/stage.h"
#include "live/toolchain.h"

namespace relief::samples::trace {

struct TracedStage
{
    const Stage* plain;   // of this program, or compiled from the source as it is
    const Stage* traced;  // the same, instrumented
    std::string file;     // what its events call the source
    std::string text;     // of the source
    live::StageSource source;
};

// By number, name or path. An error where it does not compile. Takes a second or two.
Expected<TracedStage> loadTraced(const std::string& stage);

}  // namespace relief::samples::trace

// The picture that a learner's file is to give: the answer's.
#pragma once

#include <optional>

#include "live/toolchain.h"

namespace relief::samples::grader {

// The file of the answer, where this is a file of an exercise.
std::optional<live::StageSource> goalOf(const live::StageSource& source);

}  // namespace relief::samples::grader

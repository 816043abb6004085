// The commands of exercises, one function each.
#pragma once

#include <string>

#include "options.h"
#include "relief/error.h"

namespace relief::samples {

// Without a name: lists all exercises, with those that are solved in the folder `exercises`. With one: writes its file
// there.
Expected<void> exercise(const std::string& name);

// Says what is right and what is not. 0: solved, 1: not.
Expected<int> checkExercise(const std::string& file);

// 0, or 1 where something is not solved.
Expected<int> grade(const GradeOptions& options);

}  // namespace relief::samples

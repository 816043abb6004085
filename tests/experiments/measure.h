// Rows from variants: errors computed, times measured, instructions counted.
#pragma once

#include <functional>

#include "error.h"
#include "experiment.h"

namespace relief::experiments {

using Progress = std::function<void(const std::string&)>;

// Errors and times of all variants, which take turns: A B C A B C ..., so many rounds.
Rows measure(const Experiment& experiment, int rounds, const Progress& progress);

// Marks the rows that no rival beats: in error (RMS) and time (fastest).
void markFront(Rows& rows, Rivals rivals);

// Instructions of every counted variant's work, in order. valgrind runs `program report error --count-only`, a relief
// whose instructions it knows (not AVX-512); the same numbers every time.
Expected<std::vector<double>> countInstructions(const std::string& program, const std::string& id);

// What that program does: runs every variant's work once, between two marks for valgrind.
Expected<void> runForCounting(const Experiment& experiment);

}  // namespace relief::experiments

// Rows from variants: errors computed, times measured.
#pragma once

#include <functional>

#include "experiment.h"

namespace relief::experiments {

using Progress = std::function<void(const std::string&)>;

// Errors and times of all variants, which take turns: A B C A B C ..., so many rounds.
Rows measure(const Experiment& experiment, int rounds, const Progress& progress);

// Marks the rows that no rival beats: in error (RMS) and time (fastest).
void markFront(Rows& rows, Rivals rivals);

// For `relief report error --count-only`, which valgrind runs: every counted variant's work once.
void runForCounting(const Experiment& experiment);

}  // namespace relief::experiments

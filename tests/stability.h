// The stability cases: inputs that break a rasterizer that is written the obvious way. stability.cpp has the table of
// them; the test of a case has its id in its name ("clip: ... (S-201)"), and notes here how far off the engine is.
// `relief report stability` runs them all and prints table and numbers (CONTRIBUTING.md, "Add a stability case").
#pragma once

#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace stability {

struct Case
{
    const char* id;
    const char* input;
    const char* naive;    // what goes wrong in the obvious form
    const char* bound;    // what is asked of the engine
    const char* missing;  // why there is no test: the feature that does not exist; nullptr if there is one
};

std::span<const Case> cases();

// The ids in a test's name, in order: those of "clip: ... (S-202, S-206)".
std::vector<std::string> idsIn(const std::string& testName);

// How often to repeat a random trial: a tenth of `small` in builds that are slow, and `full`, unless told otherwise ten
// times as often, where the environment has RELIEF_FULL_TRIALS=1.
int trials(int small, int full = 0);

// A number without a bound, for the report.
void noted(const char* what, double value);

namespace detail {

void check(const char* what, double value, double bound, const char* file, int line);

}  // namespace detail

// Checks value <= bound, and notes both for the report, under the ids of the test that runs.
template <class Value, class Bound>
void measured(const char* what, Value value, Bound bound, const char* file = __builtin_FILE(),
              int line = __builtin_LINE())
{
    detail::check(what, static_cast<double>(value), static_cast<double>(bound), file, line);
}

}  // namespace stability

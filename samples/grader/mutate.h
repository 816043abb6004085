// Wrong answers that nobody has thought of: one small change to the text of a gap, at random. It knows nothing of the
// catalogue, and so can measure it.
#pragma once

#include <string>
#include <vector>

#include "grader/exercise.h"

namespace relief::samples::grader {

struct Mutation
{
    const char* kind;  // "sign", "number", ...
    Span span;         // of the text: what is replaced,
    std::string to;    // and by what

    std::string applied(const std::string& text) const;
};

// All that this program can think of, in the gaps of a text. Many of them do not compile, and some change nothing.
std::vector<Mutation> mutationsOf(const std::string& text);

}  // namespace relief::samples::grader

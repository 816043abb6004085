// A copy of a shader's source that says what its lines give: after each declaration and assignment comes a call that
// tells its value (engine/relief/trace/see.h), with the name that the author wrote, and textures are sampled through
// functions that tell what they did. The lines keep their numbers.
//
// The copy is made from the words of the text, not from a compiler's tree: what the book's shaders and most others are
// written in is understood, and anything else is left as it is.
#pragma once

#include <string>

namespace relief::samples::trace {

// `file`: what the copy calls the source.
std::string instrumented(const std::string& text, const std::string& file);

}  // namespace relief::samples::trace

// Commands of a shell.
#pragma once

#include <optional>
#include <string>

namespace relief::samples {

// What a command prints to stdout and stderr, or nothing where it cannot be run or fails.
std::optional<std::string> outputOf(const std::string& command);

// A word for such a command.
std::string quoted(const std::string& word);

}  // namespace relief::samples

// A learner's file, compiled and drawn in a process of its own, with limits; for a class, in a sandbox of the system.
// That process writes nothing but the picture's bytes: what they are worth is decided here, outside.
#pragma once

#include <optional>
#include <string>

#include "relief/error.h"
#include "relief/pipeline/framebuffer.h"

namespace relief::samples::grader {

struct Limits
{
    double seconds = 10.0;  // of a processor; and three times as long by the clock, for what sleeps
    int megabytes = 3072;   // of addresses, each process
    bool isSandboxed = false;
};

struct Submission
{
    enum class Outcome
    {
        drawn,
        notCompiled,
        refused,  // it compiled, and cannot be drawn: why, in one line
        crashed,
        tooLong,
        tooMuch  // more output than a picture
    };
    Outcome outcome = Outcome::crashed;
    std::optional<Framebuffer> picture;
    std::string said;  // what the compiler or the program said, at most kMostSaid bytes; what went wrong, in one line
    double seconds = 0.0;
};

inline constexpr std::size_t kMostSaid = 16 * 1024;

// "drawn", "not compiled", ...
const char* wordOf(Submission::Outcome outcome);

// Whether there is a sandbox: bubblewrap, and a kernel that lets it. An error names the remedy.
Expected<void> checkSandbox();

// Never fails: whatever goes wrong is the outcome. Can be called by several threads at once.
Submission run(const std::string& path, const Limits& limits);

// What run() starts, in that process: compiles the file, gives up what it does not need (it can start no process
// afterwards), draws, writes the picture to the standard output, and ends. Its exit code: 0, or 3 not compiled, 4
// refused.
[[noreturn]] void renderSubmission(const std::string& path);

}  // namespace relief::samples::grader

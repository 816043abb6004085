// Another process that writes a file for the window, while the window goes on.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "relief/error.h"

namespace relief::samples {

class Errand
{
public:
    // Runs a command of a shell that writes `file`; one that is under way is forgotten. An error where no process can
    // be made.
    Expected<void> begin(const std::string& command, const std::string& file);

    // The file's path, or why there is none; once. Never waits.
    std::optional<Expected<std::string>> poll();

    // Call poll() when it is readable; -1: nothing is under way.
    int descriptor() const { return output ? ::fileno(output.get()) : -1; }

private:
    struct Close
    {
        void operator()(std::FILE* stream) const { ::pclose(stream); }
    };
    std::unique_ptr<std::FILE, Close> output;
    std::string printed, path;
};

// A name for such a file, this process's own: "/tmp/relief-123-pixel.html" of "pixel.html".
std::string temporaryFile(const std::string& name);

}  // namespace relief::samples

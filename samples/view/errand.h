// Another process that writes a file for the window, while the window goes on.
#pragma once

#include <optional>
#include <string>

#include "view/child.h"

namespace relief::samples {

class Errand
{
public:
    // Runs a command of a shell that writes `file`; one that is under way is ended. `worst`: the last exit code that is
    // no failure. An error where no process can be made.
    Expected<void> begin(const std::string& command, const std::string& file, int worst = 0);

    // The file's path, or why there is none; once. Never waits.
    std::optional<Expected<std::string>> poll();

    // What the last one printed.
    const std::string& said() const { return printed; }

    // Call poll() when it is readable; -1: nothing is under way.
    int descriptor() const { return process.stream(); }

private:
    Child process;
    std::string printed, path;
    int worstCode = 0;
};

// A name for such a file, this process's own: "/tmp/relief-123-pixel.html" of "pixel.html".
std::string temporaryFile(const std::string& name);

}  // namespace relief::samples

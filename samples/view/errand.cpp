#include "view/errand.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relief::samples {

Expected<void> Errand::begin(const std::string& command, const std::string& file)
{
    path = file;
    printed.clear();
    // A shell that becomes the program: what ends one ends the other.
    output.reset(::popen(("exec " + command + " 2>&1 </dev/null").c_str(), "re"));
    if (!output) return fail(std::string("no process can be made (") + std::strerror(errno) + "); try again");
    ::fcntl(descriptor(), F_SETFL, O_NONBLOCK);
    return {};
}

std::optional<Expected<std::string>> Errand::poll()
{
    char buffer[4096];
    while (output) {
        const ssize_t size = ::read(descriptor(), buffer, sizeof buffer);
        if (size < 0) return std::nullopt;  // nothing more yet
        if (size > 0) {
            printed.append(buffer, static_cast<std::size_t>(size));
            continue;
        }
        const int status = ::pclose(output.release());
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return path;
        while (!printed.empty() && printed.back() == '\n') printed.pop_back();
        return fail(printed.empty() ? path + " was not written" : printed.substr(printed.rfind('\n') + 1));
    }
    return std::nullopt;
}

std::string temporaryFile(const std::string& name)
{
    std::error_code ignored;
    return (std::filesystem::temp_directory_path(ignored) / ("relief-" + std::to_string(::getpid()) + "-" + name))
        .string();
}

}  // namespace relief::samples

#include "view/errand.h"

#include <cerrno>
#include <filesystem>

#include <unistd.h>

namespace relief::samples {

Expected<void> Errand::begin(const std::string& command, const std::string& file, int worst)
{
    path = file;
    worstCode = worst;
    printed.clear();
    process = {};
    Expected<Child> started = Child::start(command + " </dev/null");
    if (!started) return tl::unexpected(started.error());
    process = std::move(*started);
    return {};
}

std::optional<Expected<std::string>> Errand::poll()
{
    char buffer[4096];
    while (process.stream() >= 0) {
        const ssize_t size = ::read(process.stream(), buffer, sizeof buffer);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) return std::nullopt;  // nothing more yet
        if (size > 0) {
            printed.append(buffer, static_cast<std::size_t>(size));
            continue;
        }
        const int code = process.exitCode();
        process = {};
        if (code >= 0 && code <= worstCode) return path;
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

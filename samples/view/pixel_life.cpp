#include "view/pixel_life.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/shell.h"
#include "live/toolchain.h"
#include "picture_command.h"

namespace relief::samples {

Expected<void> PixelLife::tell(const live::StageSource& source, const live::Look& look, int x, int y)
{
    std::error_code ignored;
    page = (std::filesystem::temp_directory_path(ignored) / ("relief-pixel-" + std::to_string(::getpid()) + ".html"))
               .string();
    const std::string words =
        "--pixel " + std::to_string(x) + "," + std::to_string(y) + " --html " + samples::quoted(page);
    const std::string command = traceCommand(live::programPath(), source, words, look);
    printed.clear();
    // A shell that becomes the program: what ends one ends the other.
    output.reset(::popen(("exec " + command + " 2>&1 </dev/null").c_str(), "re"));
    if (!output) return fail(std::string("the pixel's life cannot be told (") + std::strerror(errno) + "); try again");
    ::fcntl(descriptor(), F_SETFL, O_NONBLOCK);
    return {};
}

std::optional<Expected<std::string>> PixelLife::poll()
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
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return page;
        while (!printed.empty() && printed.back() == '\n') printed.pop_back();
        return fail(printed.empty() ? "the pixel's life was not told" : printed.substr(printed.rfind('\n') + 1));
    }
    return std::nullopt;
}

}  // namespace relief::samples

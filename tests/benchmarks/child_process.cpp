#include "child_process.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relief::benchmarks {

namespace {

void writeAll(int file, const std::string& text)
{
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t written = write(file, text.data() + done, text.size() - done);
        if (written <= 0) return;
        done += static_cast<std::size_t>(written);
    }
}

}  // namespace

Expected<ChildResult> inChild(const std::string& who, const std::function<Expected<std::string>()>& work)
{
    int ends[2];
    if (pipe(ends) != 0) return fail(who + ": no pipe to be had");
    const pid_t child = fork();
    if (child < 0) return fail(who + ": no second process to be had");
    if (child == 0) {
        close(ends[0]);
        const Expected<std::string> result = work();
        writeAll(ends[1], result ? "+" + *result : "-" + result.error().message);
        _exit(0);
    }
    close(ends[1]);
    std::string text;
    char part[4096];
    for (ssize_t length; (length = read(ends[0], part, sizeof part)) > 0;) {
        text.append(part, static_cast<std::size_t>(length));
    }
    close(ends[0]);
    rusage usage{};
    wait4(child, nullptr, 0, &usage);
    if (text.empty()) return fail(who + ": its second process ended early; is there enough memory?");
    if (text[0] == '-') return fail(text.substr(1));
    return ChildResult{text.substr(1), static_cast<double>(usage.ru_maxrss) / 1024.0};
}

}  // namespace relief::benchmarks

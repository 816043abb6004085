#include "view/child.h"

#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace relief::samples {

Child::~Child()
{
    if (itsStream >= 0) ::close(itsStream);
    if (process <= 0) return;
    ::kill(process, SIGTERM);
    ::waitpid(process, nullptr, 0);
}

Child& Child::operator=(Child&& other) noexcept
{
    std::swap(process, other.process);
    std::swap(itsStream, other.itsStream);
    return *this;
}

Expected<Child> Child::start(const std::string& command)
{
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return fail(std::string("no process can be made (") + std::strerror(errno) + "); try again");
    Child child;
    child.itsStream = ends[0];
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int number : {0, 1, 2}) posix_spawn_file_actions_adddup2(&files, ends[1], number);
    // A shell that becomes the program: what ends one ends the other.
    const std::string text = "exec " + command;
    const char* const words[] = {"/bin/sh", "-c", text.c_str(), nullptr};
    const int problem =
        ::posix_spawn(&child.process, words[0], &files, nullptr, const_cast<char* const*>(words), environ);
    posix_spawn_file_actions_destroy(&files);
    ::close(ends[1]);
    if (problem != 0) {
        child.process = -1;
        return fail(std::string("no process can be made (") + std::strerror(problem) + "); try again");
    }
    return child;
}

int Child::exitCode()
{
    int status = 0;
    const pid_t ended = ::waitpid(process, &status, 0);
    process = -1;
    return ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace relief::samples

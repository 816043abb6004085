// Another process of the window's, which ends with the object at the latest.
#pragma once

#include <string>
#include <utility>

#include <sys/types.h>

#include "relief/error.h"

namespace relief::samples {

class Child
{
public:
    Child() = default;  // none
    ~Child();
    Child(Child&& other) noexcept { *this = std::move(other); }
    Child& operator=(Child&& other) noexcept;

    // A command of a shell. An error where no process can be made.
    static Expected<Child> start(const std::string& command);

    // Both ways: what it prints to stdout and stderr, and its stdin. Never waits; read() gives 0 when it has ended. -1:
    // there is none.
    int stream() const { return itsStream; }

    // Of one that has ended: its exit code, or -1 where a signal ended it.
    int exitCode();

private:
    pid_t process = -1;
    int itsStream = -1;
};

}  // namespace relief::samples

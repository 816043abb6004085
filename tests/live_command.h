// Runs a program in a folder: what it prints, and its exit code.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <sys/wait.h>

#include "contents.h"
#include "temporary_folder.h"

struct Outcome
{
    int code;
    std::string out, err;
};

// `environment`: variables, as in NAME=VALUE. What it prints stays in out.txt and err.txt.
inline Outcome runCommand(const TemporaryFolder& folder, const std::string& arguments,
                          const std::string& program = "relief_view", const std::string& input = "/dev/null",
                          const std::string& environment = "")
{
    const std::string command = "cd '" + folder.path.string() + "' && " + environment + " '" RELIEF_PROGRAMS "/" +
                                program + "' " + arguments + " >out.txt 2>err.txt <'" + input + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "out.txt"), contents(folder / "err.txt")};
}

// From a stage's text to a shared object, by compilers that run beside the program.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include <sys/types.h>

#include "live/diagnostics.h"
#include "live/kept_object.h"
#include "live/toolchain.h"

namespace relief::samples::live {

// A folder of this process's own for objects, below the build's; gone with the value.
class PrivateFolder
{
public:
    static Expected<PrivateFolder> create();
    ~PrivateFolder();
    PrivateFolder(PrivateFolder&& other) noexcept : path(std::exchange(other.path, "")), owner(other.owner) {}
    PrivateFolder& operator=(PrivateFolder&&) = delete;

    std::string path;

private:
    PrivateFolder() = default;
    pid_t owner = 0;
};

// Which of several compilers makes code for which of a file's programs (parts.h); part 0 has all the rest, too.
struct Division
{
    unsigned parts = 1;
    std::map<std::uint64_t, unsigned> owners;  // of programs that are known; the others go anywhere
};

// As many compilers as there are processors, at most 8.
unsigned mostParts();

// The programs of an object, dealt out. Where two have the same name nothing can be divided.
Division divided(const std::vector<std::uint64_t>& programs);

struct SourceText
{
    std::string path;  // what messages call it, and where what it includes is looked for
    std::string text;
};

struct Compiled
{
    std::string object;  // empty: there are errors
    std::vector<Diagnostic> errors;
    double compileMilliseconds = 0.0, linkMilliseconds = 0.0;
};

// A compile that runs, or the object of an earlier one. It ends with the value, at once.
class Compile
{
public:
    // `words`: the compiler's, but for files. `version` is part of the files' names: every object has a name of its
    // own.
    Compile(const std::string& compiler, const std::vector<std::string>& words, SourceText source,
            const Division& division, const std::string& folder, int version);
    ~Compile();
    Compile(const Compile&) = delete;
    Compile& operator=(const Compile&) = delete;

    // The result, once. Never waits.
    std::optional<Compiled> poll();

    // Call poll() when one of these is readable.
    std::vector<int> descriptors() const;

    // Waits for the result.
    Compiled wait();

private:
    struct Process
    {
        pid_t id = -1;
        int output = -1;
        std::string printed;
        int status = 0;
    };
    Process start(const std::vector<std::string>& words) const;
    void end(Process& process) const;
    bool read(Process& process) const;
    Compiled failed(std::string printed);

    SourceText source;
    KeptObject kept;
    std::filesystem::file_time_type compileBegin;
    std::string stem;  // of the files
    std::vector<Process> running;
    std::vector<std::string> objects, lists;
    bool linking = false;
    Compiled result;
    std::chrono::steady_clock::time_point begin;
};

// The function that gives the stage: the last `Stage NAME()` at the beginning of a line. Empty: there is none.
std::string stageFunction(const std::string& text);

}  // namespace relief::samples::live

#include "first_frame.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cstdlib>

namespace relief::benchmarks {

namespace {

// From the start of a process that draws one frame alone to the first byte that it writes.
Expected<double> startToPicture(const char* who, int threads, bool cached)
{
    const std::string side = std::to_string(kFirstFrameSide);
    std::vector<std::string> words = {"relief",    "bench",
                                      "--peer",    "mesa",
                                      "--alone",   who,
                                      "--scene",   kFirstFrameScene,
                                      "--size",    side + "x" + side,
                                      "--threads", std::to_string(threads)};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    setenv("MESA_SHADER_CACHE_DISABLE", cached ? "false" : "true", 1);

    int ends[2];
    if (pipe(ends) != 0) return fail("bench --peer: no pipe to be had");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    const auto begin = std::chrono::steady_clock::now();
    pid_t child = 0;
    const int refused = posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    char byte = 0;
    const bool drawn = refused == 0 && read(ends[0], &byte, 1) == 1;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    close(ends[0]);
    if (refused == 0) waitpid(child, nullptr, 0);
    if (!drawn) return fail("bench --peer: a process that was to draw one frame with " + std::string(who) + " did not");
    return seconds;
}

}  // namespace

Expected<FirstFrames> measureFirstFrames(int pairs, int threads)
{
    FirstFrames all;
    const auto add = [threads](const char* who, bool cached, std::vector<double>& seconds) -> Expected<void> {
        return startToPicture(who, threads, cached).map([&](double s) { seconds.push_back(s); });
    };
    // The first round brings files into memory, and programs into Mesa's cache; it does not count.
    for (int i = 0; i <= pairs; ++i) {
        if (i == 1) all = {};
        for (const Expected<void>& result :
             {add("relief", false, all.relief), add("mesa", false, all.mesa), add("mesa", true, all.mesaCached)}) {
            if (!result) return tl::unexpected(result.error());
        }
    }
    return all;
}

}  // namespace relief::benchmarks

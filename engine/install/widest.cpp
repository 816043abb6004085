// A program of several widths: starts the widest one that this processor runs, in its own place. They lie in
// RELIEF_PROGRAMS, a folder seen from this program's, and their names end with _lanes4, _lanes8, _lanes16.
// RELIEF_LANES=4, 8 or 16 in the environment chooses one. A first word that names a program of its own starts that:
// relief_check for `relief check`. Linux.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

namespace {

namespace fs = std::filesystem;

// x86-64-v3 and v4, which the wider programs are compiled for.
bool runs(int lanes)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                        __builtin_cpu_supports("avx512cd");
    return lanes == 4 || (lanes == 8 && avx2) || (lanes == 16 && avx512);
#else
    return lanes == 4;
#endif
}

int refuse(const std::string& message)
{
    std::fprintf(stderr, RELIEF_PROGRAM ": %s\n", message.c_str());
    return 2;
}

}  // namespace

int main(int argc, char** argv)
{
    std::error_code problem;
    const fs::path self = fs::read_symlink("/proc/self/exe", problem);
    if (problem) return refuse("/proc/self/exe cannot be read (" + problem.message() + "); mount /proc");
    std::string program = (self.parent_path() / RELIEF_PROGRAMS / RELIEF_PROGRAM).lexically_normal().string();
    const auto at = [&](int lanes) { return program + "_lanes" + std::to_string(lanes); };
    const auto exists = [&](int lanes) { return fs::exists(at(lanes), problem); };

    if (argc > 1) {
        std::string word = argv[1];
        std::replace(word.begin(), word.end(), '-', '_');
        const std::string whole = program;
        program += '_' + word;
        if (!exists(4)) program = whole;
    }
    int lanes = 0;
    const char* const chosen = std::getenv("RELIEF_LANES");
    if (chosen != nullptr && *chosen != '\0') {
        for (const int width : {4, 8, 16}) {
            if (std::to_string(width) == chosen) lanes = width;
        }
        if (lanes == 0) return refuse(std::string("RELIEF_LANES=") + chosen + ": choose 4, 8 or 16");
        if (!runs(lanes)) {
            return refuse(std::string("RELIEF_LANES=") + chosen + ": this processor has no " +
                          (lanes == 16 ? "AVX-512; choose 4 or 8" : "AVX2; choose 4"));
        }
        if (!exists(lanes)) return refuse(at(lanes) + ": not installed; choose other RELIEF_LANES, or none");
    } else {
        for (const int width : {4, 8, 16}) {
            if (runs(width) && exists(width)) lanes = width;
        }
        if (lanes == 0) return refuse(at(4) + ": missing; install it again");
    }
#if defined(RELIEF_ASSETS_BESIDE)
    ::setenv("RELIEF_ASSETS", (self.parent_path() / RELIEF_ASSETS_BESIDE).lexically_normal().c_str(), 0);
#endif
    ::execv(at(lanes).c_str(), argv);
    return refuse(at(lanes) + ": cannot be started (" + std::strerror(errno) + ")");
}

#include "live/toolchain.h"

#include <filesystem>

#include <unistd.h>

#include "common/stage_names.h"

namespace relief::samples::live {

namespace {

bool isThere(const Toolchain& toolchain)
{
    return ::access(toolchain.path.c_str(), X_OK) == 0;
}

bool hasHeaders(const Toolchain& toolchain)
{
    std::error_code ignored;
    return std::filesystem::exists(toolchain.precompiled, ignored);
}

}  // namespace

Expected<const Toolchain*> findToolchain(const std::string& name)
{
    std::string lacking;
    for (const Toolchain& toolchain : toolchains()) {
        if (!isThere(toolchain) || (!name.empty() && name != toolchain.name)) continue;
        if (hasHeaders(toolchain)) return &toolchain;
        if (lacking.empty()) lacking = toolchain.name;
    }
    if (!lacking.empty()) {
        return fail("compiler " + lacking + ": its precompiled headers are missing; build the target " +
                    "relief_live_headers_" + lacking + " (./relief does)");
    }
    if (!name.empty()) {
        return fail("compiler " + name + ": this build has no such one; write g++ or clang++, install it " +
                    "(Debian: apt-get install g++ or clang) and configure again");
    }
    return fail("no compiler for stages: install g++ 12 or later, or clang 14 or later (Debian: apt-get install g++)");
}

Expected<const Toolchain*> findTracedToolchain()
{
    for (const Toolchain& toolchain : toolchains()) {
        std::error_code ignored;
        if (isThere(toolchain) && std::filesystem::exists(toolchain.tracedPrecompiled, ignored)) return &toolchain;
    }
    return fail(
        "the precompiled headers for traces are missing; build the target relief_traced_headers (./relief does)");
}

bool namesFile(const std::string& stage)
{
    return stage.ends_with(".cpp");
}

Expected<StageSource> findSource(const std::string& stage)
{
    if (namesFile(stage)) {
        std::error_code ignored;
        const std::filesystem::path path = std::filesystem::absolute(stage, ignored);
        if (!std::filesystem::is_regular_file(path, ignored)) {
            return fail(stage + ": there is no such file; `relief new " + stage + "` writes one");
        }
        return StageSource{.stem = path.stem().string(), .path = path.string()};
    }
    return findByName(stageSources(), stage).map([](const StageSource* found) { return *found; });
}

}  // namespace relief::samples::live

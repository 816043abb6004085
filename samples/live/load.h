// From a shared object to the stage in it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/stage.h"
#include "live/compile.h"

namespace relief::samples::live {

struct LoadedStage
{
    Stage stage;
    std::vector<std::uint64_t> programs;  // their names, for divided()
};

// Loads an object and calls its function. It stays loaded: nobody knows what still refers to it.
Expected<LoadedStage> loadObject(const std::string& object, const StageSource& source);

// The compile of a stage's file, beside this program, for commands that run once. What it gives is loaded into this
// very program, which keeps it. What the compiler has to say goes to stderr, above the error.
class StageCompile
{
public:
    // `text` is compiled as the source's; with the traced headers, if it is instrumented.
    static Expected<StageCompile> start(const StageSource& source, const std::string& text, bool isTraced = false);

    Expected<const Stage*> finish();

private:
    StageCompile(const StageSource& its, PrivateFolder itsFolder, std::unique_ptr<Compile> running)
        : source(its), folder(std::move(itsFolder)), compile(std::move(running))
    {
    }

    StageSource source;
    PrivateFolder folder;
    std::unique_ptr<Compile> compile;
};

// The stage of a file, compiled and loaded.
Expected<const Stage*> loadStage(const std::string& path);

}  // namespace relief::samples::live

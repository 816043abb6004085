#include "live/load.h"

#include <cstdio>
#include <deque>

#include <dlfcn.h>

#include "live/compiled_programs.h"
#include "relief/file.h"

namespace relief::samples::live {

Expected<LoadedStage> loadObject(const std::string& object, const StageSource& source)
{
    void* const handle = ::dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        const char* const why = ::dlerror();
        return fail(source.path + ": the compiled stage cannot be loaded (" + (why != nullptr ? why : "no reason") +
                    "); what it calls has to be in Relief, in a header or in the file itself");
    }
    const auto* const function = static_cast<Stage (*const*)()>(::dlsym(handle, "relief_stage"));
    const auto* const programs =
        static_cast<const relief::detail::CompiledPrograms* const* const*>(::dlsym(handle, "relief_programs"));
    if (function == nullptr || programs == nullptr) return fail(object + ": is no compiled stage");
    LoadedStage loaded{.stage = (*function)(), .programs = {}};
    loaded.stage.id = source.id.empty() ? source.stem : source.id;
    loaded.stage.stem = source.stem;
    loaded.stage.folder = source.folder;
    loaded.stage.tutorial = source.tutorial;
    for (const relief::detail::CompiledPrograms* p = **programs; p != nullptr; p = p->next)
        loaded.programs.push_back(p->id);
    return loaded;
}

Expected<StageCompile> StageCompile::start(const StageSource& source, const std::string& text, bool isTraced)
{
    const Expected<const Toolchain*> toolchain = isTraced ? findTracedToolchain() : findToolchain();
    if (!toolchain) return tl::unexpected(toolchain.error());
    Expected<PrivateFolder> folder = PrivateFolder::create();
    if (!folder) return tl::unexpected(folder.error());
    const std::vector<std::string>& words = isTraced ? (*toolchain)->tracedWords : (*toolchain)->words;
    auto compile = std::make_unique<Compile>((*toolchain)->path, words, SourceText{source.path, text},
                                             Division{.parts = 1, .owners = {}}, folder->path, 0);
    return StageCompile(source, std::move(*folder), std::move(compile));
}

Expected<const Stage*> StageCompile::finish()
{
    static std::deque<Stage> stages;  // as long as the program runs: so do their programs
    const Compiled compiled = compile->wait();
    if (compiled.object.empty()) {
        std::fputs(formatted(compiled.errors).c_str(), stderr);
        const Diagnostic& first = compiled.errors.front();
        return fail(source.path + (first.line > 0 ? ":" + std::to_string(first.line) : "") +
                    ": does not compile; the first error is above");
    }
    Expected<LoadedStage> loaded = loadObject(compiled.object, source);
    if (!loaded) return tl::unexpected(loaded.error());
    return &stages.emplace_back(std::move(loaded->stage));
}

Expected<const Stage*> loadStage(const std::string& path)
{
    const Expected<StageSource> source = findSource(path);
    if (!source) return tl::unexpected(source.error());
    const Expected<std::string> text = readText(source->path);
    if (!text) return tl::unexpected(text.error());
    Expected<StageCompile> compile = StageCompile::start(*source, *text);
    if (!compile) return tl::unexpected(compile.error());
    return compile->finish();
}

}  // namespace relief::samples::live

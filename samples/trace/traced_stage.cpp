#include "trace/traced_stage.h"

#include "live/load.h"
#include "relief/file.h"
#include "trace/instrument.h"

namespace relief::samples::trace {

Expected<TracedStage> loadTraced(const std::string& name)
{
    const Expected<live::StageSource> source = live::findSource(name);
    if (!source) return tl::unexpected(source.error());
    const Expected<std::string> text = readText(source->path);
    if (!text) return tl::unexpected(text.error());
    TracedStage result{nullptr, nullptr, source->stem + ".cpp", *text, *source};

    Expected<live::StageCompile> traced = live::StageCompile::start(*source, instrumented(*text, result.file), true);
    if (!traced) return tl::unexpected(traced.error());
    if (!live::namesFile(name)) {
        if (const Expected<const Stage*> known = findStage(name)) result.plain = *known;
    }
    if (result.plain == nullptr) {
        Expected<live::StageCompile> compile = live::StageCompile::start(*source, *text);
        if (!compile) return tl::unexpected(compile.error());
        const Expected<const Stage*> plain = compile->finish();
        if (!plain) return tl::unexpected(plain.error());
        result.plain = *plain;
    }
    const Expected<const Stage*> told = traced->finish();
    if (!told) return tl::unexpected(told.error());
    result.traced = *told;
    return result;
}

}  // namespace relief::samples::trace

#include "commands.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "common/inside.h"
#include "relief/pipeline/instruments.h"
#include "relief/trace/variable.h"

namespace relief::samples {

Expected<Statistics> renderToFile(const PreparedStage& stage, Size size, const FrameOptions& how, int samples,
                                  const std::string& path, const std::string& show)
{
    Expected<Framebuffer> target =
        Framebuffer::create(size.width, size.height, Format::rgba8Srgb, Store::discard, samples);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, how);
    stage.record(frame, size.width, size.height);
    if (const std::string problem = stage.problem(frame); !problem.empty()) return fail(problem);
    const Expected<Statistics> statistics = runInside(frame, *target, show, stage.log->labels);
    if (!statistics) return fail("--show " + show + ": " + statistics.error().message);
    const Expected<void> written = writePng(path, *target);
    if (!written) return tl::unexpected(written.error());
    return statistics;
}

namespace {

// What `render --show list` prints.
Expected<void> listViews(const PreparedStage& stage, Size size)
{
    Expected<Framebuffer> target = Framebuffer::create(16, 16);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {.threads = 1});
    stage.record(frame, size.width, size.height);
    if (const std::string problem = stage.problem(frame); !problem.empty()) return fail(problem);
    for (const View& view : viewsOf(frame)) std::printf("%-10s %s\n", view.name.c_str(), view.meaning.c_str());
    return {};
}

}  // namespace

Expected<void> render(const RenderOptions& options, const std::string& output)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    const Expected<PreparedStage> prepared =
        relief::trace::namesVariable(options.show) ? prepareTraced(options) : prepare(options);
    if (!prepared) return tl::unexpected(prepared.error());
    if (options.show == "list") return listViews(*prepared, *size);
    const std::string path = output.empty() ? prepared->stage->stem + ".png" : output;
    const Expected<Statistics> done =
        renderToFile(*prepared, *size, {.threads = options.threads, .tileSize = options.tileSize}, options.samples,
                     path, options.show);
    if (!done) return tl::unexpected(done.error());
    std::printf("%s\n", path.c_str());
    return {};
}

Expected<void> hash(const RenderOptions& options)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    const Expected<PreparedStage> prepared = prepare(options);
    if (!prepared) return tl::unexpected(prepared.error());
    Expected<Framebuffer> target =
        Framebuffer::create(size->width, size->height, Format::rgba32f, Store::keep, options.samples);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {.threads = options.threads, .tileSize = options.tileSize});
    prepared->record(frame, size->width, size->height);
    if (const std::string problem = prepared->problem(frame); !problem.empty()) return fail(problem);
    frame.run();
    std::printf("%s  %s\n", hexadecimal(hashOf(*target)).c_str(), prepared->stage->stem.c_str());
    return {};
}

// Every signature once, in the order of the draws.
Expected<void> signature(const RenderOptions& options, const std::string& binormal)
{
    RenderOptions chosen = options;
    const bool perFragment = binormal.empty() ? kBinormalPerFragment : binormal == "fragment";
    const Expected<const Stage*> stage = stageOf(options.stage);
    if (!stage) return tl::unexpected(stage.error());
    const std::vector<Property> all = (*stage)->properties();
    const bool hasVariants =
        std::any_of(all.begin(), all.end(), [](const Property& p) { return p.name == "binormalPerFragment"; });
    if (!binormal.empty() && !hasVariants) {
        return fail("--binormal " + binormal + ": stage " + (*stage)->id +
                    " has one variant only; use it with 1.24 or 1.25, or leave it out");
    }
    if (hasVariants)
        chosen.settings.insert(chosen.settings.begin(),
                               perFragment ? "binormalPerFragment=1" : "binormalPerFragment=0");
    const Expected<PreparedStage> prepared = prepare(chosen);
    if (!prepared) return tl::unexpected(prepared.error());
    Expected<Framebuffer> target = Framebuffer::create(16, 16);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {.threads = 1});
    prepared->record(frame, 16, 16);
    if (const std::string problem = prepared->problem(frame); !problem.empty()) return fail(problem);
    std::set<std::string> printed;
    for (int draw = 0; draw < frame.drawCount(); ++draw) {
        const std::string table = *outputSignature(frame, draw);
        if (printed.insert(table).second) std::printf("%s%s", printed.size() > 1 ? "\n" : "", table.c_str());
    }
    return {};
}

}  // namespace relief::samples

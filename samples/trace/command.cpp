#include "trace/command.h"

#include <charconv>
#include <cstdio>

#include "picture_command.h"
#include "prepare.h"
#include "relief/file.h"
#include "relief/trace/variable.h"
#include "trace/tell.h"

namespace relief::samples {

namespace {

using namespace samples::trace;
using relief::trace::tracePixel;

struct Pixel
{
    int x, y;
};

Expected<Pixel> parsePixel(const std::string& text)
{
    Pixel pixel{};
    const char* const end = text.data() + text.size();
    const auto [comma, xError] = std::from_chars(text.data(), end, pixel.x);
    if (xError == std::errc() && comma != end && *comma == ',') {
        const auto [rest, yError] = std::from_chars(comma + 1, end, pixel.y);
        if (yError == std::errc() && rest == end) return pixel;
    }
    return fail("--pixel " + text + ": write X,Y, counted from the upper left pixel 0,0, such as 480,270");
}

// A stage's frame on a target of its own.
struct Recorded
{
    std::unique_ptr<Framebuffer> target;
    std::unique_ptr<Frame> frame;
    std::unique_ptr<PreparedStage> stage;

    static Expected<Recorded> record(const Stage& stage, const RenderOptions& options, Size size)
    {
        Expected<PreparedStage> prepared = prepare(stage, options);
        if (!prepared) return tl::unexpected(prepared.error());
        Expected<Framebuffer> target =
            Framebuffer::create(size.width, size.height, Format::rgba8Srgb, Store::discard, options.samples);
        if (!target) return tl::unexpected(target.error());
        Recorded all;
        all.stage = std::make_unique<PreparedStage>(std::move(*prepared));
        all.target = std::make_unique<Framebuffer>(std::move(*target));
        all.frame = std::make_unique<Frame>(*all.target,
                                            FrameOptions{.threads = options.threads, .tileSize = options.tileSize});
        all.stage->record(*all.frame, size.width, size.height);
        if (const std::string problem = all.stage->problem(*all.frame); !problem.empty()) return fail(problem);
        return all;
    }
};

// A stage that tells, its frame, and where its lines are.
struct Telling
{
    TracedStage stage;
    Subject subject;
    Recorded recorded;

    // `words`: of the command line, after the stage.
    static Expected<Telling> record(const RenderOptions& options, const std::string& words)
    {
        const Expected<Size> size = parseSize(options.size);
        if (!size) return tl::unexpected(size.error());
        Expected<TracedStage> stage = loadTraced(options.stage);
        if (!stage) return tl::unexpected(stage.error());
        const Expected<live::Look> look = lookOf(options);
        if (!look) return tl::unexpected(look.error());
        Expected<Recorded> recorded = Recorded::record(*stage->traced, options, *size);
        if (!recorded) return tl::unexpected(recorded.error());
        Subject subject(*stage, traceCommand("./relief", stage->source, words, *look));
        return Telling{std::move(*stage), std::move(subject), std::move(*recorded)};
    }
};

Expected<void> tellVertex(const TraceOptions& options)
{
    const std::string words = "--vertex " + std::to_string(options.vertex);
    const Expected<Telling> telling =
        Telling::record(options.render, options.draw == 0 ? words : words + " --draw " + std::to_string(options.draw));
    if (!telling) return tl::unexpected(telling.error());
    const Expected<relief::trace::VertexTrace> vertex =
        relief::trace::traceVertex(*telling->recorded.frame, options.draw, static_cast<std::uint32_t>(options.vertex));
    if (!vertex) return fail(words + ": " + vertex.error().message);
    std::fputs(toText(tell(*vertex, telling->subject), options.all).c_str(), stdout);
    return {};
}

Expected<void> tellFirstNan(const RenderOptions& options)
{
    const Expected<Telling> telling = Telling::record(options, "--first-nan");
    if (!telling) return tl::unexpected(telling.error());
    const std::optional<relief::trace::NotFinite> first = relief::trace::firstNotFinite(*telling->recorded.frame);
    if (!first) {
        std::printf("every value of every line is finite, in all pixels of %s\n", options.size.c_str());
        return {};
    }
    std::printf("pixel %d,%d, draw %d: %s:%d: %s%s is %s\n  | %s\n", first->x, first->y, first->draw, first->site.file,
                first->site.line, first->site.name, first->field.c_str(),
                first->value != first->value ? "NaN" : "infinite", telling->subject.line(first->site).c_str());
    return {};
}

// What is told of a stage's pixel, and the picture that it is in: the plain program's.
struct Told
{
    PixelTrace trace;
    Subject subject;
    Recorded picture;
};

Expected<Told> toldOf(const RenderOptions& options, const std::string& pixelText)
{
    const Expected<Pixel> pixel = parsePixel(pixelText);
    if (!pixel) return tl::unexpected(pixel.error());
    const Expected<Telling> telling = Telling::record(options, "--pixel " + pixelText);
    if (!telling) return tl::unexpected(telling.error());
    const Expected<PixelTrace> trace = tracePixel(*telling->recorded.frame, pixel->x, pixel->y);
    if (!trace) return fail("--pixel " + pixelText + ": " + trace.error().message);
    const int width = telling->recorded.target->width();
    Expected<Recorded> plain =
        Recorded::record(*telling->stage.plain, options, {width, telling->recorded.target->height()});
    if (!plain) return tl::unexpected(plain.error());
    plain->frame->run();
    const auto at =
        static_cast<std::size_t>(pixel->y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(pixel->x);
    if (plain->target->color8()[at] != trace->storedWords[0]) {
        return fail("--pixel " + pixelText +
                    ": the trace does not end at the picture's pixel; this is a defect of Relief, please report it");
    }
    return Told{*trace, telling->subject, std::move(*plain)};
}

}  // namespace

Expected<PreparedStage> prepareTraced(const RenderOptions& options)
{
    const Expected<TracedStage> stage = loadTraced(options.stage);
    if (!stage) return tl::unexpected(stage.error());
    return prepare(*stage->traced, options);
}

Expected<void> traceStage(const TraceOptions& options)
{
    if (options.vertex >= 0) return tellVertex(options);
    if (options.firstNan) return tellFirstNan(options.render);
    const Expected<Told> told = toldOf(options.render, options.pixel);
    if (!told) return tl::unexpected(told.error());
    if (!options.against.empty()) {
        RenderOptions other = options.render;
        other.stage = options.against;
        const Expected<Told> second = toldOf(other, options.pixel);
        if (!second) return tl::unexpected(second.error());
        const std::string difference =
            firstDifference(tell(told->trace, told->subject), tell(second->trace, second->subject));
        std::printf("%s\n", difference.empty() ? "the traces are the same" : difference.c_str());
        return {};
    }
    if (!options.html.empty()) {
        const Expected<std::string> page = toHtml(told->trace, told->subject, told->picture.target->color8());
        if (!page) return tl::unexpected(page.error());
        const Expected<void> written =
            writeFileAtomically(options.html, {reinterpret_cast<const std::uint8_t*>(page->data()), page->size()});
        if (!written) return tl::unexpected(written.error());
        std::printf("%s\n", options.html.c_str());
        return {};
    }
    std::fputs(options.json ? toJson(told->trace, told->subject).c_str()
                            : toText(tell(told->trace, told->subject), options.all).c_str(),
               stdout);
    return {};
}

}  // namespace relief::samples

#include "trace/command.h"

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>

#include <unistd.h>

#include "common/shell.h"
#include "picture_command.h"
#include "prepare.h"
#include "relief/file.h"
#include "relief/trace/variable.h"
#include "trace/tell.h"

namespace relief::samples {

namespace {

namespace fs = std::filesystem;
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

// A stage's source as its last commit has it, in a file of the same name.
struct CommittedSource
{
    fs::path folder, file;

    static Expected<CommittedSource> write(const std::string& stage)
    {
        const Expected<live::StageSource> source = live::findSource(stage);
        if (!source) return tl::unexpected(source.error());
        const fs::path path = source->path;
        const std::optional<std::string> text = outputOf("git -C " + quoted(path.parent_path().string()) + " show " +
                                                         quoted("HEAD:./" + path.filename().string()) + " 2>/dev/null");
        if (!text) return fail("--against committed: git has no committed " + path.string());
        CommittedSource committed;
        committed.folder = fs::temp_directory_path() / ("relief-committed-" + std::to_string(::getpid()));
        committed.file = committed.folder / path.filename();
        std::error_code error;
        fs::create_directories(committed.folder, error);
        const Expected<void> written = writeFileAtomically(
            committed.file.string(), {reinterpret_cast<const std::uint8_t*>(text->data()), text->size()});
        if (!written) return tl::unexpected(written.error());
        return committed;
    }

    CommittedSource() = default;
    CommittedSource(CommittedSource&& other) noexcept
        : folder(std::exchange(other.folder, {})), file(std::move(other.file))
    {
    }
    ~CommittedSource()
    {
        std::error_code ignored;
        if (!folder.empty()) fs::remove_all(folder, ignored);
    }
};

// Tells of one pixel after the other of a stage, and checks each against the plain program's picture.
struct PixelTelling
{
    Telling telling;
    Recorded picture;  // the plain program's

    static Expected<PixelTelling> record(const RenderOptions& options, const std::string& words)
    {
        Expected<Telling> telling = Telling::record(options, words);
        if (!telling) return tl::unexpected(telling.error());
        const Framebuffer& target = *telling->recorded.target;
        Expected<Recorded> plain = Recorded::record(*telling->stage.plain, options, {target.width(), target.height()});
        if (!plain) return tl::unexpected(plain.error());
        plain->frame->run();
        return PixelTelling{std::move(*telling), std::move(*plain)};
    }

    // `text`: "X,Y".
    Expected<PixelTrace> trace(const std::string& text) const
    {
        const Expected<Pixel> pixel = parsePixel(text);
        if (!pixel) return tl::unexpected(pixel.error());
        const Expected<PixelTrace> trace = tracePixel(*telling.recorded.frame, pixel->x, pixel->y);
        if (!trace) return fail("--pixel " + text + ": " + trace.error().message);
        const auto at = static_cast<std::size_t>(pixel->y) * static_cast<std::size_t>(trace->width) +
                        static_cast<std::size_t>(pixel->x);
        if (picture.target->color8()[at] != trace->storedWords[0]) {
            return fail(
                "--pixel " + text +
                ": the trace does not end at the picture's pixel; this is a defect of Relief, please report it");
        }
        return trace;
    }
};

// Pixels from standard input, one "X,Y" a line; the answer to each is a line of JSON: its life, or {"error": "..."}.
Expected<void> answerPixels(const RenderOptions& options)
{
    const Expected<PixelTelling> telling = PixelTelling::record(options, "--pixel -");
    if (!telling) return tl::unexpected(telling.error());
    std::string line;
    while (std::getline(std::cin, line)) {
        const Expected<PixelTrace> trace = telling->trace(line);
        std::fputs(
            trace ? toJson(*trace, telling->telling.subject, true).c_str() : errorToJson(trace.error().message).c_str(),
            stdout);
        std::fflush(stdout);
    }
    return {};
}

// Where the same pixel's life is another one in another stage, or in the same stage as it is committed.
Expected<void> tellDifference(const TraceOptions& options, const Node& life)
{
    std::optional<CommittedSource> committed;
    TraceOptions other = options;
    other.render.stage = options.against;
    if (options.against == "committed") {
        Expected<CommittedSource> source = CommittedSource::write(options.render.stage);
        if (!source) return tl::unexpected(source.error());
        committed.emplace(std::move(*source));
        other.render.stage = committed->file.string();
    }
    const Expected<PixelTelling> telling = PixelTelling::record(other.render, "--pixel " + options.pixel);
    if (!telling) return tl::unexpected(telling.error());
    const Expected<PixelTrace> trace = telling->trace(options.pixel);
    if (!trace) return tl::unexpected(trace.error());
    Node second = tell(*trace, telling->telling.subject);
    if (committed) second.label = "committed";
    const std::string difference = firstDifference(life, second);
    std::printf("%s\n", difference.empty() ? "the traces are the same" : difference.c_str());
    return {};
}

}  // namespace

Expected<void> traceStage(const TraceOptions& options)
{
    if (options.vertex >= 0) return tellVertex(options);
    if (options.firstNan) return tellFirstNan(options.render);
    if (options.pixel == "-") return answerPixels(options.render);
    if (const Expected<Pixel> pixel = parsePixel(options.pixel); !pixel) return tl::unexpected(pixel.error());
    const Expected<PixelTelling> telling = PixelTelling::record(options.render, "--pixel " + options.pixel);
    if (!telling) return tl::unexpected(telling.error());
    const Expected<PixelTrace> trace = telling->trace(options.pixel);
    if (!trace) return tl::unexpected(trace.error());
    const Subject& subject = telling->telling.subject;
    if (!options.against.empty()) return tellDifference(options, tell(*trace, subject));
    if (!options.html.empty()) {
        const Expected<std::string> page = toHtml(*trace, subject, telling->picture.target->color8());
        if (!page) return tl::unexpected(page.error());
        const Expected<void> written =
            writeFileAtomically(options.html, {reinterpret_cast<const std::uint8_t*>(page->data()), page->size()});
        if (!written) return tl::unexpected(written.error());
        std::printf("%s\n", options.html.c_str());
        return {};
    }
    std::fputs(options.json ? toJson(*trace, subject).c_str() : toText(tell(*trace, subject), options.all).c_str(),
               stdout);
    return {};
}

}  // namespace relief::samples

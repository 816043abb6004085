// bench --live: from a save to the picture. A copy of each stage's file is edited and saved as an editor does it; the
// window is a real one, of whatever SDL finds (Xvfb, or its dummy driver where there is no display).
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <SDL.h>

#include "commands.h"
#include "live/session.h"
#include "relief/file.h"
#include "view/pixels.h"
#include "view/window.h"

namespace relief::samples {

namespace {

using Clock = live::Watch::Clock;

constexpr int kErrors = 5;  // saves with a mistake, at most

double milliseconds(Clock::duration time)
{
    return std::chrono::duration<double, std::milli>(time).count();
}

struct Saves
{
    std::vector<double> total, notice, compile, link, load, draw;
    std::vector<double> error;  // from a save that does not compile to its error
    std::size_t programs = 0;
};

// The slowest of some stages.
struct Slowest
{
    double median = 0.0;
    std::string stage = "none";

    void consider(double its, const std::string& id)
    {
        if (its > median) *this = {its, id};
    }
};

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Two minutes at most.
template <class Condition>
Expected<void> await(live::Session& session, const char* what, const Condition& condition)
{
    const Clock::time_point begin = Clock::now();
    while (!condition()) {
        session.update(std::chrono::milliseconds(100));
        if (Clock::now() - begin > std::chrono::minutes(2))
            return fail(session.source().path + ": no " + what + " in time");
    }
    return {};
}

// The version's picture, in the window.
Expected<void> awaitPicture(live::Session& session, Window& window, int version)
{
    const Expected<void> ready =
        await(session, "picture", [&] { return session.picture().version >= version || session.problem() != nullptr; });
    if (!ready) return ready;
    if (session.problem() != nullptr) {
        std::fputs(session.problem()->text().c_str(), stderr);
        return fail(session.source().path + ": gives no picture; see above");
    }
    SDL_PumpEvents();
    const live::Picture& picture = session.picture();
    window.show({picture.drawn.width, picture.drawn.height, picture.pixels});
    return {};
}

Expected<Saves> measure(const live::StageSource& source, const LiveBenchOptions& options, const live::Look& look,
                        live::Maker& maker, Window& window)
{
    const Expected<live::PrivateFolder> folder = live::PrivateFolder::create();
    if (!folder) return tl::unexpected(folder.error());
    live::StageSource copy = source;
    copy.path = folder->path + "/" + source.stem + ".cpp";
    const Expected<std::string> text = readText(source.path);
    if (!text) return tl::unexpected(text.error());
    const auto save = [&](const std::string& line) { std::ofstream(copy.path, std::ios::binary) << *text << line; };
    save("");
    Expected<std::unique_ptr<live::Session>> session = live::Session::open(copy, look, maker, options.compiler);
    if (!session) return tl::unexpected(session.error());
    int version = 1;
    if (const Expected<void> shown = awaitPicture(**session, window, version); !shown) {
        return tl::unexpected(shown.error());
    }
    Saves saves;
    saves.programs = (*session)->stage()->programs.size();
    for (int i = 0; i < options.saves; ++i) {
        const Clock::time_point begin = Clock::now();
        save("// " + std::to_string(i) + "\n");
        if (const Expected<void> shown = awaitPicture(**session, window, ++version); !shown) {
            return tl::unexpected(shown.error());
        }
        const live::Times& times = (*session)->times();
        saves.total.push_back(milliseconds(Clock::now() - begin));
        saves.notice.push_back(times.notice);
        saves.compile.push_back(times.compile);
        saves.link.push_back(times.link);
        saves.load.push_back(times.load);
        saves.draw.push_back(times.draw);
    }
    // At the end of the file, where the compiler has read all of it.
    for (int i = 0; i < std::min(options.saves, kErrors); ++i) {
        const Clock::time_point begin = Clock::now();
        save("float3 wrong() { return float3(nothing" + std::to_string(i) + ", 1); }\n");
        const Expected<void> told = await(**session, "error", [&] { return (*session)->problem() != nullptr; });
        if (!told) return tl::unexpected(told.error());
        saves.error.push_back(milliseconds(Clock::now() - begin));
        save("// right " + std::to_string(i) + "\n");
        version += 2;
        const Expected<void> right =
            await(**session, "picture", [&] { return (*session)->picture().version >= version; });
        if (!right) return tl::unexpected(right.error());
    }
    return saves;
}

}  // namespace

Expected<void> benchLive(const LiveBenchOptions& options)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    const Expected<const live::Toolchain*> toolchain = live::findToolchain(options.compiler);
    if (!toolchain) return tl::unexpected(toolchain.error());
    std::vector<live::StageSource> sources = live::stageSources();
    if (!options.stages.empty()) sources.clear();
    for (const std::string& name : options.stages) {
        const Expected<live::StageSource> source = live::findSource(name);
        if (!source) return tl::unexpected(source.error());
        sources.push_back(*source);
    }
    const Expected<std::unique_ptr<live::Maker>> maker = live::Maker::start();
    if (!maker) return tl::unexpected(maker.error());
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) {
        ::setenv("SDL_VIDEODRIVER", "dummy", 0);
    }
    Window window;
    if (const Expected<void> opened = window.open(size->width, size->height); !opened) return opened;
    const live::Look look{.width = size->width,
                          .height = size->height,
                          .camera = {},
                          .settings = {},
                          .files = {},
                          .threads = options.threads};
    std::printf("Milliseconds from a save to the picture, %dx%d, %d saves each, %s, window: %s\n", size->width,
                size->height, options.saves, (*toolchain)->name.c_str(), SDL_GetCurrentVideoDriver());
    std::printf("%-36s %8s %8s %8s | medians: %6s %8s %6s %6s %6s | %8s\n", "stage", "programs", "median", "worst",
                "notice", "compile", "link", "load", "draw", "an error");
    Slowest ofOne, ofAll, ofErrors;
    for (const live::StageSource& source : sources) {
        const Expected<Saves> saves = measure(source, options, look, **maker, window);
        if (!saves) return tl::unexpected(saves.error());
        const double total = median(saves->total), error = median(saves->error);
        std::printf("%-36s %8zu %8.0f %8.0f | %15.0f %8.0f %6.0f %6.0f %6.1f | %8.0f\n",
                    (source.id + " " + source.stem).c_str(), saves->programs, total,
                    *std::max_element(saves->total.begin(), saves->total.end()), median(saves->notice),
                    median(saves->compile), median(saves->link), median(saves->load), median(saves->draw), error);
        std::fflush(stdout);
        if (saves->programs == 1) ofOne.consider(total, source.id);
        ofAll.consider(total, source.id);
        ofErrors.consider(error, source.id);
    }
    std::printf("The largest median: %.0f (%s), of stages with one pair of programs %.0f (%s); of errors %.0f (%s)\n",
                ofAll.median, ofAll.stage.c_str(), ofOne.median, ofOne.stage.c_str(), ofErrors.median,
                ofErrors.stage.c_str());
    return {};
}

}  // namespace relief::samples

// `relief bench --peer mesa`: the benchmark scenes drawn by Relief and by Mesa's llvmpipe in turn, and how much faster
// Relief is.
//
// Times and pictures come from two processes. Mesa saves time when it samples textures: weights of 8 bits, one level of
// detail for a quad, and a rough logarithm in it. It is timed like that, as users get it, but the pictures are compared
// without, so that a difference means that the two drew something else.
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "agreement.h"
#include "commands.h"
#include "cost.h"
#include "twins.h"

namespace relief::samples {

namespace {

using benchmarks::Agreement;
using benchmarks::BenchScene;
using benchmarks::LevelOfDetail;
using benchmarks::Mesa;
using benchmarks::MesaDrawing;
using benchmarks::SceneData;
using benchmarks::Twin;

constexpr int kMostThreads = 16;   // llvmpipe starts no more
constexpr int kFramesPerTurn = 3;  // of which the fastest counts

// Alpha 0, and every program's alpha is 1: so a pixel's alpha says whether anything was drawn there.
constexpr glm::vec4 kBackground{0.1f, 0.1f, 0.1f, 0.0f};

struct Setting
{
    Size size;
    int threads, pairs;
    std::vector<Twin> twins;
};

// One scene, ready to be drawn by both.
struct Pair
{
    Framebuffer target;
    Frame frame;
    std::unique_ptr<SceneData> data;
    Mesa& mesa;
    MesaDrawing drawing;

    Pair(Framebuffer created, const Setting& setting, const BenchScene& scene, Mesa& peer)
        : target(std::move(created)), frame(target, {.threads = setting.threads}), mesa(peer)
    {
        data = scene.record(frame, setting.size.width, setting.size.height);
        frame.clear(kBackground);
    }

    void runRelief() { frame.run(); }
    void runMesa()
    {
        mesa.clear(kBackground);
        drawing();
        mesa.finish();
    }
};

Expected<std::unique_ptr<Pair>> prepare(const Setting& setting, const Twin& twin, Mesa& mesa)
{
    const auto& scenes = benchmarks::benchScenes();
    const auto scene = std::find_if(scenes.begin(), scenes.end(), [&](const auto& s) { return s.name == twin.scene; });
    Expected<Framebuffer> target = Framebuffer::create(setting.size.width, setting.size.height, ColorFormat::rgba8);
    if (!target) return tl::unexpected(target.error());
    auto pair = std::make_unique<Pair>(std::move(*target), setting, *scene, mesa);
    if (!pair->data->problem.empty()) return fail(pair->data->problem);
    Expected<MesaDrawing> drawing = twin.prepare(mesa, *pair->data);
    if (!drawing) return tl::unexpected(drawing.error());
    pair->drawing = std::move(*drawing);
    pair->runRelief();
    pair->runMesa();
    return pair;
}

// --- times ---

template <class Function>
double secondsOfTurn(const Function& drawFrame)
{
    double best = 1e9;
    for (int i = 0; i < kFramesPerTurn; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        drawFrame();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return best;
}

struct Times
{
    std::vector<double> relief, mesa, ratios;  // one for each pair
};

Times measure(Pair& pair, int pairs)
{
    Times times;
    for (int i = 0; i < pairs; ++i) {
        times.relief.push_back(secondsOfTurn([&] { pair.runRelief(); }));
        times.mesa.push_back(secondsOfTurn([&] { pair.runMesa(); }));
        times.ratios.push_back(times.mesa.back() / times.relief.back());
    }
    return times;
}

// --- pictures ---

// The columns of the table.
std::string text(const Agreement& agreement)
{
    char columns[128];
    std::snprintf(
        columns, sizeof columns, "%16zu %15zu %13.4f%% %8d", agreement.coverageDiffers, agreement.awayFromEdges,
        100.0 * static_cast<double>(agreement.close) / static_cast<double>(agreement.pixels), agreement.largest);
    return columns;
}

// One line per scene.
Expected<std::string> comparePictures(const Setting& setting)
{
    Expected<Mesa> mesa = Mesa::create(setting.size.width, setting.size.height, LevelOfDetail::exact);
    if (!mesa) return tl::unexpected(mesa.error());
    std::string lines;
    for (const Twin& twin : setting.twins) {
        const auto pair = prepare(setting, twin, *mesa);
        if (!pair) return tl::unexpected(pair.error());
        const auto theirs = mesa->pixels();
        if (!theirs) return tl::unexpected(theirs.error());
        lines += text(benchmarks::agreement(*(*pair)->data, setting.size.width, setting.size.height,
                                            (*pair)->target.color8(), *theirs)) +
                 "\n";
    }
    return lines;
}

// --- two processes ---

void writeAll(int file, const std::string& text)
{
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t written = write(file, text.data() + done, text.size() - done);
        if (written <= 0) return;
        done += static_cast<std::size_t>(written);
    }
}

// What `work` returns in a process of its own. To be called while this one has a single thread.
template <class Work>
Expected<std::string> inChild(const Work& work)
{
    int ends[2];
    if (pipe(ends) != 0) return fail("bench --peer: no pipe to be had");
    const pid_t child = fork();
    if (child < 0) return fail("bench --peer: no second process to be had");
    if (child == 0) {
        close(ends[0]);
        const Expected<std::string> result = work();
        writeAll(ends[1], result ? "+" + *result : "-" + result.error().message);
        _exit(0);
    }
    close(ends[1]);
    std::string text;
    char part[4096];
    for (ssize_t length; (length = read(ends[0], part, sizeof part)) > 0;) {
        text.append(part, static_cast<std::size_t>(length));
    }
    close(ends[0]);
    waitpid(child, nullptr, 0);
    if (text.empty()) return fail("bench --peer: the process that compares the pictures ended early");
    if (text[0] == '-') return fail(text.substr(1));
    return text.substr(1);
}

Expected<Setting> parse(const PeerOptions& options)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    Setting setting{*size, options.threads, options.pairs, {}};
    if (setting.threads > kMostThreads) {
        return fail("--threads: llvmpipe has " + std::to_string(kMostThreads) + " at most, and both get the same");
    }
    if (setting.threads == 0) setting.threads = std::min(Workers().count(), kMostThreads);
    std::string known;
    for (const Twin& twin : benchmarks::twins()) known += " " + twin.scene;
    for (const std::string& name : options.scenes) {
        const auto& all = benchmarks::twins();
        const auto twin = std::find_if(all.begin(), all.end(), [&](const Twin& t) { return t.scene == name; });
        if (twin == all.end()) return fail("--scene: no scene is called " + name + "; there are:" + known);
        setting.twins.push_back(*twin);
    }
    if (setting.twins.empty()) setting.twins = benchmarks::twins();
    return setting;
}

}  // namespace

Expected<void> benchPeer(const PeerOptions& options)
{
    const Expected<Setting> setting = parse(options);
    if (!setting) return tl::unexpected(setting.error());

    // Mesa reads these when its context is made.
    setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("LP_NUM_THREADS", std::to_string(setting->threads).c_str(), 1);
    setenv("EGL_LOG_LEVEL", "fatal", 1);
    unsetenv("GALLIVM_PERF");
    const Expected<std::string> compared = inChild([&] {
        setenv("GALLIVM_PERF", "no_aos_sampling,no_quad_lod", 1);
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // what it holds was compiled without that
        return comparePictures(*setting);
    });
    if (!compared) return tl::unexpected(compared.error());

    Expected<Mesa> mesa = Mesa::create(setting->size.width, setting->size.height, LevelOfDetail::mesas);
    if (!mesa) return tl::unexpected(mesa.error());
    std::printf("%dx%d, threads: %d, lanes: %d, pairs: %d; ms of the fastest of %d frames, medians of the pairs\n",
                setting->size.width, setting->size.height, setting->threads, kLanes, setting->pairs, kFramesPerTurn);
    std::printf("%-18s %9s %9s  %-27s %16s %15s %14s %8s\n", "scene", "Relief", "Mesa", "Mesa / Relief (quartiles)",
                "coverage differs", "away from edges", "within 1/255", "largest");
    double logarithms = 0.0;
    std::size_t line = 0;
    for (const Twin& twin : setting->twins) {
        const auto pair = prepare(*setting, twin, *mesa);
        if (!pair) return tl::unexpected(pair.error());
        const Times times = measure(**pair, setting->pairs);
        const Quartiles ratio = quartiles(times.ratios);
        char ratios[64];
        std::snprintf(ratios, sizeof ratios, "%.2f (%.2f ... %.2f)", ratio.median, ratio.lower, ratio.upper);
        const std::size_t end = compared->find('\n', line);
        std::printf("%-18s %9.3f %9.3f  %-27s %s\n", twin.scene.c_str(), quartiles(times.relief).median * 1e3,
                    quartiles(times.mesa).median * 1e3, ratios, compared->substr(line, end - line).c_str());
        std::fflush(stdout);
        line = end + 1;
        logarithms += std::log(ratio.median);
    }
    std::printf("geometric mean of the ratios: %.2f; Mesa: %s\n",
                std::exp(logarithms / static_cast<double>(setting->twins.size())), mesa->description().c_str());
    return {};
}

}  // namespace relief::samples

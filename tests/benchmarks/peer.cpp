// `relief bench --peer mesa`: the benchmark scenes drawn by Relief and by Mesa's llvmpipe in turn, and how much faster
// Relief is.
//
// Times and pictures come from two processes. Mesa saves time when it samples textures: weights of 8 bits, one level of
// detail for a quad, and a rough logarithm in it. It is timed like that, as users get it, but the pictures are compared
// without, so that a difference means that the two drew something else.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "agreement.h"
#include "child_process.h"
#include "command_line.h"
#include "cost.h"
#include "feature_scenes.h"
#include "first_frame.h"
#include "relief/pipeline/workers.h"
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

// A line of the table: a scene, or the first frame of one.
struct Row
{
    std::string name;
    Twin twin;
    Size size;
    bool firstFrame;
};

struct Setting
{
    Size size;
    int threads, pairs;
    std::vector<Row> rows;
};

std::vector<Row> allRows(Size size)
{
    std::vector<Row> rows;
    for (const Twin& twin : benchmarks::twins()) rows.push_back({twin.scene, twin, size, false});
    const auto first =
        std::find_if(rows.begin(), rows.end(), [](const Row& row) { return row.name == benchmarks::kFirstFrameScene; });
    const Row firstFrame = {
        "first_frame", first->twin, {benchmarks::kFirstFrameSide, benchmarks::kFirstFrameSide}, true};
    rows.push_back(firstFrame);
    return rows;
}

// One scene, ready to be drawn by both.
struct Pair
{
    Framebuffer target;
    Frame frame;
    std::unique_ptr<SceneData> data;
    Mesa& mesa;
    MesaDrawing drawing = [] {};

    Pair(Framebuffer created, int threads, const BenchScene& scene, Mesa& peer)
        : target(std::move(created)), frame(target, {.threads = threads}), mesa(peer)
    {
        data = scene.record(frame, target.width(), target.height());
        frame.clear(kBackground);
    }

    void runRelief()
    {
        data->runPasses();
        frame.run();
    }
    void runMesa()
    {
        if (drawing.passes) drawing.passes();
        mesa.clear(kBackground);
        drawing.picture();
        mesa.finish();
    }
};

const BenchScene& sceneOf(const Twin& twin)
{
    for (const auto* scenes : {&benchmarks::benchScenes(), &benchmarks::featureScenes()}) {
        for (const BenchScene& scene : *scenes) {
            if (scene.name == twin.scene) return scene;
        }
    }
    std::abort();  // a twin of no scene
}

Expected<std::unique_ptr<Pair>> prepare(const Row& row, int threads, Mesa& mesa)
{
    const BenchScene& scene = sceneOf(row.twin);
    Expected<Framebuffer> target = benchmarks::targetFor(scene, row.size.width, row.size.height);
    if (!target) return tl::unexpected(target.error());
    const Expected<void> multisampled = mesa.setSamples(scene.samples);
    if (!multisampled) return tl::unexpected(multisampled.error());
    auto pair = std::make_unique<Pair>(std::move(*target), threads, scene, mesa);
    if (!pair->data->problem.empty()) return fail(pair->data->problem);
    Expected<MesaDrawing> drawing = row.twin.prepare(mesa, *pair->data);
    if (!drawing) return tl::unexpected(drawing.error());
    pair->drawing = std::move(*drawing);
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
    std::vector<double> relief, mesa;  // seconds, one for each pair
};

Times measure(Pair& pair, int pairs)
{
    Times times;
    pair.runRelief();
    pair.runMesa();
    for (int i = 0; i < pairs; ++i) {
        times.relief.push_back(secondsOfTurn([&] { pair.runRelief(); }));
        times.mesa.push_back(secondsOfTurn([&] { pair.runMesa(); }));
    }
    return times;
}

Quartiles ratioOf(const Times& times)
{
    std::vector<double> ratios;
    for (std::size_t i = 0; i < times.relief.size(); ++i) ratios.push_back(times.mesa[i] / times.relief[i]);
    return quartiles(ratios);
}

// --- pictures ---

// The last columns of the table.
std::string text(const Agreement& agreement)
{
    char columns[128];
    std::snprintf(columns, sizeof columns, "%8zu %9zu %12.4f%% %7d", agreement.coverageDiffers, agreement.awayFromEdges,
                  100.0 * static_cast<double>(agreement.close) / static_cast<double>(agreement.pixels),
                  agreement.largest);
    return columns;
}

// One line per row.
Expected<std::string> comparePictures(const Setting& setting)
{
    std::string lines;
    for (const Row& row : setting.rows) {
        Expected<Mesa> mesa = Mesa::create(row.size.width, row.size.height, LevelOfDetail::exact);
        if (!mesa) return tl::unexpected(mesa.error());
        const auto pair = prepare(row, setting.threads, *mesa);
        if (!pair) return tl::unexpected(pair.error());
        (*pair)->runRelief();
        (*pair)->runMesa();
        if (!(*pair)->data->problem.empty()) return fail((*pair)->data->problem);
        const auto theirs = mesa->pixels();
        if (!theirs) return tl::unexpected(theirs.error());
        lines += text(benchmarks::agreement(*(*pair)->data, row.size.width, row.size.height,
                                            (*pair)->target.samples().count, (*pair)->target.color8(), *theirs)) +
                 "\n";
    }
    return lines;
}

// --- one frame ---

// What a first frame takes of Relief: Mesa is not even loaded.
Expected<void> drawRelief(const Row& row, int threads)
{
    const BenchScene& scene = sceneOf(row.twin);
    Expected<Framebuffer> target = benchmarks::targetFor(scene, row.size.width, row.size.height);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {.threads = threads});
    const auto data = scene.record(frame, row.size.width, row.size.height);
    if (!data->problem.empty()) return fail(data->problem);
    frame.clear(kBackground);
    data->runPasses();
    frame.run();
    return {};
}

// And of Mesa: the scene is recorded for Relief too, whose one thread then draws nothing.
Expected<void> drawMesa(const Row& row)
{
    Expected<Mesa> mesa = Mesa::create(row.size.width, row.size.height, LevelOfDetail::mesas);
    if (!mesa) return tl::unexpected(mesa.error());
    const auto pair = prepare(row, 1, *mesa);
    if (!pair) return tl::unexpected(pair.error());
    (*pair)->runMesa();
    return {};
}

// --- the command ---

Expected<Setting> parse(const PeerOptions& options)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    Setting setting{*size, options.threads, options.pairs, {}};
    if (setting.threads > kMostThreads) {
        return fail("--threads: llvmpipe has " + std::to_string(kMostThreads) + " at most, and both get the same");
    }
    if (setting.threads == 0) setting.threads = std::min(Workers().count(), kMostThreads);
    const std::vector<Row> all = allRows(*size);
    std::string known;
    for (const Row& row : all) known += " " + row.name;
    for (const std::string& name : options.scenes) {
        const auto row = std::find_if(all.begin(), all.end(), [&](const Row& r) { return r.name == name; });
        if (row == all.end()) return fail("--scene: no scene is called " + name + "; there are:" + known);
        setting.rows.push_back(*row);
    }
    if (setting.rows.empty()) setting.rows = all;
    return setting;
}

Expected<void> drawAlone(const Setting& setting, bool mesa)
{
    for (const Row& row : setting.rows) {
        const Expected<void> drawn = mesa ? drawMesa(row) : drawRelief(row, setting.threads);
        if (!drawn) return drawn;
    }
    std::printf("drawn\n");
    std::fflush(stdout);
    return {};
}

// A first frame's note says what Mesa takes with its cache on disk.
Expected<Times> timesOf(const Row& row, const Setting& setting, Mesa& mesa, std::string& notes)
{
    if (row.firstFrame) {
        const auto frames = benchmarks::measureFirstFrames(setting.pairs, setting.threads);
        if (!frames) return tl::unexpected(frames.error());
        const Times cached = {frames->relief, frames->mesaCached};
        char note[256];
        std::snprintf(note, sizeof note,
                      "first_frame: %s at %dx%d, from a process's start to the picture, once a turn, Mesa's cache of "
                      "programs off; with it %.3f ms, %.2f times Relief's\n",
                      row.twin.scene.c_str(), row.size.width, row.size.height, quartiles(cached.mesa).median * 1e3,
                      ratioOf(cached).median);
        notes += note;
        return Times{frames->relief, frames->mesa};
    }
    const auto pair = prepare(row, setting.threads, mesa);
    if (!pair) return tl::unexpected(pair.error());
    const Times times = measure(**pair, setting.pairs);
    if (!(*pair)->data->problem.empty()) return fail((*pair)->data->problem);
    return times;
}

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
    if (!options.alone.empty()) return drawAlone(*setting, options.alone == "mesa");
    const Expected<benchmarks::ChildResult> compared = benchmarks::inChild("bench --peer", [&] {
        setenv("GALLIVM_PERF", "no_aos_sampling,no_quad_lod", 1);
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // what it holds was compiled without that
        return comparePictures(*setting);
    });
    if (!compared) return tl::unexpected(compared.error());

    Expected<Mesa> mesa = Mesa::create(setting->size.width, setting->size.height, LevelOfDetail::mesas);
    if (!mesa) return tl::unexpected(mesa.error());
    std::printf("%dx%d, threads: %d, lanes: %d, pairs: %d; ms of the fastest of %d frames, medians of the pairs\n",
                setting->size.width, setting->size.height, setting->threads, kLanes, setting->pairs, kFramesPerTurn);
    std::printf("%-18s %8s %8s  %-25s %8s %9s %13s %7s\n", "scene", "Relief", "Mesa", "Mesa / Relief (quartiles)",
                "coverage", "off edges", "within 1/255", "largest");
    std::string notes;
    double logarithms = 0.0;
    std::size_t line = 0;
    for (const Row& row : setting->rows) {
        const Expected<Times> times = timesOf(row, *setting, *mesa, notes);
        if (!times) return tl::unexpected(times.error());
        const Quartiles ratio = ratioOf(*times);
        char ratios[64];
        std::snprintf(ratios, sizeof ratios, "%.2f (%.2f ... %.2f)", ratio.median, ratio.lower, ratio.upper);
        const std::size_t end = compared->text.find('\n', line);
        std::printf("%-18s %8.3f %8.3f  %-25s %s\n", row.name.c_str(), quartiles(times->relief).median * 1e3,
                    quartiles(times->mesa).median * 1e3, ratios, compared->text.substr(line, end - line).c_str());
        std::fflush(stdout);
        line = end + 1;
        logarithms += std::log(ratio.median);
    }
    std::printf(
        "coverage: pixels that only one of the two drew to; off edges: those that are more than 1/256 of a "
        "pixel away from every edge\n");
    std::printf("%sgeometric mean of the ratios: %.2f; Mesa: %s\n", notes.c_str(),
                std::exp(logarithms / static_cast<double>(setting->rows.size())), mesa->description().c_str());
    return {};
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv, {.benchPeer = relief::samples::benchPeer});
}

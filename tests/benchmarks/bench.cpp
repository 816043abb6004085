// `relief bench`: frames per scene and thread count, measured by Google Benchmark, shown as one table:
//
//     ms/frame         the median of the repetitions
//     ns/fragment      of the pixels that the fragment program ran for
//     Mtriangles/s     submitted
//     program alone    the share of the frame's time that the fragment programs take when nothing else is done:
//                      the same number of blocks, without raster, depth, blending and memory
#include <algorithm>
#include <chrono>
#include <cstdio>

#include <benchmark/benchmark.h>

#include "command_line.h"
#include "feature_scenes.h"
#include "relief/pipeline/instruments.h"
#include "relief/pipeline/workers.h"
#include "scenes.h"

namespace relief::samples {

namespace {

using benchmarks::BenchScene;
using benchmarks::SceneData;

constexpr int kWidth = 1920, kHeight = 1080;

// Seconds that the recorded fragment programs take alone for as many blocks as the frame shaded, on one thread.
double programAlone(const Frame& frame, const Statistics& statistics)
{
    if (statistics.blocksShaded == 0) return 0.0;
    double best = 1e9;
    for (int i = 0; i < 3; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(shadeAlone(frame, statistics.blocksShaded));
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return best;
}

void measure(benchmark::State& state, const BenchScene& scene, int threads)
{
    Expected<Framebuffer> target = benchmarks::targetFor(scene, kWidth, kHeight);
    Frame frame(*target, {.threads = threads});
    frame.clear({0.1f, 0.1f, 0.1f, 1.0f});
    const std::unique_ptr<SceneData> data = scene.record(frame, kWidth, kHeight);
    data->runPasses();
    Statistics statistics = frame.run();
    double best = 1e9;
    for (auto _ : state) {
        const auto begin = std::chrono::steady_clock::now();
        data->runPasses();
        statistics = frame.run();
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        state.SetIterationTime(seconds);
        best = std::min(best, seconds);
    }
    state.counters["pixels"] = static_cast<double>(statistics.pixelsShaded);
    state.counters["triangles"] = static_cast<double>(statistics.trianglesSubmitted);
    state.counters["alone"] = programAlone(frame, statistics) / threads;
    state.counters["best"] = best;
}

// Prints one row per benchmark, from the median of its repetitions.
class Table final : public benchmark::BenchmarkReporter
{
public:
    bool ReportContext(const Context&) override
    {
        std::printf("%dx%d, %d lanes\n%-20s %7s %9s %9s %12s %13s %14s\n", kWidth, kHeight, kLanes, "scene", "threads",
                    "ms/frame", "best", "ns/fragment", "Mtriangles/s", "program alone");
        return true;
    }

    void ReportRuns(const std::vector<Run>& runs) override
    {
        std::vector<double> seconds;
        double best = 1e9;
        const Run* last = nullptr;
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            seconds.push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
            best = std::min(best, run.counters.at("best").value);
            last = &run;
        }
        if (last == nullptr) return;
        std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                         seconds.end());
        const double median = seconds[seconds.size() / 2];
        const double pixels = last->counters.at("pixels").value, triangles = last->counters.at("triangles").value;
        const std::string name = last->run_name.function_name;
        const std::size_t slash = name.rfind('/');
        std::printf("%-20s %7s %9.3f %9.3f", name.substr(0, slash).c_str(), name.substr(slash + 1).c_str(),
                    median * 1e3, best * 1e3);
        if (pixels > 0) {
            std::printf(" %12.3f %13.2f %14.2f", median * 1e9 / pixels, triangles / median * 1e-6,
                        last->counters.at("alone").value / median);
        }
        std::printf("\n");
        std::fflush(stdout);
    }
};

Expected<void> bench(const std::vector<std::string>& arguments)
{
    const int all = Workers().count();
    std::vector<BenchScene> scenes = benchmarks::benchScenes();
    scenes.insert(scenes.end(), benchmarks::featureScenes().begin(), benchmarks::featureScenes().end());
    for (const BenchScene& scene : scenes) {
        for (int threads = 1; threads <= all; threads = threads == all ? all + 1 : all) {
            benchmark::RegisterBenchmark((scene.name + "/" + std::to_string(threads)).c_str(),
                                         [&scene, threads](benchmark::State& state) { measure(state, scene, threads); })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond)
                ->MinTime(0.2)
                ->Repetitions(3);
        }
    }
    std::vector<std::string> words = {"relief bench"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    int argc = static_cast<int>(argv.size());
    benchmark::Initialize(&argc, argv.data());
    if (argc > 1) {
        return fail("bench: unknown option " + std::string(argv[1]) +
                    "; `relief bench --benchmark_filter=stage` measures the scenes with that in their name");
    }
    Table table;
    benchmark::RunSpecifiedBenchmarks(&table);
    return {};
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv, {.bench = relief::samples::bench});
}

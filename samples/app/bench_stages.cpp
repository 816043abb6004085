// bench --stage: what drawing a stage costs, and whether another one costs more.
#include <cstdio>
#include <optional>

#include "command_line.h"
#include "cost.h"
#include "relief/pipeline/workers.h"

namespace relief::samples {

namespace {

// Draws and measures nothing. The last frame is what an instruction counter is to see, passes before the picture
// included.
Expected<void> drawFrames(const PreparedStage& stage, Size size, const BenchOptions& options)
{
    Expected<Framebuffer> target = Framebuffer::create(size.width, size.height, Format::rgba8Srgb);
    if (!target) return tl::unexpected(target.error());
    std::optional<Frame> frame;
    const auto record = [&] {
        frame.emplace(*target, FrameOptions{.threads = options.render.threads});
        stage.record(*frame, size.width, size.height);
    };
    record();
    const bool hasPasses = !stage.log->passes.empty();  // before the picture: they are drawn while it is recorded
    Statistics statistics;
    const auto draw = [&] {
        if (hasPasses) record();
        statistics = frame->run();
    };
    for (int i = 1; i < options.frames; ++i) draw();
    runCounted(draw);
    std::printf("%llu\n", static_cast<unsigned long long>(statistics.pixelsShaded));
    return {};
}

std::string withQuartiles(const Quartiles& q)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.3f (%.3f ... %.3f)", q.median, q.lower, q.upper);
    return buffer;
}

Expected<void> benchStages(const BenchOptions& options)
{
    const Expected<Size> size = parseSize(options.render.size);
    if (!size) return tl::unexpected(size.error());
    std::vector<PreparedStage> stages;
    std::vector<RenderOptions> each;
    for (const std::string& name : options.stages) {
        each.push_back(options.render);
        each.back().stage = name;
        Expected<PreparedStage> stage = prepare(each.back());
        if (!stage) return tl::unexpected(stage.error());
        stages.push_back(std::move(*stage));
    }
    if (options.frames > 0) {
        for (const PreparedStage& stage : stages) {
            const Expected<void> drawn = drawFrames(stage, *size, options);
            if (!drawn) return drawn;
        }
        return {};
    }

    std::vector<std::string> instructions(stages.size());
    for (std::size_t i = 0; i < stages.size() && options.instructions; ++i) {
        if (options.countedProgram.empty()) {
            return fail("bench --instructions: no program to count in; run it as ./relief bench, or add " +
                        std::string("--counted-program FILE with the same program built by `cmake --preset counted`"));
        }
        const Expected<double> counted = instructionsPerFragment(options.countedProgram, each[i]);
        if (!counted) return tl::unexpected(counted.error());
        instructions[i] = text("%.1f", *counted);
    }
    const Expected<std::vector<Cost>> costs = measure(stages, *size, options.render.threads, options.rounds);
    if (!costs) return tl::unexpected(costs.error());

    std::printf("%dx%d, threads: %d, lanes: %d, rounds: %d; fetches count helper lanes\n", size->width, size->height,
                Workers(options.render.threads).count(), kLanes, options.rounds);
    std::printf("%-34s %9s %16s %9s %11s  %s%s\n", "stage", "pixels", "fetches/fragment", "ms/frame", "ns/fragment",
                options.instructions ? "instructions/fragment  " : "",
                ("ratio to " + stages[0].stage->id + " (quartiles)").c_str());
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const Cost& cost = (*costs)[i];
        std::printf("%-34s %9llu %16.2f %9.3f %11.2f  ", stages[i].stage->name().c_str(),
                    static_cast<unsigned long long>(cost.statistics.pixelsShaded), cost.fetchesPerFragment(),
                    quartiles(cost.seconds).median * 1e3, cost.nanosecondsPerFragment());
        if (options.instructions) std::printf("%21s  ", instructions[i].c_str());
        std::printf("%s\n", withQuartiles(ratio(cost, (*costs)[0])).c_str());
    }
    return {};
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv, {.benchStages = relief::samples::benchStages});
}

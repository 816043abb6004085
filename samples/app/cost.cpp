#include "cost.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace relief::samples {

namespace {

constexpr int kFramesPerTurn = 3;

double secondsOfTurn(Frame& frame)
{
    double best = 1e9;
    for (int i = 0; i < kFramesPerTurn; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        frame.run();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return best;
}

}  // namespace

Quartiles quartiles(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const auto at = [&values](double fraction) {
        return values[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(values.size() - 1)))];
    };
    return {at(0.25), at(0.5), at(0.75)};
}

std::string text(const char* format, double number)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, number);
    return buffer;
}

double Cost::fetchesPerFragment() const
{
    const FetchCounters& f = statistics.fetches;
    return static_cast<double>(f.fetched()) / static_cast<double>(statistics.pixelsShaded);
}

double Cost::nanosecondsPerFragment() const
{
    return quartiles(seconds).median * 1e9 / static_cast<double>(statistics.pixelsShaded);
}

Quartiles ratio(const Cost& cost, const Cost& reference)
{
    std::vector<double> ratios;
    for (std::size_t i = 0; i < cost.seconds.size(); ++i) ratios.push_back(cost.seconds[i] / reference.seconds[i]);
    return quartiles(std::move(ratios));
}

Expected<std::vector<Cost>> measure(const std::vector<PreparedStage>& stages, Size size, int threads, int rounds,
                                    const std::function<void(int round)>& progress)
{
    Expected<Framebuffer> target = Framebuffer::create(size.width, size.height, Format::rgba8Srgb);
    if (!target) return tl::unexpected(target.error());
    // One frame for all, recorded anew for each turn: the stages share its memory, so where it lies favours none.
    Frame frame(*target, {.threads = threads});
    std::vector<Cost> costs(stages.size());
    for (std::size_t i = 0; i < stages.size(); ++i) {
        stages[i].record(frame, size.width, size.height);
        costs[i].statistics = frame.run();
        if (costs[i].statistics.pixelsShaded == 0) {
            return fail("bench: stage " + stages[i].stage->id + " shades no pixel at " + std::to_string(size.width) +
                        "x" + std::to_string(size.height) + "; choose a larger --size");
        }
    }
    for (int round = 0; round < rounds; ++round) {
        if (progress) progress(round);
        for (std::size_t i = 0; i < stages.size(); ++i) {
            stages[i].record(frame, size.width, size.height);
            costs[i].seconds.push_back(secondsOfTurn(frame));
        }
    }
    return costs;
}

}  // namespace relief::samples

#include "measure.h"

#include <algorithm>
#include <chrono>

#include "cost.h"

namespace relief::experiments {

namespace {

using Clock = std::chrono::steady_clock;

double secondsOf(const Work& work, int repeats)
{
    const auto begin = Clock::now();
    for (int i = 0; i < repeats; ++i) work.run();
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

// As many runs as take a millisecond: short enough that most turns are not interrupted, long enough for the clock.
int repeatsOf(const Work& work)
{
    constexpr double kTurnSeconds = 1e-3;
    work.run();  // warms up
    const double once = std::max(secondsOf(work, 1), 1e-8);
    return std::max(1, static_cast<int>(kTurnSeconds / once));
}

struct Timed
{
    const Work* work;
    int repeats;
    std::vector<double> nanoseconds;  // per item, one for each round

    void takeTurn() { nanoseconds.push_back(secondsOf(*work, repeats) * 1e9 / (repeats * work->items)); }
    double fastest() const { return *std::min_element(nanoseconds.begin(), nanoseconds.end()); }
};

double medianOf(std::vector<double> values)
{
    return samples::quartiles(std::move(values)).median;
}

// At least as exact and as fast, and better in one by more than chance: by 1 % of the error or 3 % of the time.
bool beats(const Row& a, const Row& b)
{
    const double errorA = a.outcome.error.rms, errorB = b.outcome.error.rms;
    return errorA <= errorB && a.fastest <= b.fastest && (errorA < 0.99 * errorB || a.fastest < 0.97 * b.fastest);
}

bool areRivals(const Row& a, const Row& b, Rivals rivals)
{
    return rivals == Rivals::all || (rivals == Rivals::ofOneName ? a.name == b.name : a.parameter == b.parameter);
}

}  // namespace

void markFront(Rows& rows, Rivals rivals)
{
    for (Row& row : rows.all) {
        row.isOnFront = std::none_of(rows.all.begin(), rows.all.end(), [&](const Row& other) {
            return areRivals(other, row, rivals) && beats(other, row);
        });
    }
}

Rows measure(const Experiment& experiment, int rounds, const Progress& progress)
{
    Rows rows;
    std::vector<Timed> warm, streaming;
    for (const Variant& v : experiment.variants) {
        progress(experiment.id + ": error of " + v.name + " " + v.parameter);
        rows.all.push_back({.name = v.name, .parameter = v.parameter, .outcome = v.outcome()});
        warm.push_back({&v.work, repeatsOf(v.work), {}});
        if (v.streaming.run) streaming.push_back({&v.streaming, repeatsOf(v.streaming), {}});
    }
    for (int round = 0; round < rounds; ++round) {
        progress(experiment.id + ": round " + std::to_string(round + 1) + " of " + std::to_string(rounds));
        for (Timed& t : warm) t.takeTurn();
        for (Timed& t : streaming) t.takeTurn();
    }
    std::size_t streamed = 0;
    for (std::size_t i = 0; i < rows.all.size(); ++i) {
        Row& row = rows.all[i];
        row.fastest = warm[i].fastest();
        row.median = medianOf(warm[i].nanoseconds);
        std::vector<double> deviations;
        for (const double t : warm[i].nanoseconds) deviations.push_back(std::abs(t - row.median));
        row.deviation = medianOf(std::move(deviations));
        if (experiment.variants[i].streaming.run) row.streaming = streaming[streamed++].fastest();
    }
    markFront(rows, experiment.rivals);
    return rows;
}

void runForCounting(const Experiment& experiment)
{
    for (const Variant& v : experiment.variants) {
        if (!v.isCounted) continue;
        v.work.run();  // what the first run alone does is not counted
        samples::runCounted(v.work.run);
    }
}

}  // namespace relief::experiments

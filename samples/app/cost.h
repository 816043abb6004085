// What stages cost: texture fetches, nanoseconds and instructions per fragment. Behind `bench --stage` and `report`.
#pragma once

#include <functional>

#include "commands.h"

namespace relief::samples {

// Half of all values lie between `lower` and `upper`.
struct Quartiles
{
    double lower, median, upper;
};

// At least one value. The quartile at a fraction between two values is the nearest one's.
Quartiles quartiles(std::vector<double> values);

struct Cost
{
    Statistics statistics;        // of one frame
    std::vector<double> seconds;  // of a frame, one for each round

    // Texture samples; of a texture of one texel nothing is fetched. Helper lanes sample too, and count: a quad on an
    // edge shades four pixels for the one that it covers.
    double fetchesPerFragment() const;
    double nanosecondsPerFragment() const;  // by the median round
};

// How much dearer `cost` is than `reference`, round by round: both ran within the same fraction of a second, so what
// slows the whole machine down for a while cancels.
Quartiles ratio(const Cost& cost, const Cost& reference);

// Draws the stages in turn, round after round: A B C A B C ... A turn is three frames, of which the fastest counts; the
// first of them finds the caches full of another stage. `progress`, if any, is called before each round.
Expected<std::vector<Cost>> measure(const std::vector<PreparedStage>& stages, Size size, int threads, int rounds,
                                    const std::function<void(int round)>& progress = {});

// Instructions per fragment of a whole frame, all stages of the pipeline included: valgrind counts those of a run of
// `program bench --frames 3` and of one of `--frames 2`, and the difference is one frame's. The first frame, which
// builds mip levels, is in both. `program` is a relief whose instructions valgrind knows: not AVX-512. The same number
// every time. One thread, whatever the options say.
Expected<double> instructionsPerFragment(const std::string& program, const RenderOptions& options);

// A number as printf writes it.
std::string text(const char* format, double number);

// What a command prints to stdout and stderr, or nothing where it cannot be run or fails. And a word for such a
// command.
std::optional<std::string> outputOf(const std::string& command);
std::string quoted(const std::string& word);

}  // namespace relief::samples

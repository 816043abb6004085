// What stages cost: texture fetches, nanoseconds and instructions per fragment. Behind `bench --stage` and `report`.
#pragma once

#include <functional>

#include "prepare.h"

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

// --- instructions, counted by valgrind: the processor's own counters are out of reach in most virtual machines ---

// Runs `work`. Under valgrind its instructions are counted, and nothing else is.
void runCounted(const std::function<void()>& work);

// The instructions of each work that `program arguments` runs in that way, in order, and what it prints. `program` is a
// relief whose instructions valgrind knows (not AVX-512) and that was built with valgrind's headers at hand.
// `environment`, "NAME=value", may be empty. The same numbers every time.
struct Counts
{
    std::vector<double> instructions;
    std::string output;
};
Expected<Counts> countInstructions(const std::string& program, const std::string& arguments,
                                   const std::string& environment = "");

// Instructions per fragment of a whole frame, all stages of the pipeline included, with mip levels built and caches
// filled by a frame before it. On one thread, whatever the options say.
Expected<double> instructionsPerFragment(const std::string& program, const RenderOptions& options,
                                         const std::string& environment = "");

// A number as printf writes it.
std::string text(const char* format, double number);

}  // namespace relief::samples

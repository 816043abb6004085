// How long a fresh process takes from its start to its first picture.
#pragma once

#include <string>
#include <vector>

#include "relief/error.h"

namespace relief::benchmarks {

// Of one scene at 256 x 256, which both draw once.
inline constexpr const char* kFirstFrameScene = "stage_1.25";
inline constexpr int kFirstFrameSide = 256;

// Seconds, one for each pair of processes.
struct FirstFrames
{
    std::vector<double> relief, mesa;
    std::vector<double> mesaCached;  // with the compiled programs in Mesa's cache on disk
};

// Starts this very program in turn: `bench --peer mesa --alone relief`, and the same with mesa, which compiles its
// programs anew. Each writes a byte to stdout once its picture is finished.
Expected<FirstFrames> measureFirstFrames(int pairs, int threads);

}  // namespace relief::benchmarks

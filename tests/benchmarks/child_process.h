// Work in a process of its own: what it sets, allocates or loads is gone afterwards, and its memory can be measured.
#pragma once

#include <functional>
#include <string>

#include "relief/error.h"

namespace relief::benchmarks {

struct ChildResult
{
    std::string text;            // what the work returned
    double peakMebibytes = 0.0;  // the most memory that the process had resident at any time
};

// Does `work` in a fork of this process. To be called while this one has a single thread. `who` begins the error where
// that cannot be done, and where the process ends early.
Expected<ChildResult> inChild(const std::string& who, const std::function<Expected<std::string>()>& work);

}  // namespace relief::benchmarks

// relief trace: the life of one pixel of a stage, or of one vertex, or where a NaN comes from.
#pragma once

#include <string>

#include "prepare.h"
#include "relief/error.h"

namespace relief::samples {

Expected<void> traceStage(const TraceOptions& options);

}  // namespace relief::samples

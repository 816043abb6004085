// relief trace: the life of one pixel of a stage.
#pragma once

#include <string>

#include "error.h"
#include "options.h"

namespace relief::samples {

Expected<void> traceStage(const TraceOptions& options);

}  // namespace relief::samples

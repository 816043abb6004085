// What the obvious form of some computations draws, beside ours: the pictures of `report stability`.
#pragma once

#include <string>

#include "options.h"
#include "relief/error.h"

namespace relief::samples {

// Draws those that belong to the cases asked for, all if none is, into the folder stability/ of the report's folder.
// Returns the lines of markdown that show them; none if there is no picture.
Expected<std::string> writeStabilityPictures(const ReportOptions& options);

}  // namespace relief::samples

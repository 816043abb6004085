// The command `doctor`.
#pragma once

#include "options.h"
#include "relief/error.h"

namespace relief::samples {

// Prints the diagnosis, and writes the pictures that are asked for. 1: the map has a fault.
Expected<int> examineMap(const DoctorOptions& options);

}  // namespace relief::samples

// What --import says, in place of the settings that a stage imports its normal maps with.
#pragma once

#include <string>
#include <vector>

#include "relief/error.h"
#include "relief/texture/import.h"

namespace relief::samples {

// Each option is "name=value": storage=rgb, dxt5nm or dxt5; bumpiness=0 ... 16; filter=smooth or sobel;
// heights=automatic, yes or no; fade=on or off. An error says what could have been written.
Expected<ImportSettings> withOptions(ImportSettings settings, const std::vector<std::string>& options);

}  // namespace relief::samples

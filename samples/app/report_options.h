// The reports that there are, and which options each of them takes.
#pragma once

#include "options.h"
#include "relief/error.h"

namespace relief::samples {

struct ReportKind
{
    const char* name;
    const char* size;  // unless told otherwise, as the number of rounds
    int rounds;
    const char* takes;  // of the options that not every report takes
};

Expected<const ReportKind*> findReport(const std::string& name);

// With what the report uses where nothing was said. An option that it does not take is an error.
Expected<ReportOptions> completeReport(const ReportOptions& options);

}  // namespace relief::samples

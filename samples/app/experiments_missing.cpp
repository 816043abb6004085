// In place of tests/experiments/report_error.cpp in builds without experiments.
#include "report.h"

namespace relief::samples {

Expected<void> reportError(const ReportOptions&)
{
    return fail(
        "report error: this build has no experiments; configure it with -DRELIEF_EXPERIMENTS=ON and build again");
}

}  // namespace relief::samples

// In place of tests/benchmarks/report_performance.cpp in builds without benchmarks.
#include "report.h"

namespace relief::samples {

Expected<void> reportPerformance(const ReportOptions&)
{
    return fail(
        "report performance: this build has no benchmarks; configure it with -DRELIEF_BENCHMARKS=ON and build again");
}

}  // namespace relief::samples

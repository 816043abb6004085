// In place of tests/benchmarks where Google Benchmark was not found.
#include "commands.h"

namespace relief::samples {

Expected<void> bench(const std::vector<std::string>&)
{
    return fail(
        "bench: this build has no benchmarks, Google Benchmark was not found; install libbenchmark-dev and build "
        "again");
}

}  // namespace relief::samples

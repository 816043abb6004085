#include "relief/pipeline/statistics.h"

#include <cstring>

namespace relief {

Statistics& Statistics::operator+=(const Statistics& other)
{
    // Every member is a counter: the structs are arrays of them.
    static_assert(sizeof(Statistics) % sizeof(std::uint64_t) == 0);
    constexpr std::size_t counters = sizeof(Statistics) / sizeof(std::uint64_t);
    std::uint64_t mine[counters], theirs[counters];
    std::memcpy(mine, this, sizeof mine);
    std::memcpy(theirs, &other, sizeof theirs);
    for (std::size_t i = 0; i < counters; ++i) mine[i] += theirs[i];
    std::memcpy(this, mine, sizeof mine);
    return *this;
}

}  // namespace relief

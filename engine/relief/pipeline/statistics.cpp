#include "relief/pipeline/statistics.h"

#include <cstring>

namespace relief {

namespace {

// Every member is a counter: the structs are arrays of them.
template <class Operation>
void forEachCounter(Statistics& to, const Statistics& from, Operation operation)
{
    static_assert(sizeof(Statistics) % sizeof(std::uint64_t) == 0);
    constexpr std::size_t counters = sizeof(Statistics) / sizeof(std::uint64_t);
    std::uint64_t mine[counters], theirs[counters];
    std::memcpy(mine, &to, sizeof mine);
    std::memcpy(theirs, &from, sizeof theirs);
    for (std::size_t i = 0; i < counters; ++i) operation(mine[i], theirs[i]);
    std::memcpy(&to, mine, sizeof mine);
}

}  // namespace

Statistics& Statistics::operator+=(const Statistics& other)
{
    forEachCounter(*this, other, [](std::uint64_t& mine, std::uint64_t theirs) { mine += theirs; });
    return *this;
}

Statistics& Statistics::operator-=(const Statistics& other)
{
    forEachCounter(*this, other, [](std::uint64_t& mine, std::uint64_t theirs) { mine -= theirs; });
    return *this;
}

}  // namespace relief

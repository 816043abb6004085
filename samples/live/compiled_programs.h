// The list of programs that an object holds, as the program that loads it sees it.
#pragma once

#include <cstdint>

#include "relief/pipeline/program.h"

namespace relief::inline RELIEF_WIDTH::detail {

// A pair of programs. The list has them all before the first draw: static constructors make it.
struct CompiledPrograms
{
    std::uint64_t id;
    const Programs* programs;
    const CompiledPrograms* next;

    CompiledPrograms(std::uint64_t itsId, const Programs& its);
};

}  // namespace relief::inline RELIEF_WIDTH::detail

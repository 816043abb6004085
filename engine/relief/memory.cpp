#include "relief/memory.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <new>

namespace relief {

bool fitsInMemory(std::uint64_t bytes)
{
    constexpr std::uint64_t kLargest = std::uint64_t{1} << 39;  // more than the engine ever asks for
    if (bytes > std::min<std::uint64_t>(kLargest, std::numeric_limits<std::ptrdiff_t>::max())) return false;
    void* block = ::operator new(static_cast<std::size_t>(bytes), std::nothrow);
    asm volatile("" : "+m"(block));  // or compilers would leave out a block that nobody writes to
    const bool fits = block != nullptr;
    ::operator delete(block);
    return fits;
}

}  // namespace relief

// Whether there is memory for what a few numbers ask for, such as the size in a file's header: without exceptions a
// container cannot say that there is none, and ends the program. What takes memory in proportion to its input does not
// ask.
#pragma once

#include <cstdint>

namespace relief {

// Whether a block of so many bytes can be had now. Other threads may take it before the caller does.
bool fitsInMemory(std::uint64_t bytes);

}  // namespace relief

// Numbers in files, the lowest byte first, on any machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relief {

// `count` bytes from `at` on, at most 8. Bytes behind the end count as 0.
inline std::uint64_t littleEndian(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count)
{
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i) number |= std::uint64_t{bytes[at + i]} << 8 * i;
    return number;
}

}  // namespace relief

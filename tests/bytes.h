// Numbers as the bytes of a file.
#pragma once

#include <cstdint>
#include <string>

inline std::string bigEndian(std::uint32_t value)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
}

inline std::string little(std::uint32_t value, int count = 4)
{
    std::string bytes;
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
    return bytes;
}

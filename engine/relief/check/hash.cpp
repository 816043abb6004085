#include "relief/check/hash.h"

namespace relief {

std::uint64_t hashOf(const Framebuffer& target)
{
    std::uint64_t hash = 14695981039346656037ull;
    for (int i = 0; i < static_cast<int>(target.attachments().size()); ++i) {
        for (const std::uint32_t word : target.words(i)) hash = (hash ^ word) * 1099511628211ull;
    }
    return hash;
}

std::uint64_t hashOf(std::span<const std::uint8_t> bytes)
{
    std::uint64_t hash = 14695981039346656037ull;
    for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
    return hash;
}

std::string hexadecimal(std::uint64_t hash)
{
    std::string digits(16, '0');
    for (std::size_t i = 0; i < 16; ++i) digits[i] = "0123456789abcdef"[hash >> (60 - 4 * i) & 15u];
    return digits;
}

}  // namespace relief

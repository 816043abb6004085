#include "relief/check/hash.h"

#include <bit>

namespace relief {

std::uint64_t hashOf(const Framebuffer& target)
{
    std::uint64_t hash = 14695981039346656037ull;
    for (int i = 0; i < static_cast<int>(target.attachments().size()); ++i) {
        const auto [format, store] = target.attachments()[static_cast<std::size_t>(i)];
        if (store == Store::discard) continue;
        // Texels of rgba8 are bytes, R first.
        const bool turnsRound =
            std::endian::native != std::endian::little && store == Store::texture && format == Format::rgba8;
        const auto rows = target.shownRows(i);
        for (int y = 0; y < target.height(); ++y) {
            for (int x = 0; x < target.width() * wordsPerPixel(format); ++x) {
                const std::uint32_t word = rows.top[y * rows.stride + x];
                hash = (hash ^ (turnsRound ? __builtin_bswap32(word) : word)) * 1099511628211ull;
            }
        }
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

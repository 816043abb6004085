// PNG files of 16-bit samples, which the engine reads and does not write.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bytes.h"

inline std::uint32_t crc(const std::string& bytes)
{
    std::uint32_t c = 0xffffffffu;
    for (const char byte : bytes) {
        c ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) c = (c & 1) ? c >> 1 ^ 0xedb88320u : c >> 1;
    }
    return ~c;
}

inline std::string chunk(const std::string& type, const std::string& data)
{
    return bigEndian(static_cast<std::uint32_t>(data.size())) + type + data + bigEndian(crc(type + data));
}

// A grey PNG of one row of 16-bit samples, in a stored (not compressed) zlib stream.
inline std::string png16(std::uint32_t width, std::uint32_t height, const std::vector<std::uint16_t>& samples)
{
    std::string row(1, '\0');
    for (const std::uint16_t sample : samples) {
        row += static_cast<char>(sample >> 8);
        row += static_cast<char>(sample & 0xff);
    }
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char byte : row) {
        a = (a + static_cast<std::uint8_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    const auto length = static_cast<std::uint16_t>(row.size());
    std::string zlib = {'\x78', '\x01', '\x01'};
    for (const int value : {length & 0xff, length >> 8, ~length & 0xff, (~length >> 8) & 0xff}) {
        zlib += static_cast<char>(value);
    }
    zlib += row + bigEndian(b << 16 | a);
    const std::string header = bigEndian(width) + bigEndian(height) + std::string({16, 0, 0, 0, 0});
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", zlib) + chunk("IEND", "");
}

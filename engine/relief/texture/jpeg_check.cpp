// Walks a JPEG file's segments up to the end of the image. Between them lies the compressed data, in which a marker is
// known by what follows its 0xff.
#include "relief/texture/jpeg_check.h"

#include <algorithm>
#include <cstddef>

namespace relief {
namespace {

constexpr int kStartOfImage = 0xd8;
constexpr int kHuffmanTables = 0xc4;
constexpr int kEndOfImage = 0xd9;
constexpr int kNoMarker = -1;

// The file's bytes, followed by zeros, as stb_image sees them.
struct Reader
{
    std::span<const std::uint8_t> bytes;
    std::size_t at = 0;

    bool ended() const { return at >= bytes.size(); }
    int next() { return ended() ? 0 : bytes[at++]; }
    int next16()
    {
        const int high = next();
        return high << 8 | next();
    }
    void skip(int count) { at += static_cast<std::size_t>(std::max(count, 0)); }

    // The byte behind the next run of 0xff bytes.
    int nextMarker()
    {
        while (!ended() && bytes[at] != 0xff) ++at;
        while (!ended() && bytes[at] == 0xff) ++at;
        return ended() ? kNoMarker : next();
    }
};

// At the length of a segment of Huffman tables: each is a byte of names, 16 counts of codes, and a byte for each code.
bool tablesFit(Reader reader)
{
    int left = reader.next16() - 2;
    while (left > 0) {
        reader.skip(1);
        int codes = 0;
        for (int length = 1; length <= 16; ++length) codes += reader.next();
        if (codes > 256) return false;
        reader.skip(codes);
        left -= 17 + codes;
    }
    return true;
}

// Whether a marker has a segment behind it: compressed data has 0 behind its own 0xff bytes, and restarts in between.
bool hasSegment(int marker)
{
    return marker != 0 && !(marker >= 0xd0 && marker <= 0xd7);
}

}  // namespace

bool jpegTablesFit(std::span<const std::uint8_t> file)
{
    Reader reader{file};
    if (file.empty() || file[0] != 0xff || reader.nextMarker() != kStartOfImage) return true;
    // What follows the end is no part of the picture: some cameras put a film there.
    for (int marker = reader.nextMarker(); marker != kNoMarker && marker != kEndOfImage; marker = reader.nextMarker()) {
        if (marker == kHuffmanTables && !tablesFit(reader)) return false;
        if (!hasSegment(marker)) continue;
        Reader ahead = reader;
        reader.skip(ahead.next16());
    }
    return true;
}

}  // namespace relief

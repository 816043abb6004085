// PFM: a header of four words (kind, width, height, scale), one white space or line end, and the rows from the lowest
// to the top.
#include "relief/texture/pfm.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "relief/bits.h"
#include "relief/decimal.h"
#include "relief/memory.h"

namespace relief {
namespace {

// The header's words, and where the numbers begin.
struct Header
{
    int width = 0, height = 0, channels = 0;
    float scale = 0.0f;
    std::size_t length = 0;
};

// The next word at `at`, which then is after the one white space, or the line end of two characters, that ends it.
std::string_view nextWord(std::string_view text, std::size_t& at)
{
    const auto isSpace = [&](std::size_t i) { return std::isspace(static_cast<unsigned char>(text[i])) != 0; };
    while (at < text.size() && isSpace(at)) ++at;
    const std::size_t begin = at;
    while (at < text.size() && !isSpace(at)) ++at;
    const std::string_view word = text.substr(begin, at - begin);
    const bool endsWithTwo = text.substr(at).starts_with("\r\n");
    at = std::min(at + (endsWithTwo ? 2 : 1), text.size());
    return word;
}

bool readNumber(std::string_view word, float& number)
{
    const std::optional<float> value = parseDecimal(word);
    if (value) number = *value;
    return value.has_value();
}

bool readNumber(std::string_view word, int& number)
{
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
    return problem == std::errc() && end == word.data() + word.size();
}

bool readHeader(std::string_view text, Header& header)
{
    header.channels = nextWord(text, header.length) == "PF" ? 3 : 1;
    return readNumber(nextWord(text, header.length), header.width) &&
           readNumber(nextWord(text, header.length), header.height) &&
           readNumber(nextWord(text, header.length), header.scale) && header.scale != 0.0f;
}

float numberAt(const std::uint8_t* bytes, bool littleEndian)
{
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits |= std::uint32_t{bytes[i]} << (littleEndian ? 8 * i : 24 - 8 * i);
    return bitCast<float>(bits);
}

}  // namespace

bool isPfm(std::span<const std::uint8_t> bytes)
{
    return bytes.size() >= 3 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') && std::isspace(bytes[2]) != 0;
}

Expected<ImageFloat> decodePfm(const std::string& name, std::span<const std::uint8_t> bytes)
{
    Header header;
    constexpr std::size_t kLongestHeader = 200;
    if (!readHeader({reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kLongestHeader)}, header))
        return fail(name + ": is damaged (bad PFM header); copy or export it again");
    const std::string size = std::to_string(header.width) + "x" + std::to_string(header.height);
    if (header.width < 1 || header.height < 1 || header.width > kMaxImageSide || header.height > kMaxImageSide) {
        return fail(name + ": is " + size + "; each side must be in 1.." + std::to_string(kMaxImageSide) +
                    ", scale it");
    }
    const std::uint64_t count = static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height);
    const auto channels = static_cast<std::uint64_t>(header.channels);
    if (count * 16 > kMaxDecodedBytes) return fail(name + ": " + size + " takes more than 1 GiB; scale it down");
    if (bytes.size() < header.length + count * channels * 4) {
        return fail(name + ": is truncated (" + std::to_string(bytes.size()) + " bytes, but " + size + " takes " +
                    std::to_string(header.length + count * channels * 4) + "); copy or export it again");
    }
    if (!fitsInMemory(count * 16)) return fail(name + ": " + size + " does not fit into memory; scale it down");

    ImageFloat image{header.width, header.height, std::vector<float>(static_cast<std::size_t>(count) * 4, 1.0f)};
    const std::uint8_t* from = bytes.data() + header.length;
    for (int y = header.height; y-- > 0;) {
        float* pixel = &image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(header.width) * 4];
        for (int x = 0; x < header.width; ++x, pixel += 4, from += channels * 4) {
            for (int c = 0; c < 3; ++c) {
                pixel[c] = numberAt(header.channels == 3 ? from + c * 4 : from, header.scale < 0.0f);
                if (std::abs(pixel[c]) <= 1.7e38f) continue;
                return fail(name + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                            ") is NaN, infinite or larger than 1.7e38; replace it");
            }
        }
    }
    return image;
}

}  // namespace relief

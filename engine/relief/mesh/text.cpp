#include "relief/mesh/text.h"

#include <array>
#include <cstdint>
#include <string>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_easy_font.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace relief {

namespace {

// What stb takes: it writes to nothing, and its parameter is no const char*.
std::string plain(std::string_view text)
{
    std::string result(text);
    for (char& c : result) {
        if ((c < ' ' && c != '\n') || c > '~') c = '?';
    }
    return result;
}

}  // namespace

std::vector<LetterPart> letterParts(std::string_view text)
{
    struct Corner  // stb's layout; a part has four
    {
        float x, y, z;
        std::uint32_t color;
    };
    constexpr std::size_t kMostParts = 32;  // of a letter
    std::string ascii = plain(text);
    std::vector<std::array<Corner, 4>> quads(ascii.size() * kMostParts);
    const int count = stb_easy_font_print(0.0f, 0.0f, ascii.data(), nullptr, quads.data(),
                                          static_cast<int>(quads.size() * sizeof quads[0]));
    std::vector<LetterPart> parts;
    for (int i = 0; i < count; ++i) {
        const Corner &upperLeft = quads[static_cast<std::size_t>(i)][0],
                     &lowerRight = quads[static_cast<std::size_t>(i)][2];
        parts.push_back({static_cast<int>(upperLeft.x), static_cast<int>(upperLeft.y), static_cast<int>(lowerRight.x),
                         static_cast<int>(lowerRight.y)});
    }
    return parts;
}

int textWidth(std::string_view text)
{
    std::string ascii = plain(text);
    return stb_easy_font_width(ascii.data());
}

}  // namespace relief

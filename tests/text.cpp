// The letters of mesh/text.h, pixel by pixel.
#include "relief/mesh/text.h"

#include <string>

#include <doctest/doctest.h>

using namespace relief;

namespace {

// Rows of `#` and `.`, as large as the text needs.
std::string drawn(const std::string& text, int width, int height)
{
    const auto w = static_cast<std::size_t>(width);
    std::string rows((w + 1) * static_cast<std::size_t>(height), '.');
    for (const LetterPart& part : letterParts(text)) {
        for (int y = part.y0; y < part.y1; ++y) {
            for (int x = part.x0; x < part.x1; ++x)
                rows[static_cast<std::size_t>(y) * (w + 1) + static_cast<std::size_t>(x)] = '#';
        }
    }
    for (std::size_t end = w; end < rows.size(); end += w + 1) rows[end] = '\n';
    return rows;
}

}  // namespace

TEST_CASE("text: an H is an H")
{
    CHECK(drawn("H", 4, 8) ==
          "#..#\n"
          "#..#\n"
          "#..#\n"
          "####\n"
          "#..#\n"
          "#..#\n"
          "#..#\n"
          "....\n");
}

TEST_CASE("text: all letters lie within the text's width and the font's height, and lines below one another")
{
    for (char c = ' '; c <= '~'; ++c) {
        CAPTURE(c);
        const std::string text = {c};
        for (const LetterPart& part : letterParts(text)) {
            CHECK(0 <= part.x0);
            CHECK(part.x0 < part.x1);
            CHECK(part.x1 <= textWidth(text));
            CHECK(0 <= part.y0);
            CHECK(part.y0 < part.y1);
            CHECK(part.y1 <= kLetterHeight);
        }
    }
    CHECK(letterParts("").empty());
    CHECK(textWidth("one\nthree") == textWidth("three"));
    CHECK(letterParts("\nI").front().y0 == letterParts("I").front().y0 + kLineHeight);
    CHECK(textWidth("AB") == textWidth("A") + textWidth("B"));
}

TEST_CASE("text: what is not ASCII is a question mark")
{
    CHECK(drawn("\x80\x07", 20, 9) == drawn("??", 20, 9));
}

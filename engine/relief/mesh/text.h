// A small text of the engine's own: the letters of stb_easy_font as rectangles of whole pixels, the same everywhere.
#pragma once

#include <string_view>
#include <vector>

namespace relief {

// Pixels x0 ... x1 - 1, from the text's left edge, and y0 ... y1 - 1, from the top of its capitals down.
struct LetterPart
{
    int x0, y0, x1, y1;
};

// In pixels: how high capitals and digits are, and with what reaches below the line; and from one line to the next.
inline constexpr int kCapitalHeight = 7, kLetterHeight = 9, kLineHeight = 12;

// The parts of a text; those of a letter may overlap. A newline begins the next line, and what is not ASCII is a
// question mark.
std::vector<LetterPart> letterParts(std::string_view text);

// Of its longest line.
int textWidth(std::string_view text);

}  // namespace relief

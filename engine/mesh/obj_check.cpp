// The OBJ checks: one pass counts what can be referred to, a second one looks at every line.
#include "mesh/obj_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace relief {
namespace {

constexpr std::string_view kBlank = " \t";

// How many v, vt and vn lines there are: the most that a face can refer to.
struct Counts
{
    std::array<std::int64_t, 3> of{};  // in the order of a reference: position, uv, normal
};

constexpr std::array<std::string_view, 3> kKinds = {"vertex", "uv", "normal"};

std::string quoted(std::string_view word)
{
    std::string text(1, '\'');
    text += word;
    text += '\'';
    return text;
}

// Takes the next word off a line, or returns an empty one.
std::string_view takeWord(std::string_view& line)
{
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kBlank));
    line.remove_prefix(word.size());
    return word;
}

// Takes the next line off a text. A line ends in \n, \r\n or \r.
std::string_view takeLine(std::string_view& text)
{
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(line.size());
    if (text.starts_with("\r\n")) text.remove_prefix(1);
    if (!text.empty()) text.remove_prefix(1);
    return line;
}

// The place of v, vt and vn in a reference, or -1 for every other word.
int kindOf(std::string_view word)
{
    return word == "v" ? 0 : word == "vt" ? 1 : word == "vn" ? 2 : -1;
}

std::size_t skipDigits(std::string_view word, std::size_t at)
{
    while (at < word.size() && word[at] >= '0' && word[at] <= '9') ++at;
    return at;
}

// [+-] digits [. digits] [e [+-] digits], with a digit before or behind the point. Not: nan, inf, hexadecimal, and
// exponents of more than three digits, which tinyobjloader takes for 0.
bool isNumber(std::string_view word)
{
    std::size_t at = word.starts_with('+') || word.starts_with('-') ? 1 : 0;
    const std::size_t whole = skipDigits(word, at);
    std::size_t digits = whole - at;
    at = whole;
    if (at < word.size() && word[at] == '.') {
        const std::size_t fraction = skipDigits(word, at + 1);
        digits += fraction - (at + 1);
        at = fraction;
    }
    if (digits == 0) return false;
    if (at == word.size()) return true;
    if (word[at] != 'e' && word[at] != 'E') return false;
    ++at;
    if (at < word.size() && (word[at] == '+' || word[at] == '-')) ++at;
    return at < word.size() && word.size() - at <= 3 && skipDigits(word, at) == word.size();
}

Expected<void> checkNumbers(std::string_view line, std::string_view keyword, int needed)
{
    int count = 0;
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line), ++count) {
        if (!isNumber(word)) return fail(quoted(word) + " is not a finite decimal number; export it again");
    }
    if (count >= needed) return {};
    return fail(std::to_string(count) + " numbers after " + quoted(keyword) + "; give " + std::to_string(needed));
}

std::optional<int> toInteger(std::string_view word)
{
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

// One corner of a face: v, v/vt, v//vn or v/vt/vn. Positive numbers count from the file's start, from 1, and may name
// what comes later; negative ones count back from the line, from -1.
Expected<void> checkReference(std::string_view word, const Counts& inFile, const Counts& soFar)
{
    std::string_view rest = word;
    for (std::size_t part = 0; part < 3; ++part) {
        const std::string_view number = rest.substr(0, rest.find('/'));
        const bool last = number.size() == rest.size();
        const bool skipped = number.empty() && part == 1 && !last;  // the uv of v//vn
        const std::optional<int> value = toInteger(number);
        if (!value && !skipped) break;
        if (value && (*value == 0 || *value > inFile.of[part] || -std::int64_t{*value} > soFar.of[part])) {
            const std::string known = std::to_string(*value < 0 ? soFar.of[part] : inFile.of[part]);
            return fail("there is no " + std::string(kKinds[part]) + " " + std::string(number) + " among " + known +
                        "; export the file again");
        }
        if (last) return {};
        rest.remove_prefix(number.size() + 1);
    }
    return fail(quoted(word) + " is not a reference like 1, 1/2, 1//3 or 1/2/3; export the file again");
}

Expected<void> checkFace(std::string_view line, const Counts& inFile, const Counts& soFar)
{
    int corners = 0;
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line), ++corners) {
        if (const auto checked = checkReference(word, inFile, soFar); !checked) return checked;
    }
    if (corners < 3) return fail("a face with " + std::to_string(corners) + " corners; give three or more");
    if (corners <= kMaxFaceCorners) return {};
    return fail("a face with " + std::to_string(corners) + " corners; triangulate it before exporting");
}

Expected<void> checkLine(std::string_view line, const Counts& inFile, const Counts& soFar)
{
    constexpr std::array<int, 3> kNumbersNeeded = {3, 1, 3};
    if (line.ends_with('\\')) return fail("continued lines are not supported; join it with the next line");
    const std::string_view keyword = takeWord(line);
    if (const int kind = kindOf(keyword); kind >= 0) {
        return checkNumbers(line, keyword, kNumbersNeeded[static_cast<std::size_t>(kind)]);
    }
    if (keyword == "f") return checkFace(line, inFile, soFar);
    return {};
}

// Adds the line to the counts; returns whether it is a face.
bool count(std::string_view line, Counts& counts)
{
    const std::string_view keyword = takeWord(line);
    if (const int kind = kindOf(keyword); kind >= 0) ++counts.of[static_cast<std::size_t>(kind)];
    return keyword == "f";
}

}  // namespace

void blankComments(std::string& text)
{
    if (text.starts_with("\xef\xbb\xbf")) text.replace(0, 3, 3, ' ');
    bool comment = false;
    for (char& c : text) {
        comment = c == '#' || (comment && c != '\n' && c != '\r');
        if (comment) c = ' ';
    }
}

Expected<void> checkObj(const std::string& text)
{
    if (text.find('\0') != std::string::npos) {
        return fail("is not a text file (it has zero bytes); export it as OBJ in ASCII or UTF-8");
    }
    Counts inFile;
    bool anyFace = false;
    for (std::string_view rest = text; !rest.empty();) anyFace = count(takeLine(rest), inFile) || anyFace;
    if (!anyFace) return fail("has no faces; export triangles or polygons as OBJ");

    Counts soFar;
    std::int64_t number = 1;
    for (std::string_view rest = text; !rest.empty(); ++number) {
        const std::string_view line = takeLine(rest);
        if (const auto checked = checkLine(line, inFile, soFar); !checked) {
            return fail("line " + std::to_string(number) + ": " + checked.error().message);
        }
        count(line, soFar);
    }
    return {};
}

}  // namespace relief

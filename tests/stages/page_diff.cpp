#include "page_diff.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <vector>

namespace pages {

namespace {

constexpr const char* kBegin = "<!-- difference -->\n";
constexpr const char* kEnd = "<!-- /difference -->";

std::string withoutIndentation(const std::string& line)
{
    return line.substr(std::min(line.size(), line.find_first_not_of(' ')));
}

constexpr const char* kNew = "// new";

std::string withoutMark(const std::string& line)
{
    if (!line.ends_with(kNew)) return line;
    return line.substr(0, line.find_last_not_of(' ', line.size() - std::strlen(kNew) - 1) + 1);
}

std::vector<std::string> linesOf(const std::string& source)
{
    std::vector<std::string> lines;
    std::stringstream stream(source);
    for (std::string line; std::getline(stream, line);) lines.push_back(withoutMark(line));
    return lines;
}

std::vector<std::string> comparedLines(const std::string& source)
{
    std::vector<std::string> lines;
    bool inHead = true, inStage = false;
    for (const std::string& line : linesOf(source)) {
        inHead = inHead && line.starts_with("//");
        inStage = inStage || line.starts_with("Stage ");
        const std::string text = withoutIndentation(line);
        const bool named =
            inStage && (line.starts_with("Stage ") || text.starts_with("return {") || text.starts_with(".title") ||
                        text.starts_with(".section") || text.starts_with(".news"));
        if (!inHead && !named) lines.push_back(line);
    }
    return lines;
}

struct Line
{
    char mark;  // ' ', '-' or '+'
    std::string text;
};

// By the longest common subsequence: length[i][j] is that of before[i...] and after[j...]. A line that only moved to
// the right or left has not changed.
std::vector<Line> edits(const std::vector<std::string>& before, const std::vector<std::string>& after)
{
    const std::size_t rows = before.size(), columns = after.size();
    std::vector<std::vector<int>> length(rows + 1, std::vector<int>(columns + 1, 0));
    for (std::size_t i = rows; i-- > 0;) {
        for (std::size_t j = columns; j-- > 0;) {
            length[i][j] = withoutIndentation(before[i]) == withoutIndentation(after[j])
                               ? length[i + 1][j + 1] + 1
                               : std::max(length[i + 1][j], length[i][j + 1]);
        }
    }
    std::vector<Line> result;
    std::size_t i = 0, j = 0;
    while (i < rows || j < columns) {
        if (i < rows && j < columns && withoutIndentation(before[i]) == withoutIndentation(after[j])) {
            result.push_back({' ', after[j++]});
            ++i;
        } else if (j == columns || (i < rows && length[i + 1][j] >= length[i][j + 1])) {
            result.push_back({'-', before[i++]});
        } else {
            result.push_back({'+', after[j++]});
        }
    }
    return result;
}

}  // namespace

std::string difference(const std::string& before, const std::string& after)
{
    constexpr std::size_t context = 2;
    const std::vector<Line> lines = edits(comparedLines(before), comparedLines(after));
    std::string text;
    bool gap = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::size_t first = i >= context ? i - context : 0, last = std::min(i + context, lines.size() - 1);
        bool near = false;
        for (std::size_t k = first; k <= last; ++k) near = near || lines[k].mark != ' ';
        if (near) {
            if (gap && !text.empty()) text += "@@\n";
            text += lines[i].mark + lines[i].text + "\n";
        }
        gap = !near;
    }
    return text;
}

std::string marked(const std::string& before, const std::string& after)
{
    constexpr std::size_t kColumns = 120;
    const std::vector<Line> all = edits(linesOf(before), linesOf(after));
    const auto isIn = [](const Line& line) { return line.mark != '-'; };
    const auto isNew = [](const Line& line) { return line.mark == '+'; };
    const auto lines = std::count_if(all.begin(), all.end(), isIn), news = std::count_if(all.begin(), all.end(), isNew);
    std::string text;
    bool inPrograms = false;
    for (const Line& line : all) {
        if (!isIn(line)) continue;
        if (line.text.starts_with("}  // namespace")) inPrograms = false;
        const bool says = line.text.find_first_not_of(" {}();") != std::string::npos &&
                          !withoutIndentation(line.text).starts_with("//");
        const bool fits = line.text.size() + 2 + std::strlen(kNew) <= kColumns;
        const bool mark = inPrograms && isNew(line) && says && fits && 2 * news <= lines;
        text += line.text + (mark ? std::string("  ") + kNew : "") + "\n";
        if (line.text == "namespace {") inPrograms = true;
    }
    return text;
}

bool sameMarks(const std::string& source, const std::string& other)
{
    std::stringstream a(source), b(other);
    std::string line, otherLine;
    while (std::getline(a, line)) {
        if (!std::getline(b, otherLine) || line.ends_with(kNew) != otherLine.ends_with(kNew)) return false;
    }
    return !std::getline(b, otherLine);
}

std::string withoutMarks(const std::string& source)
{
    std::string text;
    for (const std::string& line : linesOf(source)) text += line + "\n";
    return text;
}

std::optional<std::string> withDifference(const std::string& page, const std::string& difference)
{
    const std::size_t begin = page.find(kBegin), end = page.find(kEnd);
    if (begin == std::string::npos || end == std::string::npos || end < begin) return std::nullopt;
    return page.substr(0, begin) + kBegin + "```diff\n" + difference + "```\n" + page.substr(end);
}

}  // namespace pages

// One pass over the lines. What a face refers to may come later in the file, so that some references are looked at
// again at the end.
#include "relief/mesh/obj_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <system_error>

#include "relief/decimal.h"

namespace relief {
namespace {

constexpr std::string_view kBlank = " \t";
constexpr std::array<std::string_view, 3> kKinds = {"vertex", "uv", "normal"};  // in the order of a reference
constexpr std::size_t kNormal = 2;

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

// Takes the next line off a text, without its comment. A line ends in \n, \r\n or \r.
std::string_view takeLine(std::string_view& text)
{
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(line.size());
    if (text.starts_with("\r\n")) text.remove_prefix(1);
    if (!text.empty()) text.remove_prefix(1);
    return line.substr(0, line.find('#'));
}

std::optional<int> toInteger(std::string_view word)
{
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

class Parser
{
public:
    Expected<ObjText> parse(std::string_view text)
    {
        for (; !text.empty(); ++number) {
            if (const Expected<void> parsed = parseLine(takeLine(text)); !parsed) return failAt(number, parsed.error());
        }
        if (const Expected<void> exist = checkLater(); !exist) return tl::unexpected(exist.error());
        if (result.faceLengths.empty()) return fail("has no faces; export triangles or polygons as OBJ");
        dropMissingNormals();
        return std::move(result);
    }

private:
    struct Numbers
    {
        std::array<float, 6> value{};
        int count = 0;  // may be more than there are places
    };

    // A reference to what had not come yet.
    struct Later
    {
        int index;  // as in the file, from 1
        std::int64_t line;
    };

    static tl::unexpected<Error> failAt(std::int64_t line, const Error& error)
    {
        return fail("line " + std::to_string(line) + ": " + error.message);
    }

    Expected<void> parseLine(std::string_view line)
    {
        if (line.ends_with('\\')) return fail("continued lines are not supported; join it with the next line");
        const std::string_view keyword = takeWord(line);
        if (keyword == "f") return parseFace(line);
        if (keyword == "v") return parseNumbers(line, keyword, 3).map([&](const Numbers& n) { addPosition(n); });
        if (keyword == "vt") {
            return parseNumbers(line, keyword, 1).map([&](const Numbers& n) {
                result.uvs.emplace_back(n.value[0], n.value[1]);
            });
        }
        if (keyword != "vn") return {};
        return parseNumbers(line, keyword, 3).map([&](const Numbers& n) {
            result.normals.emplace_back(n.value[0], n.value[1], n.value[2]);
        });
    }

    static Expected<Numbers> parseNumbers(std::string_view line, std::string_view keyword, int needed)
    {
        Numbers numbers;
        for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line), ++numbers.count) {
            const std::optional<float> value = parseDecimal(word);
            if (!value) return fail(quoted(word) + " is not a finite decimal number; export it again");
            const auto place = static_cast<std::size_t>(numbers.count);
            if (place < numbers.value.size()) numbers.value[place] = *value;
        }
        if (numbers.count >= needed) return numbers;
        return fail(std::to_string(numbers.count) + " numbers after " + quoted(keyword) + "; give " +
                    std::to_string(needed));
    }

    void addPosition(const Numbers& n)
    {
        const bool isColored = n.count == 6;
        if (isColored) result.colors.resize(result.positions.size(), glm::vec3(1));
        result.positions.emplace_back(n.value[0], n.value[1], n.value[2]);
        if (isColored) result.colors.emplace_back(n.value[3], n.value[4], n.value[5]);
        if (!result.colors.empty()) result.colors.resize(result.positions.size(), glm::vec3(1));
    }

    Expected<void> parseFace(std::string_view line)
    {
        const std::size_t first = result.corners.size();
        for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
            const Expected<ObjCorner> corner = parseReference(word);
            if (!corner) return tl::unexpected(corner.error());
            result.corners.push_back(*corner);
        }
        const std::size_t corners = result.corners.size() - first;
        if (corners < 3) return fail("a face with " + std::to_string(corners) + " corners; give three or more");
        result.faceLengths.push_back(static_cast<std::uint32_t>(corners));
        if (corners <= kMaxFaceCorners) return {};
        return fail("a face with " + std::to_string(corners) + " corners; triangulate it before exporting");
    }

    std::size_t countOf(std::size_t kind) const
    {
        return kind == 0 ? result.positions.size() : kind == 1 ? result.uvs.size() : result.normals.size();
    }

    static tl::unexpected<Error> failMissing(std::size_t kind, int index, std::size_t count)
    {
        return fail("there is no " + std::string(kKinds[kind]) + " " + std::to_string(index) + " among " +
                    std::to_string(count) + "; export the file again");
    }

    // One corner of a face: v, v/vt, v//vn or v/vt/vn. Positive numbers count from the file's start, from 1, and may
    // name what comes later; negative ones count back from the line, from -1.
    Expected<ObjCorner> parseReference(std::string_view word)
    {
        ObjCorner corner;
        std::uint32_t* const parts[] = {&corner.position, &corner.uv, &corner.normal};
        std::string_view rest = word;
        for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
            const std::string_view digits = rest.substr(0, rest.find('/'));
            const bool last = digits.size() == rest.size();
            const bool skipped = digits.empty() && kind == 1 && !last;  // the uv of v//vn
            const std::optional<int> index = toInteger(digits);
            if (!index && !skipped) break;
            if (index) {
                const std::size_t count = countOf(kind);
                const std::int64_t place = *index < 0 ? static_cast<std::int64_t>(count) + *index : *index - 1;
                const bool exists = *index != 0 && place >= 0;
                if (!exists && (kind != kNormal || *index == 0)) return failMissing(kind, *index, count);
                if (exists) *parts[kind] = static_cast<std::uint32_t>(place);
                if (*index > largestLater(kind, count)) later[kind].push_back({*index, number});
            }
            if (last) return corner;
            rest.remove_prefix(digits.size() + 1);
        }
        return fail(quoted(word) + " is not a reference like 1, 1/2, 1//3 or 1/2/3; export the file again");
    }

    // The largest index that needs no note: it exists, or the first line with one as large is noted.
    int largestLater(std::size_t kind, std::size_t count) const
    {
        const auto known = static_cast<int>(std::min<std::size_t>(count, std::numeric_limits<int>::max()));
        return later[kind].empty() ? known : std::max(known, later[kind].back().index);
    }

    // The first line that refers to nothing. Within a kind, indices grow from note to note.
    Expected<void> checkLater() const
    {
        const Later* first = nullptr;
        std::size_t kindOfFirst = 0;
        for (std::size_t kind = 0; kind < kNormal; ++kind) {
            const auto isMissing = [&](const Later& l) { return static_cast<std::size_t>(l.index) > countOf(kind); };
            const auto found = std::find_if(later[kind].begin(), later[kind].end(), isMissing);
            if (found == later[kind].end() || (first && first->line <= found->line)) continue;
            first = &*found;
            kindOfFirst = kind;
        }
        if (!first) return {};
        return failAt(first->line, failMissing(kindOfFirst, first->index, countOf(kindOfFirst)).value());
    }

    void dropMissingNormals()
    {
        if (later[kNormal].empty()) return;
        for (ObjCorner& corner : result.corners) {
            if (corner.normal != ObjCorner::kNone && corner.normal >= result.normals.size()) {
                corner.normal = ObjCorner::kNone;
            }
        }
    }

    ObjText result;
    std::int64_t number = 1;  // of the line
    std::array<std::vector<Later>, 3> later;
};

}  // namespace

Expected<ObjText> parseObj(std::string_view text)
{
    if (text.find('\0') != std::string_view::npos) {
        return fail("is not a text file (it has zero bytes); export it as OBJ in ASCII or UTF-8");
    }
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // a byte order mark
    return Parser().parse(text);
}

}  // namespace relief

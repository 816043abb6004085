#include "grader/exercise.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "common/pattern.h"
#include "relief/file.h"
#include "relief/path.h"

namespace relief::samples::grader {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string trimmed(const std::string& text)
{
    const std::size_t begin = text.find_first_not_of(" \n");
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \n") + 1 - begin);
}

// --- exercise.md ---

// Reads the file line by line into the exercise; what is wrong with it becomes `problem`.
struct Reader
{
    Exercise& exercise;
    std::string section, problem;
    bool inCode = false;

    void head(const std::string& line);
    void take(const std::string& line);
    void takeMistake(const std::string& line, std::vector<Mistake>& list);
    void takeCondition(const std::string& line);
};

// "# 1.08a Along v", then "Stage 1.08 · derive".
void Reader::head(const std::string& line)
{
    static const Pattern title("# (\\d\\.\\d\\d[a-z]) (.+)");
    static const Pattern about("Stage (\\d\\.\\d\\d) · (fix|derive|predict|open)");
    if (const auto named = title.match(line)) {
        exercise.id = (*named)[1];
        exercise.title = (*named)[2];
    } else if (const auto its = about.match(line)) {
        exercise.stage = (*its)[1];
        exercise.kind = (*its)[2];
    } else {
        exercise.task += line + "\n";
    }
}

// "- `sign` Your v slope has the wrong sign. See 1.08.", then lines such as "  - `v1 - v2` -> `v2 - v1`".
void Reader::takeMistake(const std::string& line, std::vector<Mistake>& list)
{
    static const Pattern head("- `([a-z0-9-]+)` (.+?)\\.?( See \\d\\.\\d\\d(?: and \\d\\.\\d\\d)?\\.)?");
    if (line.starts_with("  - `") && !list.empty()) {
        const std::size_t arrow = line.find("` -> `");
        if (arrow == std::string::npos || !line.ends_with("`")) {
            problem = "'" + line + "': write - `this` -> `that`";
            return;
        }
        list.back().changes.push_back(
            {line.substr(5, arrow - 5), line.substr(arrow + 6, line.size() - 1 - (arrow + 6))});
    } else if (const auto m = head.match(line)) {
        list.push_back({(*m)[1], (*m)[2], m->has(3) ? (*m)[3].substr(1) : "", {}});
    } else if (!line.empty()) {
        problem = "'" + line + "': write - `name` and a sentence";
    }
}

// "- `mean` <= 0.8 start: A wet surface is darker."
void Reader::takeCondition(const std::string& line)
{
    static const Pattern condition("- `([a-z]+)` (<=|>=) ([0-9.]+)( start)?: (.+?)\\.?");
    if (const auto m = condition.match(line)) {
        exercise.conditions.push_back({(*m)[1], (*m)[2], std::stod((*m)[3]), m->has(4), (*m)[5]});
    } else if (!line.empty()) {
        problem = "'" + line + "': write - `measure` <= number: and a sentence";
    }
}

void Reader::take(const std::string& line)
{
    static const Pattern hint("\\d\\. (.+)");
    if (line.starts_with("## ")) {
        section = line.substr(3);
    } else if (section.empty()) {
        head(line);
    } else if (section == "Hints") {
        if (const auto m = hint.match(line)) exercise.hints.push_back((*m)[1]);
    } else if (section == "Start") {
        if (line.starts_with("```")) {
            inCode = !inCode;
            if (inCode) exercise.starts.emplace_back();
        } else if (inCode) {
            exercise.starts.back() += line + "\n";
        }
    } else if (section == "Mistakes" || section == "Also right") {
        takeMistake(line, section == "Mistakes" ? exercise.mistakes : exercise.also);
    } else if (section == "Conditions") {
        takeCondition(line);
    } else {
        problem = "section '" + section + "': write Hints, Start, Mistakes, Also right or Conditions";
    }
}

std::string problemWith(const Exercise& e)
{
    if (e.id.empty()) return "its first line is no '# 1.08a Title'";
    if (e.kind.empty()) return "it has no line 'Stage 1.08 · derive' (or fix, predict, open)";
    if (!e.stem.starts_with(e.id + "_")) return "its folder is not named after its id, " + e.id;
    if (e.task.empty()) return "it has no task";
    if (e.hints.empty() || e.hints.size() > 3) return "write one to three hints";
    if (e.mistakes.size() < 5) return "write five mistakes or more";
    if (e.isOpen() == e.conditions.empty()) return "an open exercise has conditions, and no other has";
    if (gapsOf(e.answer).empty()) return "its answer has no lines '// your turn: ...' and '// end of your turn'";
    if (gapsOf(e.answer).size() != e.starts.size()) return "write what stands in each gap at first, a code block each";
    for (const Mistake& m : e.mistakes) {
        if (m.changes.empty()) return "mistake " + m.name + " has no replacement";
    }
    return "";
}

// --- variants ---

struct Edit
{
    Span span;
    std::string text;
};

// Where a text stands in the gaps; nothing if nowhere, or more than once.
std::optional<Span> placeOf(const Exercise& exercise, const std::string& text)
{
    std::optional<Span> found;
    for (const Span& gap : gapsOf(exercise.answer)) {
        for (std::size_t at = exercise.answer.find(text, gap.begin);
             at != std::string::npos && at + text.size() <= gap.end; at = exercise.answer.find(text, at + 1)) {
            if (found) return std::nullopt;
            found = Span{at, at + text.size()};
        }
    }
    return found;
}

Expected<std::vector<Edit>> editsOf(const Exercise& exercise, const Mistake& mistake)
{
    std::vector<Edit> edits;
    for (const Replacement& change : mistake.changes) {
        const std::optional<Span> place = placeOf(exercise, change.from);
        if (!place) {
            return fail(exercise.folder + "/exercise.md: mistake " + mistake.name + ": `" + change.from +
                        "` does not stand in the answer's gap exactly once; write more or less of the line");
        }
        edits.push_back({*place, change.to});
    }
    return edits;
}

std::string edited(std::string text, std::vector<Edit> edits)
{
    std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.span.begin > b.span.begin; });
    for (const Edit& e : edits) text.replace(e.span.begin, e.span.end - e.span.begin, e.text);
    return text;
}

bool overlap(const std::vector<Edit>& first, const std::vector<Edit>& second)
{
    for (const Edit& a : first) {
        for (const Edit& b : second) {
            if (a.span.begin < b.span.end && b.span.begin < a.span.end) return true;
        }
    }
    return false;
}

std::string startText(const Exercise& exercise)
{
    std::vector<Edit> edits;
    const std::vector<Span> gaps = gapsOf(exercise.answer);
    for (std::size_t i = 0; i < gaps.size(); ++i) edits.push_back({gaps[i], exercise.starts[i]});
    return edited(exercise.answer, edits);
}

// --- the learner's file ---

// A paragraph as lines of a comment.
std::string comment(const std::string& paragraph, const std::string& indent)
{
    std::string text, line = "// ";
    std::istringstream words(paragraph);
    for (std::string word; words >> word;) {
        if (line.size() + word.size() > 116) {
            text += line.substr(0, line.size() - 1) + "\n";
            line = "// " + indent;
        }
        line += word + " ";
    }
    return text + line.substr(0, line.size() - 1) + "\n";
}

}  // namespace

Expected<Exercise> readExercise(const std::string& folder)
{
    Exercise exercise;
    exercise.folder = folder;
    exercise.stem = utf8Of(pathOf(folder).filename());
    const Expected<std::string> page = readText(folder + "/exercise.md");
    if (!page) return tl::unexpected(page.error());
    const Expected<std::string> answer = readText(folder + "/answer/answer.cpp");
    if (!answer) return tl::unexpected(answer.error());
    exercise.answer = *answer;
    Reader reader{exercise, {}, {}};
    for (const std::string& line : linesOf(*page)) reader.take(line);
    exercise.task = trimmed(exercise.task);
    const std::string problem = reader.problem.empty() ? problemWith(exercise) : reader.problem;
    if (!problem.empty()) return fail(folder + "/exercise.md: " + problem);
    return exercise;
}

Expected<const Exercise*> findExercise(const std::vector<Exercise>& all, const std::string& name)
{
    std::string closest;
    for (const Exercise& one : all) {
        const std::string shortId = one.id[2] == '0' ? one.id.substr(0, 2) + one.id.substr(3) : one.id;
        if (name == one.id || name == shortId || name == one.stem) return &one;
        const bool isOfStage =
            name.size() >= 3 && (one.id.starts_with(name) || one.stem.find(name) != std::string::npos);
        if (isOfStage) closest += (closest.empty() ? "" : ", ") + one.id + " " + one.title;
    }
    return fail("there is no exercise '" + name + "'" + (closest.empty() ? "" : " (did you mean " + closest + "?)") +
                "; `relief exercise` lists them all");
}

std::vector<Span> gapsOf(const std::string& text)
{
    std::vector<Span> gaps;
    std::size_t at = 0;
    while ((at = text.find(kGapBegins, at)) != std::string::npos) {
        const std::size_t begin = text.find('\n', at), mark = text.find(kGapEnds, at);
        if (begin == std::string::npos || mark == std::string::npos) break;
        gaps.push_back({begin + 1, text.rfind('\n', mark) + 1});
        at = mark + 1;
    }
    return gaps;
}

std::optional<Span> changedSpan(const Exercise& exercise, const Replacement& change)
{
    const std::optional<Span> place = placeOf(exercise, change.from);
    if (!place) return std::nullopt;
    const std::string &a = change.from, &b = change.to;
    const std::size_t shorter = std::min(a.size(), b.size());
    std::size_t head = 0, tail = 0;
    while (head < shorter && a[head] == b[head]) ++head;
    while (tail < shorter - head && a[a.size() - 1 - tail] == b[b.size() - 1 - tail]) ++tail;
    return Span{place->begin + head, place->end - tail};
}

Expected<std::vector<Variant>> variantsOf(const Exercise& exercise)
{
    std::vector<Variant> all = {{"answer", exercise.answer, {}, true}, {"start", startText(exercise), {}, false}};
    for (const Mistake& right : exercise.also) {
        const Expected<std::vector<Edit>> edits = editsOf(exercise, right);
        if (!edits) return tl::unexpected(edits.error());
        all.push_back({right.name, edited(exercise.answer, *edits), {}, true});
    }
    std::vector<std::vector<Edit>> edits;
    for (const Mistake& mistake : exercise.mistakes) {
        Expected<std::vector<Edit>> its = editsOf(exercise, mistake);
        if (!its) return tl::unexpected(its.error());
        all.push_back({mistake.name, edited(exercise.answer, *its), {&mistake}, false});
        edits.push_back(std::move(*its));
    }
    for (std::size_t i = 0; i < edits.size(); ++i) {
        for (std::size_t k = i + 1; k < edits.size(); ++k) {
            if (overlap(edits[i], edits[k])) continue;
            std::vector<Edit> both = edits[i];
            both.insert(both.end(), edits[k].begin(), edits[k].end());
            const Mistake &first = exercise.mistakes[i], &second = exercise.mistakes[k];
            all.push_back({first.name + "+" + second.name, edited(exercise.answer, both), {&first, &second}, false});
        }
    }
    return all;
}

std::string learnersText(const Exercise& exercise, const std::string& path)
{
    std::string text = "// Exercise " + exercise.id + " " + exercise.title + " (" + exercise.kind + ")\n//\n";
    std::string paragraph;
    for (const std::string& line : linesOf(exercise.task + "\n\n")) {
        if (!line.empty()) paragraph += line + " ";
        if (!line.empty() || paragraph.empty()) continue;
        text += comment(paragraph, "") + "//\n";
        paragraph.clear();
    }
    const std::size_t width = path.size() + 30;
    const auto command = [&](const std::string& words, const std::string& meaning) {
        std::string line = "//   ./relief " + words + path;
        return line + std::string(width > line.size() ? width - line.size() : 0, ' ') + "  " + meaning + "\n";
    };
    text += command("view ", "goal, your picture and their difference, at every save");
    text += command("check-exercise ", "whether it is solved, and if not, what is wrong");
    text += "//\n// Read: stage " + exercise.stage + ". Hints stand at the end of this file.\n";

    std::string start = startText(exercise);
    while (start.starts_with("//")) start.erase(0, start.find('\n') + 1);
    text += start + "\n";
    for (std::size_t i = 0; i < exercise.hints.size(); ++i) {
        text += comment("Hint " + std::to_string(i + 1) + ": " + exercise.hints[i], "  ");
    }
    return text;
}

std::string exerciseIdOf(const std::string& path, const std::string& text)
{
    static const Pattern head("// Exercise (\\d\\.\\d\\d[a-z])\\b"), name("(?:.*_)?(\\d\\.\\d\\d[a-z])(_.*)?");
    const std::vector<Match> heads = head.find(text.substr(0, text.find('\n')));
    if (!heads.empty()) return heads[0][1];
    const auto named = name.match(utf8Of(pathOf(path).stem()));
    return named ? (*named)[1] : "";
}

}  // namespace relief::samples::grader

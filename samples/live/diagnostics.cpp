#include "live/diagnostics.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include "common/pattern.h"

namespace relief::samples::live {

namespace {

struct Line
{
    std::string file;
    int line = 0, column = 0;
    std::string kind;  // "error", "note", "required" ...
    std::string message;
};

// "FILE:LINE:COLUMN: error: MESSAGE", or what g++ puts before an error, "FILE:LINE:COLUMN:   required from here".
std::optional<Line> parseLine(const std::string& text)
{
    static const Pattern message(R"((.+?):(\d+):(?:(\d+):)? +(?:fatal )?(error|warning|note): (.*))");
    static const Pattern context(R"((.+?):(\d+):(?:(\d+):)? +(?:recursively )?(required) (?:from|by) .*)");
    std::optional<Match> m = message.match(text);
    if (!m) m = context.match(text);
    if (!m) return std::nullopt;
    return Line{(*m)[1], std::stoi((*m)[2]), m->has(3) ? std::stoi((*m)[3]) : 0, (*m)[4], m->has(5) ? (*m)[5] : ""};
}

// Types as they are written in a stage, and the compiler's turns of phrase as a person's.
std::string inPlainWords(std::string text)
{
    static const std::pair<Pattern, const char*> rules[] = {
        {Pattern("[\u2018\u2019]"), "'"},
        {Pattern("&apos;"), "'"},
        {Pattern("\\(anonymous namespace\\)::|\\{anonymous\\}::|\\(anonymous\\)::"), ""},
        {Pattern("relief::samples::|relief::lanes\\d+::|relief::detail::|relief::|lanes\\d+::"), ""},
        {Pattern("LaneVector<Float, (\\d)>"), "float$1"},
        {Pattern("LaneVector<Int, (\\d)>"), "int$1"},
        {Pattern("LaneMatrix<Float, (\\d), (\\d)>"), "float$1x$2"},
        {Pattern(" ?\\{aka [^}]*\\}| \\(aka '[^']*'\\)"), ""},
        {Pattern("^static assertion failed: |^static_assert failed due to requirement '.*' \"|"
                 "^static_assert failed \"|^static assertion failed due to requirement '.*?': "),
         ""},
        {Pattern("^'([^']+)' was not declared in this scope; did you mean '([^']+)'\\?"),
         "'$1' is not declared here; did you mean '$2'?"},
        {Pattern("^use of undeclared identifier '([^']+)'; did you mean '([^']+)'\\?"),
         "'$1' is not declared here; did you mean '$2'?"},
        {Pattern("^'([^']+)' was not declared in this scope"), "'$1' is not declared here"},
        {Pattern("^use of undeclared identifier '([^']+)'"), "'$1' is not declared here"},
        {Pattern("^expected ';' before .*|^expected ';' (after|at) .*"), "a ';' is missing before this"},
        {Pattern("^expected (primary-)?expression( before '(.*)' token)?"),
         "a value is missing here, before what follows"},
        {Pattern("^no match for '(operator)?([^']+)' \\(operand types are '([^']+)' and '([^']+)'\\)"),
         "there is no $2 between a $3 and a $4"},
        {Pattern("^invalid operands to binary expression \\('([^']+)' and '([^']+)'\\)"),
         "there is no such operator between a $1 and a $2"},
        {Pattern("^could not convert '([^']+)' from '([^']+)' to '([^']+)'"), "'$1' is a $2, and a $3 is needed"},
        {Pattern("^conversion from '([^']+)' to non-scalar type '([^']+)' requested"),
         "this is a $1, and a $2 is needed"},
        {Pattern("^no viable conversion from '([^']+)' to '([^']+)'"), "this is a $1, and a $2 is needed"},
        {Pattern("^no viable conversion from returned value of type '([^']+)' to function return type '([^']+)'"),
         "this returns a $1, and a $2 is needed"},
        {Pattern("^'(?:const )?(?:class |struct )?([^']+)' has no member named '([^']+)'"), "a $1 has no '$2'"},
        {Pattern("^no member named '([^']+)' in '([^']+)'"), "a $2 has no '$1'"},
        {Pattern("^no matching function for call to '([^']+)'"),
         "there is no '$1' that takes these values: look at their number and their types"},
    };
    for (const auto& [pattern, words] : rules) text = pattern.replace(text, words);
    return text;
}

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace

std::vector<Diagnostic> parseDiagnostics(const std::string& output, const std::string& path, const std::string& text)
{
    const std::vector<std::string> source = linesOf(text);
    std::vector<Diagnostic> found;
    const auto place = [&](Diagnostic& d, const Line& line) {
        d.file = line.file;
        d.line = line.line;
        d.column = line.column;
        const auto row = static_cast<std::size_t>(line.line);
        if (line.file == path && row >= 1 && row <= source.size()) d.source = source[row - 1];
    };
    std::optional<Line> before;  // where g++ says, ahead of an error, that the learner's file came in
    bool open = false;           // clang says it after the error
    for (const std::string& row : linesOf(output)) {
        const std::optional<Line> line = parseLine(row);
        if (!line) continue;
        const bool learners = line->file == path;
        if (line->kind == "required") {
            if (learners) before = line;
        } else if (line->kind == "error") {
            Diagnostic d;
            d.message = inPlainWords(line->message);
            d.fromCheck = line->message.find("static assertion failed") != std::string::npos ||
                          line->message.find("static_assert failed") != std::string::npos;
            if (d.fromCheck && d.message.ends_with('"')) d.message.pop_back();
            place(d, !learners && before ? *before : *line);
            open = !learners && !before;
            before.reset();
            found.push_back(std::move(d));
        } else if (line->kind == "note" && learners && open) {
            place(found.back(), *line);
            open = false;
        }
    }
    if (found.empty() && !output.empty()) {
        static const Pattern stale("file '([^']+)' has been modified since the precompiled header");
        const std::vector<Match> header = stale.find(output);
        const std::string message = !header.empty() ? header[0][1] +
                                                          ": has changed since Relief was built; close this, and "
                                                          "start it by ./relief again, which builds what is needed"
                                                    : linesOf(output).back();
        found.push_back({.file = path, .message = message});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Diagnostic& a, const Diagnostic& b) { return a.fromCheck && !b.fromCheck; });
    const auto same = [](const Diagnostic& a, const Diagnostic& b) {
        return a.message == b.message && a.line == b.line && a.file == b.file;
    };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
    return found;
}

std::string formatted(const Diagnostic& d)
{
    std::string text = std::filesystem::path(d.file).filename().string();
    if (d.line > 0) text += ":" + std::to_string(d.line);
    if (d.line > 0 && d.column > 0) text += ":" + std::to_string(d.column);
    text += ": " + d.message + "\n";
    if (d.source.empty()) return text;
    const std::string number = std::to_string(d.line);
    const std::size_t margin = number.size() < 5 ? 5 - number.size() : 0;
    text += std::string(margin, ' ') + number + " | " + d.source + "\n";
    if (d.column < 1) return text;
    // Tabs stay, so that the mark stands below its letter.
    std::string mark = d.source.substr(0, static_cast<std::size_t>(d.column - 1));
    for (char& c : mark) c = c == '\t' ? '\t' : ' ';
    return text + std::string(margin + number.size(), ' ') + " | " + mark + "^\n";
}

std::string formatted(const std::vector<Diagnostic>& diagnostics)
{
    std::string text;
    for (const Diagnostic& d : diagnostics) text += formatted(d);
    return text;
}

}  // namespace relief::samples::live

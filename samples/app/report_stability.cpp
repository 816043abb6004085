// report stability: runs the tests of all stability cases, with full counts, and writes down what each of them measured
// against its bound, beside pictures of what the obvious form would have drawn.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include <unistd.h>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "common/shell.h"
#include "cost.h"
#include "report.h"
#include "stability_pictures.h"

namespace relief::samples {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// What one test wrote down (tests/stability.cpp).
struct TestResult
{
    std::string name;
    json result;  // empty if the test program ended before it could write it
};

struct Results
{
    json cases;  // the table
    std::vector<TestResult> tests;
};

constexpr const char* kRandomScenes = "random scenes: ";

// A file that is there as long as this is.
struct TemporaryFile
{
    TemporaryFile() : path(fs::temp_directory_path() / ("relief-stability-" + std::to_string(getpid()) + ".json")) {}
    ~TemporaryFile()
    {
        std::error_code ignored;
        fs::remove(path, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    fs::path path;
};

// Whether a test's name has the id: S-101 is not in S-1011.
bool mentions(const std::string& name, const std::string& id)
{
    const std::size_t at = name.find(id);
    if (at == std::string::npos) return false;
    const std::size_t end = at + id.size();
    return end == name.size() || std::isdigit(static_cast<unsigned char>(name[end])) == 0;
}

// The tests' names, of all cases or of those asked for.
Expected<std::vector<std::string>> testNames(const ReportOptions& options)
{
    const std::string filter = "*S-*," + std::string(kRandomScenes) + "*";
    const std::optional<std::string> list =
        outputOf(quoted(options.tests) + " --no-colors --list-test-cases --test-case=" + quoted(filter));
    if (!list || list->find("[doctest]") == std::string::npos) {
        return fail("report stability: " + options.tests +
                    " does not run, or is no test program; run ./relief report stability");
    }
    std::vector<std::string> names;
    std::size_t begin = 0;
    while (begin < list->size()) {
        const std::size_t end = std::min(list->find('\n', begin), list->size());
        const std::string line = list->substr(begin, end - begin);
        const auto named = [&](const std::string& id) { return mentions(line, id); };
        const bool wanted = options.only.empty() || std::any_of(options.only.begin(), options.only.end(), named);
        if (wanted && !line.empty() && !line.starts_with("[doctest]") && !line.starts_with("====="))
            names.push_back(line);
        begin = end + 1;
    }
    if (names.empty())
        return fail("report stability: no test has this id; see docs/report/stability.md for all of them");
    return names;
}

// doctest takes a list with commas.
std::string withEscapedCommas(const std::string& name)
{
    std::string escaped;
    for (const char c : name) escaped += c == ',' ? "\\," : std::string(1, c);
    return escaped;
}

// Each test in a process of its own: one that ends it is one that fails, and the others still run.
Expected<Results> runTests(const ReportOptions& options)
{
    const Expected<std::vector<std::string>> names = testNames(options);
    if (!names) return tl::unexpected(names.error());
    const TemporaryFile file;
    Results results;
    for (std::size_t i = 0; i < names->size(); ++i) {
        const std::string& name = (*names)[i];
        showProgress(std::to_string(i + 1) + " of " + std::to_string(names->size()) + ": " + name);
        std::error_code ignored;
        fs::remove(file.path, ignored);
        // Whether it fails stands in the file.
        (void)outputOf("RELIEF_FULL_TRIALS=1 RELIEF_STABILITY_FILE=" + quoted(file.path.string()) + " " +
                       quoted(options.tests) + " --test-case=" + quoted(withEscapedCommas(name)));
        std::ifstream stream(file.path);
        const json written = json::parse(stream, nullptr, false);
        results.tests.push_back({name, {}});
        if (written.is_discarded()) continue;
        results.cases = written["cases"];
        for (const json& test : written["tests"]) results.tests.back().result = test;
    }
    showProgress("");
    if (results.cases.empty()) {
        return fail("report stability: no test of " + options.tests + " wrote its results; run it by hand to see why");
    }
    return results;
}

// --- what came out ---

struct Number
{
    std::string what;
    json value, bound;  // a number, or a word for what is none; no bound: null
};

struct Outcome
{
    std::vector<const TestResult*> tests;
    std::vector<Number> numbers;
    int checks = 0;
    bool holds = true;
};

std::string text(const json& value)
{
    if (!value.is_number()) return value.is_string() ? value.get<std::string>() : "";
    const double number = value.get<double>();
    return samples::text(number == std::floor(number) && std::abs(number) < 1e9 ? "%.0f" : "%.4g", number);
}

// Of numbers that several tests give under one name and with one bound, the worst.
void addWorst(std::vector<Number>& numbers, const Number& number)
{
    for (Number& n : numbers) {
        if (n.what != number.what || n.bound != number.bound) continue;
        if (!number.value.is_number() || (n.value.is_number() && number.value > n.value)) n.value = number.value;
        return;
    }
    numbers.push_back(number);
}

template <class Belongs>
Outcome outcomeOf(const Results& results, const Belongs& belongs)
{
    Outcome outcome;
    for (const TestResult& test : results.tests) {
        if (!belongs(test)) continue;
        outcome.tests.push_back(&test);
        if (test.result.is_null()) {
            outcome.holds = false;
            continue;
        }
        outcome.holds = outcome.holds && test.result["passed"].get<bool>();
        outcome.checks += test.result["checks"].get<int>();
        for (const json& n : test.result["numbers"]) {
            addWorst(outcome.numbers, {n["what"], n["value"], n.contains("bound") ? n["bound"] : json()});
        }
    }
    return outcome;
}

std::string measuredCell(const Outcome& outcome)
{
    std::string cell;
    for (const Number& n : outcome.numbers) {
        const std::string bound = n.bound.is_null() ? "" : " (" + text(n.bound) + ")";
        cell += (cell.empty() ? "" : "; ") + n.what + ": " + text(n.value) + bound;
    }
    if (cell.empty() && outcome.checks > 0)
        cell = std::to_string(outcome.checks) + (outcome.checks == 1 ? " check" : " checks");
    return cell;
}

std::string verdict(const json& row, const Outcome& outcome)
{
    if (row.contains("missing")) return "not there";
    if (outcome.tests.empty()) return "not run";
    return outcome.holds ? "holds" : "**fails**";
}

struct Topic
{
    const char* name;
    int from;  // the first number of its ids
};
constexpr Topic kTopics[] = {{"Vertices", 101},
                             {"Clipping", 201},
                             {"Setup and coverage", 301},
                             {"Interpolation", 401},
                             {"Derivatives and level of detail", 501},
                             {"Textures", 551},
                             {"Normals", 601},
                             {"Tangent frames", 651},
                             {"Triplanar", 701},
                             {"Light", 801},
                             {"Depth", 901},
                             {"Parallax and shadows", 921},
                             {"Framebuffer", 951},
                             {"Threads, processors, builds", 1001},
                             {"What is left out", 1101}};

std::string escaped(std::string cell)
{
    for (std::size_t at = 0; (at = cell.find('|', at)) != std::string::npos; at += 2) cell.insert(at, "\\");
    return cell;
}

std::string csvCell(const std::string& cell)
{
    std::string quotedCell = "\"";
    for (const char c : cell) quotedCell += c == '"' ? "\"\"" : std::string(1, c);
    return quotedCell + "\"";
}

struct Written
{
    std::string markdown, csv;
    int hold = 0, missing = 0;
    std::vector<std::string> failing;
};

void writeRow(const json& row, const Outcome& outcome, Written& written)
{
    const auto cell = [&](const char* key) { return row[key].get<std::string>(); };
    const std::string id = cell("id"), how = verdict(row, outcome);
    written.missing += row.contains("missing");
    written.hold += how == "holds";
    if (how == "**fails**") written.failing.push_back(id);
    const std::string measured = row.contains("missing") ? cell("missing") : measuredCell(outcome);
    written.markdown += "| " + id + " | " + escaped(cell("input")) + " | " + escaped(cell("naive")) + " | " +
                        escaped(cell("bound")) + " | " + escaped(measured) + " | " + how + " |\n";
    const std::string plain = how == "**fails**" ? "fails" : how;
    if (outcome.numbers.empty()) {
        written.csv += id + "," + plain + "," + csvCell(row.contains("missing") ? measured : "checks") + "," +
                       (row.contains("missing") ? "" : std::to_string(outcome.checks)) + ",\n";
    }
    for (const Number& n : outcome.numbers) {
        const auto plainNumber = [](const json& value) {
            return value.is_number() ? samples::text("%.9g", value.get<double>()) : text(value);
        };
        written.csv +=
            id + "," + plain + "," + csvCell(n.what) + "," + plainNumber(n.value) + "," + plainNumber(n.bound) + "\n";
    }
}

Written write(const Results& results)
{
    Written written;
    written.csv = "id,verdict,what,value,bound\n";
    const Topic* topic = nullptr;
    for (const json& row : results.cases) {
        const auto id = row["id"].get<std::string>();
        const Outcome outcome = outcomeOf(results, [&](const TestResult& test) { return mentions(test.name, id); });
        const int number = std::stoi(id.substr(2));
        const Topic* of = nullptr;
        for (const Topic& t : kTopics) of = number >= t.from ? &t : of;
        if (of != topic) {
            written.markdown += std::string("\n## ") + of->name +
                                "\n\n| case | input | the obvious form | asked for | measured (at most) | "
                                "|\n|---|---|---|---|---|---|\n";
        }
        topic = of;
        writeRow(row, outcome, written);
    }
    const Outcome random =
        outcomeOf(results, [](const TestResult& test) { return test.name.starts_with(kRandomScenes); });
    if (!random.tests.empty()) {
        written.markdown +=
            "\n## Random scenes\n\nScenes of extreme numbers in every stage of the pipeline "
            "(`tests/random_scenes.cpp`): " +
            measuredCell(random) + ". " + (random.holds ? "All invariants hold.\n" : "**Some invariant fails.**\n");
        if (!random.holds) written.failing.push_back("random scenes");
    }
    return written;
}

std::string list(const std::vector<std::string>& words)
{
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all;
}

Expected<void> reportStability(const ReportOptions& options)
{
    if (options.tests.empty()) {
        return fail("report stability: no test program; run ./relief report stability, or name one with --tests");
    }
    const Expected<Results> results = runTests(options);
    if (!results) return tl::unexpected(results.error());
    const Written written = write(*results);

    std::string text = reportHead("Stability", options) + "\n" + std::to_string(results->cases.size()) +
                       " cases: inputs that break a rasterizer that is written the obvious way. " +
                       std::to_string(written.hold) + " hold, " + std::to_string(written.failing.size()) + " fail, " +
                       std::to_string(written.missing) +
                       " are about features that do not exist here. Each is a test that has the case's id in its name: "
                       "`./relief test -R S-301`. This report runs them with ten times the trials. A number without "
                       "bound in brackets is reported, not checked.\n";
    const Expected<std::string> pictures = writeStabilityPictures(options);
    if (!pictures) return tl::unexpected(pictures.error());
    text += written.markdown + *pictures;
    for (const auto& [file, content] :
         {std::pair<const char*, const std::string*>{"stability.md", &text}, {"stability.csv", &written.csv}}) {
        const Expected<void> done = writeReport(options, file, *content);
        if (!done) return done;
    }
    if (!written.failing.empty()) {
        return fail("report stability: " + list(written.failing) + ": a check fails; see " + options.output +
                    "/stability.md");
    }
    std::printf("%s/stability.md and .csv%s\n", options.output.c_str(), pictures->empty() ? "" : ", and its pictures");
    return {};
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv,
                                       {.reportName = "stability", .report = relief::samples::reportStability});
}

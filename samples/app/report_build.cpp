// report build: what compiling costs, in processor seconds and in memory: each file as the build compiles it, one at a
// time and without ccache, and each header of the engine alone. Beside it stands build-before.csv, the same of an
// earlier commit; `--build DIR` measures the build of any.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "common/shell.h"
#include "cost.h"
#include "report.h"

namespace relief::samples {

namespace {

namespace fs = std::filesystem;

struct CompileCost
{
    double seconds = 0.0;  // of the processor, user and system
    double mebibytes = 0.0;
};

// One compilation. `kind` is a folder's, or stage, header or precompiled.
struct Unit
{
    std::string kind, name, command;
    CompileCost cost;
};

constexpr const char* kFolders[][2] = {{"engine/", "engine"},
                                       {"samples/common/", "common"},
                                       {"samples/app/", "app"},
                                       {"samples/check/", "app"},
                                       {"samples/doctor/", "app"},
                                       {"samples/grader/", "app"},
                                       {"samples/trace/", "app"},
                                       {"samples/live/", "live"},
                                       {"samples/view/", "view"},
                                       {"samples/", "stage"},
                                       {"tests/benchmarks/", "benchmarks"},
                                       {"tests/experiments/", "experiments"},
                                       {"tests/", "tests"},
                                       {"assets/", "tests"}};

constexpr const char* kKinds[] = {"precompiled", "engine", "common",     "stage",       "app",   "live",
                                  "view",        "tests",  "benchmarks", "experiments", "header"};

// --- what there is to compile ---

// The value of NAME:TYPE=VALUE.
std::string cached(const fs::path& build, const std::string& name)
{
    std::ifstream cache(build / "CMakeCache.txt");
    for (std::string line; std::getline(cache, line);) {
        if (line.starts_with(name + ":")) return line.substr(line.find('=') + 1);
    }
    return "";
}

// Everything but the name of the file that is written, which becomes `object`.
std::string writingTo(std::string command, const std::string& object)
{
    const std::size_t at = command.find(" -o "), end = command.find(' ', at + 4);
    return at == std::string::npos ? command : command.replace(at, end - at, " -o " + quoted(object));
}

// What follows OPTION, with it.
std::string without(std::string command, const std::string& option)
{
    const std::size_t at = command.find(option), end = command.find(' ', at + option.size());
    return at == std::string::npos ? command : command.erase(at, end - at);
}

// Files that CMake wrote are of little interest, but for the precompiled header, and for tests that are compiled
// together.
std::optional<Unit> unitOf(const nlohmann::json& entry, const std::string& source, const fs::path& build,
                           const std::string& object)
{
    const auto file = entry["file"].get<std::string>();
    const std::string command = "cd " + quoted(entry["directory"].get<std::string>()) + " && exec " +
                                writingTo(entry["command"].get<std::string>(), object);
    if (file.ends_with("cmake_pch.hxx.cxx")) return Unit{"precompiled", "precompiled header", command, {}};
    std::string path = fs::path(file).lexically_relative(source).generic_string();
    if (path.starts_with("build/")) {
        path = fs::path(file).lexically_relative(build).generic_string();
        if (!path.starts_with("tests/")) return std::nullopt;
    }
    for (const auto& [folder, kind] : kFolders) {
        if (!path.starts_with(folder)) continue;
        const std::string stage = path.substr(std::string("samples/").size());
        return Unit{kind, kind == std::string("stage") ? stage.substr(0, stage.size() - 4) : path, command, {}};
    }
    return std::nullopt;
}

// With a stage's options. What needs something before it, as the lanes' instruction sets do, is left out.
std::vector<Unit> headers(const std::vector<Unit>& units, const std::string& source, const fs::path& folder)
{
    const auto stage = std::find_if(units.begin(), units.end(), [](const Unit& u) { return u.kind == "stage"; });
    std::vector<Unit> all;
    if (stage == units.end()) return all;
    std::string compile = without(stage->command, " -include ");
    compile = compile.substr(0, compile.find(" -c "));
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(source) / "engine")) {
        if (entry.path().extension() != ".h" || entry.path().filename().string().starts_with("native_")) continue;
        const std::string name = entry.path().lexically_relative(fs::path(source) / "engine").generic_string();
        std::string file = name;
        std::replace(file.begin(), file.end(), '/', '_');
        const fs::path alone = folder / (file + ".cpp");
        std::ofstream(alone) << "#include \"" << name << "\"\n";
        all.push_back({"header", name, compile + " -c " + quoted(alone.string()), {}});
    }
    return all;
}

Expected<std::vector<Unit>> allUnits(const fs::path& build, const ReportOptions& options, const fs::path& folder)
{
    std::ifstream file(build / "compile_commands.json");
    const nlohmann::json entries = nlohmann::json::parse(file, nullptr, false);
    const std::string source = cached(build, "CMAKE_HOME_DIRECTORY"), built = cached(build, "CMAKE_CACHEFILE_DIR");
    if (entries.is_discarded() || source.empty())
        return fail("--build " + build.string() + ": no configured build; run `./relief report build`");
    std::vector<Unit> units;
    for (const nlohmann::json& entry : entries) {
        if (const std::optional<Unit> unit = unitOf(entry, source, built, (folder / "object").string()))
            units.push_back(*unit);
    }
    const std::vector<Unit> alone = headers(units, source, folder);
    units.insert(units.end(), alone.begin(), alone.end());
    std::erase_if(units, [&](const Unit& u) {
        return !options.only.empty() && std::count(options.only.begin(), options.only.end(), u.kind) == 0;
    });
    if (units.empty()) return fail("report build --only " + options.only[0] + ": there is nothing of this kind");
    std::stable_sort(units.begin(), units.end(), [](const Unit& a, const Unit& b) {
        const auto place = [](const Unit& u) { return std::find(std::begin(kKinds), std::end(kKinds), u.kind); };
        return place(a) != place(b) ? place(a) < place(b) : a.name < b.name;
    });
    return units;
}

// --- measuring ---

std::optional<CompileCost> compiled(const std::string& command)
{
    const pid_t child = fork();
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", ("exec >/dev/null 2>&1; " + command).c_str(), nullptr);
        _exit(127);
    }
    int status = 0;
    rusage used{};
    if (child < 0 || wait4(child, &status, 0, &used) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return std::nullopt;
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
    };
    return CompileCost{seconds(used.ru_utime) + seconds(used.ru_stime), static_cast<double>(used.ru_maxrss) / 1024.0};
}

// The fastest of the rounds: what else runs on the machine only ever adds.
Expected<void> measure(std::vector<Unit>& units, int rounds)
{
    for (std::size_t i = 0; i < units.size(); ++i) {
        Unit& unit = units[i];
        showProgress(std::to_string(i + 1) + " of " + std::to_string(units.size()) + ": " + unit.name);
        for (int round = 0; round < rounds; ++round) {
            const std::optional<CompileCost> cost = compiled(unit.command);
            if (!cost)
                return fail("report build: " + unit.name + " does not compile; run this to see why: " + unit.command);
            if (round == 0 || cost->seconds < unit.cost.seconds) unit.cost = *cost;
        }
    }
    showProgress("");
    return {};
}

// --- the earlier measurement ---

std::vector<Unit> before()
{
    std::vector<Unit> units;
    std::ifstream file(RELIEF_SOURCE_FOLDER "/docs/report/build-before.csv");
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::stringstream cells(line);
        Unit unit;
        std::string seconds, mebibytes;
        std::getline(cells, unit.kind, ',');
        std::getline(cells, unit.name, ',');
        std::getline(cells, seconds, ',');
        std::getline(cells, mebibytes, ',');
        unit.cost = {std::strtod(seconds.c_str(), nullptr), std::strtod(mebibytes.c_str(), nullptr)};
        units.push_back(unit);
    }
    return units;
}

// --- writing ---

struct Sum
{
    std::size_t files = 0;
    CompileCost all;  // the seconds of all files, the memory of the one that takes most
    double median = 0.0, largest = 0.0;
};

Sum sumOf(const std::vector<Unit>& units, const std::string& kind)
{
    Sum sum;
    std::vector<double> seconds;
    for (const Unit& u : units) {
        if (u.kind != kind) continue;
        ++sum.files;
        sum.all.seconds += u.cost.seconds;
        sum.all.mebibytes = std::max(sum.all.mebibytes, u.cost.mebibytes);
        seconds.push_back(u.cost.seconds);
    }
    if (seconds.empty()) return sum;
    sum.median = quartiles(seconds).median;
    sum.largest = *std::max_element(seconds.begin(), seconds.end());
    return sum;
}

std::string cells(const Sum& s)
{
    if (s.files == 0) return " - | - | - | - | - |";
    return " " + std::to_string(s.files) + " | " + text("%.1f", s.all.seconds) + " | " + text("%.2f", s.median) +
           " | " + text("%.2f", s.largest) + " | " + text("%.0f", s.all.mebibytes) + " |";
}

std::string sums(const std::vector<Unit>& now, const std::vector<Unit>& then)
{
    std::string table =
        "| | files | CPU seconds | median | largest | MiB | files before | CPU seconds | median | largest | MiB |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const char* const kind : kKinds)
        table += std::string("| ") + kind + " |" + cells(sumOf(now, kind)) + cells(sumOf(then, kind)) + "\n";
    return table;
}

std::string each(const std::vector<Unit>& now, const std::vector<Unit>& then, const std::string& kind)
{
    std::map<std::string, CompileCost> costs;
    for (const Unit& u : then) {
        if (u.kind == kind) costs[u.name] = u.cost;
    }
    std::string table = "| | CPU seconds | MiB | CPU seconds before | MiB |\n|---|---|---|---|---|\n";
    for (const Unit& u : now) {
        if (u.kind != kind) continue;
        const auto old = costs.find(u.name);
        table += "| " + u.name + " | " + text("%.2f", u.cost.seconds) + " | " + text("%.0f", u.cost.mebibytes) + " | " +
                 (old == costs.end()
                      ? "- | - |\n"
                      : text("%.2f", old->second.seconds) + " | " + text("%.0f", old->second.mebibytes) + " |\n");
    }
    return table;
}

std::string csv(const std::vector<Unit>& units)
{
    std::string lines = "kind,name,cpu_seconds,peak_mib\n";
    for (const Unit& u : units)
        lines +=
            u.kind + "," + u.name + "," + text("%.2f", u.cost.seconds) + "," + text("%.0f", u.cost.mebibytes) + "\n";
    return lines;
}

std::string document(const std::vector<Unit>& now, const std::vector<Unit>& then, const ReportOptions& options)
{
    return reportHead("What compiling costs", options) +
           "\nEach file as the build compiles it, one at a time, without ccache: the processor seconds and the largest "
           "memory of the compiler" +
           (options.rounds > 1 ? ", the fastest of " + std::to_string(options.rounds) : std::string()) +
           ". Of headers: a file that includes this one alone, with a stage's options and nothing precompiled. Before: "
           "commit 0277502, when a stage compiled the whole pipeline with it "
           "([build-before.csv](build-before.csv)).\n\n"
           "![Stages](build.svg)\n\n## In all\n\n" +
           sums(now, then) + "\n## Stages\n\n" + each(now, then, "stage") + "\n## Headers\n\n" +
           each(now, then, "header");
}

Expected<void> measureAndWrite(const ReportOptions& options, const fs::path& folder)
{
    const fs::path build = options.buildFolder.empty() ? RELIEF_BUILD_FOLDER : options.buildFolder;
    Expected<std::vector<Unit>> units = allUnits(build, options, folder);
    if (!units) return tl::unexpected(units.error());
    if (const Expected<void> measured = measure(*units, options.rounds); !measured) return measured;
    const std::string earlier = RELIEF_SOURCE_FOLDER "/docs/report/build-before.csv";
    for (const Expected<void>& written : {writeReport(options, "build.csv", csv(*units)),
                                          writeReport(options, "build.md", document(*units, before(), options)),
                                          plotReport(options, "build", "build", "before=\"" + earlier + "\"")}) {
        if (!written) return written;
    }
    std::printf("%s/build.md, .csv and .svg\n", options.output.c_str());
    return {};
}

Expected<void> reportBuild(const ReportOptions& options)
{
    if (const Expected<void> canPlot = checkPlotting(); !canPlot) return canPlot;
    const fs::path folder = fs::temp_directory_path() / ("relief-build-" + std::to_string(getpid()));
    std::error_code ignored;
    fs::create_directories(folder, ignored);
    const Expected<void> result = measureAndWrite(options, folder);
    fs::remove_all(folder, ignored);
    return result;
}

}  // namespace

}  // namespace relief::samples

int main(int argc, char** argv)
{
    return relief::samples::runProgram(argc, argv, {.reportName = "build", .report = relief::samples::reportBuild});
}

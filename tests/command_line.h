// Runs the programs as a user meets them: what they print, and that bad input gives one line on stderr, exit code 2 and
// no file.
#pragma once

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "live_command.h"

// The program that has the command, as ./relief chooses it; where this build does not have it, the one that knows all
// commands and none of their work.
inline std::string programOf(const std::string& arguments)
{
    const auto has = [&](const char* text) { return arguments.find(text) != std::string::npos; };
    std::string name = "relief";
    if (arguments.starts_with("import-environment")) {
        name = "relief_import_environment";
    } else if (arguments.starts_with("check")) {
        name = "relief_goldens";
    } else if (arguments.starts_with("bench")) {
        name = has("--peer") ? "relief_bench_peer" : has("--stage") ? "relief_bench_stages" : "relief_bench";
    } else if (arguments.starts_with("report")) {
        std::stringstream words(arguments);
        std::string report;
        words >> report >> report;
        std::replace(report.begin(), report.end(), '-', '_');
        name = "relief_report_" + report;
    }
    return std::filesystem::exists(RELIEF_PROGRAMS "/" + name) ? name : "relief_report";
}

// Runs the program in the folder, and leaves nothing there but what the program wrote.
inline Outcome run(const TemporaryFolder& folder, const std::string& arguments, const std::string& environment = "")
{
    Outcome outcome = runCommand(folder, arguments, programOf(arguments), "/dev/null", environment);
    std::filesystem::remove(folder / "out.txt");
    std::filesystem::remove(folder / "err.txt");
    return outcome;
}

// One line, exit code 2, the words in it, and no new file in the folder.
inline void checkRefused(const TemporaryFolder& folder, const std::string& arguments,
                         const std::vector<std::string>& words, const std::string& environment = "")
{
    const auto count = [&] { return std::distance(std::filesystem::recursive_directory_iterator(folder.path), {}); };
    const auto before = count();
    const Outcome outcome = run(folder, arguments, environment);
    CAPTURE(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    for (const std::string& word : words) {
        CAPTURE(word);
        CHECK(outcome.err.find(word) != std::string::npos);
    }
    CHECK(count() == before);
}

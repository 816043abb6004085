// The programs that measure, and the gallery in parts, as a user meets them (command_line.h).
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "command_line.h"
#include "common/stage.h"
#include "relief/texture/image.h"
#include "temporary_folder.h"

namespace fs = std::filesystem;

namespace {

// Whether this machine or this build lacks what a command needs, and it says so.
bool isMissing(const Outcome& outcome)
{
    for (const char* words : {"install gnuplot-nox", "libgl1-mesa-dri", "this program does not do it"}) {
        if (outcome.err.find(words) == std::string::npos) continue;
        CHECK(outcome.code == 2);
        MESSAGE("skipped: " << outcome.err);
        return true;
    }
    return false;
}

}  // namespace

TEST_CASE("command line: the gallery has every picture and a page that names them")
{
    const TemporaryFolder folder;
    REQUIRE(run(folder, "gallery --out g").code == 0);
    const std::string page = contents(folder.path / "g/index.html");
    for (const auto& stage : relief::samples::allStages()) {
        CHECK(fs::exists(folder.path / "g" / stage.folder / (stage.stem + ".png")));
        CHECK(page.find(stage.title) != std::string::npos);
        CHECK(page.find(stage.news) != std::string::npos);
    }

    // In parts: the same files, each picture from one of the parts, none from two.
    std::map<fs::path, std::string> whole, together;
    const auto collect = [&](const fs::path& top, std::map<fs::path, std::string>& files) {
        for (const auto& entry : fs::recursive_directory_iterator(top)) {
            if (!entry.is_regular_file()) continue;
            const bool isNew = files.emplace(fs::relative(entry.path(), top), contents(entry.path())).second;
            CHECK((isNew || entry.path().filename() == "index.html"));
        }
    };
    collect(folder.path / "g", whole);
    for (const std::string part : {"1", "2", "3"}) {
        REQUIRE(run(folder, "gallery --out part" + part + " --shard " + part + "/3").code == 0);
        collect(folder.path / ("part" + part), together);
    }
    CHECK(together == whole);
}

TEST_CASE("command line: bench --peer draws the test scenes beside Mesa, or says what is missing")
{
    const TemporaryFolder folder;
    checkRefused(folder, "bench --peer nobody", {"--peer", "nobody", "mesa"});
    checkRefused(folder, "bench --peer mesa --stage 1.06", {"--peer", "--stage"});
    checkRefused(folder, "bench --peer mesa --rounds 2", {"--rounds"});
    checkRefused(folder, "bench --peer mesa --pairs 0", {"--pairs"});
    checkRefused(folder, "bench --peer mesa --benchmark_filter=x", {"benchmark_filter"});
    checkRefused(folder, "bench --pairs 3", {"--pairs", "--peer"});
    checkRefused(folder, "bench --benchmark_filtre=x", {"benchmark_filtre"});
    checkRefused(folder, "bench --scene clear", {"--scene", "--peer"});
    checkRefused(folder, "bench --alone mesa", {"--peer"});
    checkRefused(folder, "bench --peer mesa --alone nobody", {"nobody"});

    const std::vector<std::string> scenes = {"clear",      "flat_quad",         "trilinear_plane", "anisotropic_plane",
                                             "layers_32",  "small_triangles",   "stage_1.25",      "stage_2.06",
                                             "stage_4.07", "multisampled",      "shadowed",        "reflecting",
                                             "deferred",   "million_triangles", "first_frame"};
    std::string arguments = "bench --peer mesa --size 64x36 --pairs 1";
    for (const std::string& scene : scenes) arguments += " --scene " + scene;
    const Outcome table = run(folder, arguments);
    if (isMissing(table)) return;
    CAPTURE(table.err);
    CHECK(table.code == 0);
    std::stringstream lines(table.out);
    std::string line;
    CHECK((std::getline(lines, line) && line.find("64x36") != std::string::npos));
    CHECK((std::getline(lines, line) && line.find("Mesa / Relief") != std::string::npos));
    for (const std::string& scene : scenes) {
        REQUIRE(std::getline(lines, line));
        CHECK(line.starts_with(scene));
        // The last columns: pixels off edges that only one drew to, pixels of close colours, the largest difference.
        CAPTURE(line);
        std::stringstream columns(line);
        std::vector<std::string> words;
        for (std::string word; columns >> word;) words.push_back(word);
        REQUIRE(words.size() > 3);
        CHECK(words[words.size() - 3] == "0");
        CHECK(std::strtod(words[words.size() - 2].c_str(), nullptr) >= 99.9);
        if (scene == "clear" || scene == "flat_quad" || scene == "layers_32")
            CHECK(line.ends_with("100.0000%       0"));
    }
    CHECK((std::getline(lines, line) && line.starts_with("coverage:")));
    CHECK((std::getline(lines, line) && line.starts_with("first_frame: stage_1.25 at 256x256")));
    CHECK((std::getline(lines, line) && line.find("llvmpipe") != std::string::npos));
    CHECK_FALSE(std::getline(lines, line));

    const Outcome one = run(folder, "bench --peer mesa --size 64x36 --pairs 1 --scene clear --threads 1");
    CHECK(one.code == 0);
    CHECK(one.out.find("threads: 1,") != std::string::npos);
    CHECK(one.out.find("flat_quad") == std::string::npos);
    for (const std::string who : {"relief", "mesa"}) {
        const std::string alone = "bench --peer mesa --size 64x36 --alone " + who;
        CHECK(run(folder, alone + " --scene stage_1.25").out == "drawn\n");
        checkRefused(folder, alone + " --scene stage_1.25", {"/nowhere"}, "RELIEF_ASSETS=/nowhere");
    }
    checkRefused(folder, "bench --peer mesa --scene stage_4.07", {"/nowhere"}, "RELIEF_ASSETS=/nowhere");
    checkRefused(folder, "bench --peer mesa --scene nowhere", {"nowhere", "flat_quad"});
    checkRefused(folder, "bench --peer mesa --threads 17", {"--threads", "16"});
    checkRefused(folder, "bench --peer mesa --size big", {"big"});
    checkRefused(folder, "bench --peer mesa --size 64x36", {"libgl1-mesa-dri"}, "LIBGL_DRIVERS_PATH=/nowhere");
}

TEST_CASE("command line: report triplanar writes a text, a table and a plot")
{
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, "report triplanar --size 64x36 --rounds 1 --output r");
    if (isMissing(outcome)) return;
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out == "r/triplanar.md, .csv and .svg\n");
    CHECK(contents(folder.path / "r/triplanar.svg").find("</svg>") != std::string::npos);

    const std::string text = contents(folder.path / "r/triplanar.md");
    CHECK(text.starts_with("# Triplanar normal mapping: cost and error\n\n    ./relief report triplanar --size 64x36"));
    for (const std::string part :
         {"processor: ", "compiler: ", "commit: ", "not counted", "| 6: ", "| by time |", "## Errors"})
        CHECK(text.find(part) != std::string::npos);

    std::map<std::string, int> rows;
    std::stringstream table(contents(folder.path / "r/triplanar.csv"));
    for (std::string line; std::getline(table, line);) {
        CHECK(std::count(line.begin(), line.end(), ',') == 17);
        CHECK((line.starts_with("table,stage,name,") || line.find(",not counted,") != std::string::npos));
        ++rows[line.substr(0, line.find(','))];
    }
    // Seven methods with a line for each of four tilts and three slopes, and mesh tangents, which have no error.
    CHECK(rows == std::map<std::string, int>{{"table", 1}, {"methods", 85}, {"weights", 9}, {"weights alone", 9}});

    checkRefused(folder, "report triplanar --size 0x0", {"0x0"});
    checkRefused(folder, "report triplanar --size 64x36 --counted-program nothing", {"nothing"});
    checkRefused(folder, "report triplanar --size 64x36 --rounds 1 --output /proc/r", {"/proc/r"});
}

TEST_CASE("command line: report error writes a page, a table and a plot for each experiment")
{
    const TemporaryFolder folder;
    checkRefused(folder, "report triplanar --only E-01", {"--only"});
    checkRefused(folder, "report error --part 0.5", {"--part"});
    const Outcome outcome = run(folder, "report error --only E-01 --rounds 2 --output r");
    if (isMissing(outcome)) return;
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out == "r/error/: 1 experiments\n");
    CHECK(contents(folder.path / "r/error/E-01.svg").find("</svg>") != std::string::npos);
    const std::string text = contents(folder.path / "r/error/E-01.md");
    CHECK(text.starts_with("# E-01 The z of a stored normal\n\n    ./relief report error --rounds 2 --only E-01\n"));
    for (const std::string part : {"processor: ", "compiler: ", "commit: ", "Dominated", "## Against reference values"})
        CHECK(text.find(part) != std::string::npos);
    CHECK(text.find("**does not**") == std::string::npos);

    std::stringstream table(contents(folder.path / "r/error/E-01.csv"));
    int rows = 0;
    for (std::string line; std::getline(table, line); ++rows) {
        CHECK(std::count(line.begin(), line.end(), ',') == 19);
        CHECK(line.starts_with(rows == 0 ? "exp,variant,param,n,err_max," : "E-01,"));
    }
    CHECK(rows == 7);
    checkRefused(folder, "report error --only E-99", {"E-99"});
    checkRefused(folder, "report error --only E-01 --rounds 1 --counted-program nothing", {"nothing"});
}

TEST_CASE("command line: report leave-out counts for every stage what it did not need")
{
    const TemporaryFolder folder;
    checkRefused(folder, "report leave-out --size 96x54 --counted-program relief", {"--switchable-program"});
    checkRefused(folder, "report leave-out --size 0x1", {"0x1"});
    const Outcome outcome = run(folder, "report leave-out --size 96x54 --output r");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out == "r/leave-out.md and .csv\n");
    const std::string text = contents(folder.path / "r/leave-out.md");
    CHECK(text.starts_with("# What was left out\n\n    ./relief report leave-out --size 96x54\n"));
    for (const std::string part : {"commit: ", "Not counted", "| 1.25 Lit scene |", "## What each stage did not need"})
        CHECK(text.find(part) != std::string::npos);
    std::stringstream table(contents(folder.path / "r/leave-out.csv"));
    std::size_t rows = 0;
    for (std::string line; std::getline(table, line); ++rows) CHECK(std::count(line.begin(), line.end(), ',') == 20);
    CHECK(rows == relief::samples::allStages().size() + 1);
}

TEST_CASE("command line: report stability runs the tests of a case and shows what the obvious form draws")
{
    const TemporaryFolder folder;
    const std::string tests = RELIEF_PROGRAMS "/tests/relief_tests";
    const Outcome outcome = run(folder, "report stability --only S-601 --output r --tests '" + tests + "'");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out == "r/stability.md and .csv, and its pictures\n");
    const std::string text = contents(folder.path / "r/stability.md");
    CHECK(text.starts_with("# Stability\n\n    ./relief report stability --only S-601\n"));
    for (const std::string part : {"processor: ", "201 cases", "1 hold, 0 fail", "| S-601 | ", "(2e-07) | holds |",
                                   "not run", "stability/decoding.png"})
        CHECK(text.find(part) != std::string::npos);
    CHECK(relief::readImage(folder.path / "r/stability/decoding.png").has_value());
    const std::string table = contents(folder.path / "r/stability.csv");
    CHECK(table.starts_with("id,verdict,what,value,bound\n"));
    CHECK(table.find("S-601,holds,\"length off 1\",") != std::string::npos);

    checkRefused(folder, "report stability", {"--tests"});
    checkRefused(folder, "report stability --tests /bin/false", {"/bin/false"});
    checkRefused(folder, "report stability --only S-10 --tests '" + tests + "'", {"no test has this id"});
    checkRefused(folder, "report stability --rounds 3 --tests '" + tests + "'", {"--rounds"});
    checkRefused(folder, "report triplanar --only S-601", {"--only"});
}

TEST_CASE("command line: report performance writes a text, a table and a plot")
{
    const TemporaryFolder folder;
    checkRefused(folder, "report performance --part 0", {"--part"});
    checkRefused(folder, "report performance --part 2", {"--part"});
    checkRefused(folder, "report triplanar --part 0.5", {"--part"});
    const std::string small = "report performance --size 64x36 --rounds 1 --part 1e-9";
    const Outcome outcome = run(folder, small + " --output r");
    if (isMissing(outcome)) return;
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out == "r/performance.md, .csv and .svg\n");
    CHECK(contents(folder.path / "r/performance.svg").find("</svg>") != std::string::npos);
    const std::string text = contents(folder.path / "r/performance.md");
    CHECK(
        text.starts_with("# How cost grows\n\n    ./relief report performance --size 64x36 --rounds 1 --part 1e-09\n"));
    for (const std::string part : {"processor: ", "compiler: ", "commit: ", "## Pixels", "## Triangles", "## Lights",
                                   "## The side of a texture", "## Threads", "| stage_1.25 | 1 |"})
        CHECK(text.find(part) != std::string::npos);

    // Two points for each curve; of the threads, each scene with every number.
    std::map<std::string, int> rows;
    std::stringstream table(contents(folder.path / "r/performance.csv"));
    std::string line;
    std::getline(table, line);
    CHECK(line.starts_with("scaling,curve,x,"));
    while (std::getline(table, line)) {
        CAPTURE(line);
        std::vector<std::string> cells;
        std::stringstream words(line + ",");
        for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
        REQUIRE(cells.size() == 16);
        CHECK(std::stoi(cells[6]) >= 1);    // frames: at least one of each round
        CHECK(std::stod(cells[8]) > 0.0);   // ms
        CHECK(std::stod(cells[11]) > 1.0);  // MiB
        CHECK(cells[15].empty() == (cells[0] != "threads"));
        if (cells[0] == "threads" && cells[2] == "1") CHECK(cells[15] == "1.000");
        ++rows[cells[0]];
    }
    CHECK(rows["pixels"] == 2);
    CHECK(rows["triangles"] == 2);
    CHECK(rows["lights"] == 6);
    CHECK(rows["texture"] == 4);
    CHECK(rows["threads"] >= 11);
    CHECK(rows["threads"] % 11 == 0);

    checkRefused(folder, "report performance --size big", {"big"});
    checkRefused(folder, "report performance --counted-program nothing", {"--counted-program"});
    checkRefused(folder, small, {"/nowhere"}, "RELIEF_ASSETS=/nowhere");
}

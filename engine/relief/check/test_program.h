// What the adapters of all test frameworks share: the run of the program, the test of the moment, main()'s order of
// things. A program includes one of doctest.h, gtest.h, catch2.h or main.h, and not this.
#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "relief/check/golden_run.h"
#include "relief/check/tell_pixel.h"

namespace relief::detail {

struct GoldenTests
{
    GoldenRun* run = nullptr;
    std::vector<std::string> test;  // its name, and those of the sections that it is in
    bool isWhole = false;           // every test had its turn
};

inline GoldenTests& goldenTests()
{
    static GoldenTests tests;
    return tests;
}

// A target, or a picture. `part` is of a test with several pictures.
template <class Picture>
Expected<void> checkInTest(const Picture& picture, const std::string& part, const Tolerance& tolerance,
                           const GoldenRun::Tell& tell)
{
    const GoldenTests& tests = goldenTests();
    if (tests.run == nullptr) return fail("golden tests: there is no run; let main() return relief::goldenMain(...)");
    std::string name;
    for (const std::string& word : tests.test) name += (name.empty() ? "" : "/") + word;
    if (name.empty() && part.empty()) return fail("golden tests: outside of a test, a check needs a name");
    if (!part.empty()) name += (name.empty() ? "" : "/") + part;
    return tests.run->check(name, picture, tolerance, tell);
}

inline GoldenRun::Tell tellerOf(Frame& frame)
{
    return [&frame](int x, int y) { return tellPixel(frame, x, y); };
}

// Runs the tests, then says what --update wrote and what nobody used. The framework's exit code, 1 where that has
// failures, 2 where the flag is refused.
template <class RunTests>
int runGoldenTests(int argc, char** argv, GoldenOptions options, const RunTests& runTests)
{
    const Expected<bool> update = takeUpdateFlag(argc, argv);
    if (!update) {
        std::fprintf(stderr, "%s\n", update.error().message.c_str());
        return 2;
    }
    options.update = *update;
    GoldenRun run(std::move(options));
    goldenTests() = {&run, {}, false};
    const int code = runTests(argc, argv);
    const Expected<void> end = run.end(goldenTests().isWhole);
    goldenTests() = {};
    if (!end) std::fprintf(stderr, "%s\n", end.error().message.c_str());
    for (const std::string& golden : run.updated()) std::fprintf(stderr, "updated: %s\n", golden.c_str());
    if (!run.updated().empty()) std::fprintf(stderr, "goldens were rewritten; look at them, and run the tests again\n");
    return code != 0 ? code : end && run.updated().empty() ? 0 : 1;
}

}  // namespace relief::detail

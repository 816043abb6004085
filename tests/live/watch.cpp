// A watched file: every way in which editors write, and what must not count as a change.
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "live/watch.h"
#include "temporary_folder.h"

namespace {

using namespace std::chrono_literals;
using relief::samples::live::Watch;

// What comes within some time, or "".
std::string next(Watch& watch, std::chrono::milliseconds patience = 5000ms)
{
    const auto until = Watch::Clock::now() + patience;
    while (Watch::Clock::now() < until) {
        if (const auto change = watch.poll()) return change->text;
        std::this_thread::sleep_for(2ms);
    }
    return "";
}

}  // namespace

TEST_CASE("live: a watched file is seen however an editor writes it")
{
    for (const bool polling : {false, true}) {
        CAPTURE(polling);
        const TemporaryFolder folder;
        const auto path = folder.write("stage.cpp", "one");
        Watch watch(path.string(), polling);
        CHECK((watch.descriptor() < 0) == polling);
        CHECK(next(watch, 100ms).empty());

        folder.write("stage.cpp", "in place");
        CHECK(next(watch) == "in place");

        std::filesystem::rename(folder.write("stage.cpp~", "renamed over"), path);
        CHECK(next(watch) == "renamed over");

        std::filesystem::remove(path);
        CHECK(next(watch, 150ms).empty());
        folder.write("stage.cpp", "deleted first");
        CHECK(next(watch) == "deleted first");
    }
}

TEST_CASE("live: a touch, an empty file, the same text and another file are no changes")
{
    const TemporaryFolder folder;
    const auto path = folder.write("stage.cpp", "text");
    Watch watch(path.string());
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now());
    CHECK(next(watch, 100ms).empty());
    folder.write("stage.cpp", "text");
    CHECK(next(watch, 100ms).empty());
    folder.write("stage.cpp", "");
    CHECK(next(watch, 100ms).empty());
    folder.write("other.cpp", "other");
    CHECK(next(watch, 100ms).empty());
}

TEST_CASE("live: a file that is written in pieces, or saved twice, is read once and whole")
{
    const TemporaryFolder folder;
    const auto path = folder.write("stage.cpp", "text");
    Watch watch(path.string(), false, 300ms);
    {
        std::ofstream file(path, std::ios::binary);
        for (int i = 0; i < 5; ++i) {
            file << "piece " << std::flush;
            CHECK_FALSE(watch.poll().has_value());
        }
    }
    CHECK(next(watch) == "piece piece piece piece piece ");
    folder.write("stage.cpp", "first");
    CHECK_FALSE(watch.poll().has_value());
    folder.write("stage.cpp", "second");
    CHECK(next(watch) == "second");
    CHECK(next(watch, 500ms).empty());
}

#include "view/stage_list.h"

#include <filesystem>

#include <doctest/doctest.h>

using namespace relief::samples;

TEST_CASE("view: the list of stages has titles, lessons, pages and pictures, and finds words")
{
    REQUIRE(listedStages().size() >= 56);
    int found = 0;
    for (const Listed& stage : listedStages()) {
        CAPTURE(stage.source.id);
        CHECK_FALSE(stage.title.empty());
        CHECK(stage.title.find('_') == std::string::npos);
        CHECK_FALSE(stage.news.empty());
        CHECK(std::filesystem::exists(pageOf(stage.source)));
        CHECK(std::filesystem::exists(goldenOf(stage.source)));
        CHECK(matches(stage, ""));
        found += matches(stage, "BUMP scale") ? 1 : 0;
    }
    CHECK(found >= 1);
    CHECK(found < 10);
    CHECK(matches(listedStages().front(), "0.01 triangle"));
    CHECK_FALSE(matches(listedStages().front(), "triangle triplanar"));
}

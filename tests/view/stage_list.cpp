#include "view/stage_list.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "view/control.h"

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

TEST_CASE("view: the control that fits a property")
{
    using Kind = Control::Kind;
    const auto kind = [](const Property& p) { return controlOf(p).kind; };
    CHECK(kind({"tint", glm::vec4(1.0f), 0.0f, 1.0f, 4, ""}) == Kind::color);
    CHECK(kind({"ambient", glm::vec4(1.0f), 0.0f, 1.0f, 3, ""}) == Kind::color);
    CHECK(kind({"mainTex_ST", glm::vec4(1.0f), -16.0f, 16.0f, 4, ""}) == Kind::vector);
    CHECK(kind({"smoothness", glm::vec4(0.0f), 0.0f, 1.0f, 1, ""}) == Kind::number);
    CHECK(kind({"exact", glm::vec4(0.0f), 0.0f, 1.0f, 1, ""}) == Kind::tick);
    CHECK(kind({"weights", glm::vec4(0.0f), 0.0f, 9.0f, 1, "0: side by side; 1 to 9: one"}) == Kind::whole);
    const Control choice =
        controlOf({"show", glm::vec4(0.0f), 0.0f, 2.0f, 1, "0: both, 1: GPU Gems 3, 2: the difference"});
    CHECK(choice.kind == Kind::choice);
    CHECK(choice.names == std::vector<std::string>{"both", "GPU Gems 3", "the difference"});
    CHECK(kind({"half", glm::vec4(0.0f), 0.0f, 2.0f, 1, "0: both, 1: one"}) == Kind::number);
}

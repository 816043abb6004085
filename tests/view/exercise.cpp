// The window of an exercise's file: goal, own picture and difference beside each other, until they are the same.
#include <fstream>

#include "hands.h"
#include "live/toolchain.h"
#include "relief/file.h"

using namespace relief;
using namespace relief::samples;

TEST_CASE("view: an exercise's file stands beside its goal, and the difference goes when it is solved")
{
    const TemporaryFolder folder;
    const std::string answer = *readText(live::sampleFolder() + "/exercises/1.08a_along_v/answer/answer.cpp");
    std::string wrong = answer;
    wrong.replace(wrong.find("(v1 - v2)"), 9, "(v2 - v1)");
    const std::string path = folder.write("1.08a_mine.cpp", wrong).string();
    const Hands hands(path);
    Viewer& viewer = hands.viewer();
    REQUIRE(viewer.hasGoal());
    REQUIRE(hands.until([&] { return viewer.showsGrid(); }));
    hands.settle();
    CHECK(viewer.besideName() == "goal");
    const int width = viewer.picture().width, height = viewer.picture().height;
    CHECK(viewer.shown().width == 2 * width);
    CHECK(viewer.shown().height == 2 * height);
    CHECK(viewer.shown().at(10, 20) == viewer.besidePicture().at(10, 20));
    CHECK(viewer.shown().at(width + 50, 30) == viewer.picture().at(50, 30));
    CHECK(viewer.shown().at(50, height + 30) == viewer.difference().picture.at(50, 30));
    CHECK(viewer.difference().pixels > 0);
    hands.drag("picture", 30.0f, 10.0f);  // the goal turns with it
    hands.settle();
    CHECK(viewer.canCompare());

    std::ofstream(path) << answer;
    CHECK(hands.until([&] { return viewer.canCompare() && viewer.difference().pixels == 0; }));
    hands.choose("beside", "beside.nothing");
    CHECK(viewer.shown().colors == viewer.picture().colors);
    hands.choose("beside", "beside.goal");
    CHECK(hands.until([&] { return viewer.showsGrid(); }));
    hands.click("compare.divider", 0.1f);
    CHECK(viewer.showsDivider());
}

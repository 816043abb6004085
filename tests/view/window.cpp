// What stands in the window, and when it is drawn.
#include "hands.h"
#include "live/new_stage.h"

using namespace relief;
using namespace relief::samples;

namespace {

std::string ownStage(const TemporaryFolder& folder)
{
    const std::string path = (folder / "my_shader.cpp").string();
    REQUIRE(live::writeNewStage(path, ""));
    return path;
}

}  // namespace

TEST_CASE("view: the picture stands in the window byte for byte, and nothing covers it")
{
    const TemporaryFolder folder;
    const Hands hands(ownStage(folder), "960x540");
    hands.move(10.0f, 700.0f);
    const Hands::Place p = hands.place("picture");
    const Pixels& picture = hands.viewer().picture();
    REQUIRE(p.right - p.left == static_cast<float>(picture.width));
    REQUIRE(p.bottom - p.top == static_cast<float>(picture.height));
    const Pixels all = hands.application->window.contents();
    int different = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const std::uint32_t there = all.at(static_cast<int>(p.left) + x, static_cast<int>(p.top) + y);
            different += (there | 0xff000000u) != (picture.at(x, y) | 0xff000000u) ? 1 : 0;
        }
    }
    CHECK(different == 0);
}

TEST_CASE("view: nothing is drawn while nothing happens")
{
    const TemporaryFolder folder;
    const Hands hands(ownStage(folder));
    hands.settle();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    int drawn = 0, turns = 0;
    for (; std::chrono::steady_clock::now() < end; ++turns) {
        hands.application->wait();
        drawn += hands.application->step() ? 1 : 0;
    }
    CHECK(drawn == 0);
    CHECK(turns < 20);  // a look at the file twice a second
}

TEST_CASE("view: a session's news wakes the window")
{
    const TemporaryFolder folder;
    const std::string path = ownStage(folder);
    const Hands hands(path);
    std::ofstream(path, std::ios::app) << "// again\n";
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (hands.viewer().session().picture().version < 2 && std::chrono::steady_clock::now() < end) {
        hands.application->wait();
        hands.application->step();
    }
    CHECK(hands.viewer().session().picture().version == 2);
}

TEST_CASE("view: an error stands over the last good picture")
{
    const TemporaryFolder folder;
    const std::string path = ownStage(folder), text = contents(path);
    const Hands hands(path);
    const std::vector<std::uint32_t> good = hands.viewer().picture().colors;
    std::ofstream(path) << text << "}\n";
    REQUIRE(hands.until([&] { return hands.viewer().session().problem() != nullptr; }));
    hands.settle();
    CHECK(hands.has("problem"));
    CHECK(hands.viewer().picture().colors == good);
    hands.click("property.tiling", 0.6f);  // and it can still be changed
    CHECK(hands.viewer().picture().colors != good);
    std::ofstream(path) << text;
    REQUIRE(hands.until([&] { return hands.viewer().session().problem() == nullptr; }));
    hands.settle();
    CHECK_FALSE(hands.has("problem"));
}

TEST_CASE("view: a larger window has a larger picture, where it is to follow")
{
    const TemporaryFolder folder;
    const Hands hands(ownStage(folder), RenderOptions().size);
    CHECK(hands.viewer().picture().width == 960);
    SDL_SetWindowSize(SDL_GetWindowFromID(1), 1600, 1000);
    REQUIRE(hands.until([&] { return hands.viewer().picture().width == 1280; }));
    CHECK(hands.viewer().picture().height == 720);
    SDL_SetWindowSize(SDL_GetWindowFromID(1), 600, 400);
    REQUIRE(hands.until([&] { return hands.viewer().picture().width == 280; }));
}

TEST_CASE("view: bad input is one line, before there is a window")
{
    ViewOptions options;
    options.render.stage = "9.99";
    CHECK_FALSE(Application::open(options));
    options.render.stage = "1.12";
    options.render.camera = "0,1,0";
    CHECK_FALSE(Application::open(options));
}

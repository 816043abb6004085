#include "relief/path.h"

#include <doctest/doctest.h>

using namespace relief;

TEST_CASE("path: an ending is known in letters of either case, and by nothing but the end")
{
    CHECK(hasEnding("map.png", {".jpg", ".png"}));
    CHECK(hasEnding("Map.PNG", {".png"}));
    CHECK(hasEnding(".png", {".png"}));
    CHECK_FALSE(hasEnding("png", {".png"}));
    CHECK_FALSE(hasEnding("map.png.cpp", {".png"}));
    CHECK_FALSE(hasEnding("mapNpng", {".png"}));
    CHECK_FALSE(hasEnding("", {".png"}));
}

TEST_CASE("path: names go there and back beyond ASCII")
{
    CHECK(utf8Of(pathOf("äα.png")) == "äα.png");
    CHECK(utf8Of(pathOf("äα.png").extension()) == ".png");
}

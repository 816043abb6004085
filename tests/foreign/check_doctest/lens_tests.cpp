#define RELIEF_CHECK_MAIN
#include <relief/check/doctest.h>
#include <relief/relief.h>

#include "lens.h"

TEST_CASE("orange")
{
    relief::Framebuffer target = *relief::Framebuffer::create(64, 64);
    relief::Frame frame(target);
    frame.clear({1, 0.5f, 0, 1});
    frame.run();
    relief::expectGolden(target);
}

TEST_CASE("lens")
{
    relief::Framebuffer target = *relief::Framebuffer::create(64, 64);
    relief::Frame frame(target);
    const relief::Mesh quad = lens::quad();
    SUBCASE("white light")
    {
        lens::draw(frame, quad, {1, 1, 1});
        relief::expectGolden(target, frame);
    }
    SUBCASE("red light")
    {
        lens::draw(frame, quad, {1, 0, 0});
        relief::expectGolden(target, frame);
    }
}

TEST_CASE("floats")
{
    relief::Framebuffer target = *relief::Framebuffer::create(64, 64, relief::Format::rgba32f);
    relief::Frame frame(target);
    const relief::Mesh quad = lens::quad();
    lens::draw(frame, quad, {1, 1, 1});
    relief::expectGolden(target, "exact");

    // As if from another machine: four pixels differ, three or four floats further.
    for (std::size_t i = 0; i < 4; ++i) target.color32f()[32 * 64 + 16 + 8 * i].x *= 1.0000002f;
    relief::expectGolden(target, "measured", {.pixels = {4, 4}, .largest = {3, 4}, .window8x8 = 1});
}

int main(int argc, char** argv)
{
    return relief::goldenMain(argc, argv, {.goldens = GOLDENS});
}

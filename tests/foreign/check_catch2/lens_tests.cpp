#define RELIEF_CHECK_MAIN
#include <relief/check/catch2.h>
#include <relief/relief.h>

TEST_CASE("orange")
{
    relief::Framebuffer target = *relief::Framebuffer::create(64, 64);
    relief::Frame frame(target);
    frame.clear({1, 0.5f, 0, 1});
    frame.run();
    relief::expectGolden(target);
}

TEST_CASE("colours", "[slow]")
{
    relief::Framebuffer target = *relief::Framebuffer::create(32, 32);
    relief::Frame frame(target);
    SECTION("blue")
    {
        frame.clear({0, 0, 1, 1});
        frame.run();
        relief::expectGolden(target);
    }
    SECTION("green")
    {
        frame.clear({0, 1, 0, 1});
        frame.run();
        relief::expectGolden(target);
    }
}

TEST_CASE("hidden", "[.]")  // its golden is not unused
{
}

int main(int argc, char** argv)
{
    return relief::goldenMain(argc, argv, {.goldens = GOLDENS});
}

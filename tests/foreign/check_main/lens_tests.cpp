#include <relief/check/main.h>
#include <relief/relief.h>

void orange()
{
    relief::Framebuffer target = *relief::Framebuffer::create(64, 64);
    relief::Frame frame(target);
    frame.clear({1, 0.5f, 0, 1});
    frame.run();
    relief::expectGolden("orange", target, frame);
}

int main(int argc, char** argv)
{
    return relief::goldenMain(argc, argv, {.goldens = GOLDENS}, [] { orange(); });
}

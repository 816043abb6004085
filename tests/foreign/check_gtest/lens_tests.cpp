#include <relief/check/gtest.h>
#include <relief/relief.h>

TEST(Clear, Orange)
{
    relief::Framebuffer target = *relief::Framebuffer::create(64, 64);
    relief::Frame frame(target);
    frame.clear({1, 0.5f, 0, 1});
    frame.run();
    relief::expectGolden(target);
}

TEST(Clear, DISABLED_Green)  // its golden is not unused
{
}

// A picture of any program: four channels of 8 bits.
TEST(Picture, Gradient)
{
    relief::Image8 picture{16, 8, {}};
    for (int i = 0; i < 16 * 8; ++i) {
        for (const int channel : {i, 255 - i, 128, 255}) picture.pixels.push_back(static_cast<std::uint8_t>(channel));
    }
    relief::expectGolden(picture, "upright");
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4) picture.pixels[i] ^= 1;
    relief::expectGolden(picture, "flipped bit");
}

int main(int argc, char** argv)
{
    return relief::goldenMain(argc, argv, {.goldens = GOLDENS});
}

// The small print of a picture: rectangles and text in whole pixels, over all that is drawn. It is a mesh and goes
// through the pipeline, so it works on any format and has the same bits everywhere. It does so in a frame of its own,
// afterwards: what is counted, hashed and looked into is the stage's alone.
#pragma once

#include <string>
#include <string_view>

#include "common/ramp.h"
#include "relief/mesh/text.h"
#include "relief/relief.h"

namespace relief::samples {

// How many pixels wide and high a pixel of the font is, in a picture of this size: 1 up to 639 x 539, 2 from there on.
int textScale(int width, int height);

// A number in few letters: four digits, "0.9873", "1.5e-05".
std::string shortNumber(float number);

inline constexpr SrgbCode kInk = {255, 244, 224};

// A few words about a part of the picture: what it shows.
struct Label
{
    std::string text;
    Rectangle cell;  // in its upper left corner
    bool isScale;    // or in its middle, over the scale at its lower edge (false_color.h)
};

class Overlay
{
public:
    // Later ones lie over earlier ones. Opacity is 0 ... 1, of linear light.
    void rectangle(const Rectangle& pixels, const SrgbCode& color, float opacity = 1.0f);

    // Its upper left corner at (x, y).
    void text(int x, int y, int scale, std::string_view text, const SrgbCode& color = kInk);

    // On a dark ground, which is legible over everything; in lines as long as its cell allows.
    void label(const Label& label, int scale);

    // Onto what the target holds.
    void draw(Framebuffer& target) const;

    static constexpr int kPadding = 3;  // pixels of the font

private:
    Mesh mesh;  // positions in pixels
};

}  // namespace relief::samples

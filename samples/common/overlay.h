// The small print of a picture: rectangles and text in whole pixels, over all that is drawn. It is a mesh and goes
// through the pipeline as a draw of its own, so it is there wherever a frame is: in any format, in the window, in a
// golden, and with the same bits.
#pragma once

#include <string_view>

#include "common/ramp.h"
#include "mesh/text.h"
#include "relief.h"

namespace relief::samples {

// How many pixels wide and high a pixel of the font is, in a picture of this size: 1 up to 639 x 539, 2 from there on.
int textScale(int width, int height);

inline constexpr SrgbCode kInk = {255, 244, 224};

class Overlay
{
public:
    // Later ones lie over earlier ones. Opacity is 0 ... 1, of linear light.
    void rectangle(const Rectangle& pixels, const SrgbCode& color, float opacity = 1.0f);

    // Its upper left corner at (x, y).
    void text(int x, int y, int scale, std::string_view text, const SrgbCode& color = kInk);

    // Text on a dark ground that is as large as it needs: legible over everything.
    void label(int x, int y, int scale, std::string_view text);

    // As the next draw of the frame, onto a target of this size. The overlay must live until the frame has run.
    void draw(Frame& frame, int width, int height) const;

    // Of a label, in pixels.
    static int labelWidth(std::string_view text, int scale) { return (textWidth(text) + 2 * kPadding) * scale; }
    static int labelHeight(int scale) { return (kLetterHeight + 2 * kPadding) * scale; }

    static constexpr int kPadding = 3;  // pixels of the font
    static constexpr float kGround = 0.9f;

private:
    Mesh mesh;  // positions in pixels
};

}  // namespace relief::samples

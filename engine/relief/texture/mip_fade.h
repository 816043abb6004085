// Mip levels that fade out to grey. What enters is the number of a level and its texels; what leaves are the texels on
// their way to grey, exactly grey at the end of it.
#pragma once

#include "relief/texture/color_space.h"
#include "relief/texture/mip_chain.h"

namespace relief {

inline constexpr int kGreyCode = 128;  // of 255: one half, rounded up as UNORM does

// step / span of the way, 0 <= step <= span: nothing up to level `first`, all from level `last` on, evenly between.
struct Fade
{
    int step = 0;
    int span = 1;
};

// 0 <= first <= last. Where they are equal, that level is the first grey one.
Fade fadeOfLevel(int level, int first, int last);

// Moves red, green and blue towards grey, frame included; alpha stays. Codes go to kGreyCode (in 16 bits: times 257),
// rounded to nearest, floats to one half. rgba16 of srgb meaning holds linear light: its codes are what is moved. For
// other formats the meaning makes no difference.
void fadeToGrey(TexelFormat format, ColorSpace meaning, MipLevel& level, Fade fade);

}  // namespace relief

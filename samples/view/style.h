// How the window looks: colours that the colour-blind can tell apart (Okabe and Ito's blue, orange and vermilion, and
// never a colour alone: a word or a mark goes with it), and letters.
#pragma once

#include <cstdint>

#include "view/window.h"

namespace relief::samples {

// As Dear ImGui packs them: red in the lowest byte.
inline constexpr std::uint32_t kBlue = 0xffe9b456, kOrange = 0xff009fe6, kVermilion = 0xff4a8cff, kDim = 0xff9c9a94,
                               kBright = 0xffeeeeee;

void applyStyle(float scale);
Fonts loadFonts(float scale);

}  // namespace relief::samples

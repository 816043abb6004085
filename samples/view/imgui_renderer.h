// Draws what Dear ImGui wants drawn, with SDL's own renderer: triangles with a texture, cut to rectangles.
#pragma once

#include <vector>

struct ImDrawData;
struct SDL_Renderer;

namespace relief::samples {

void drawInterface(SDL_Renderer* renderer, const ImDrawData& data);

// All that drawInterface() would draw: with equal bytes, and textures that did not change, it is the same picture.
std::vector<unsigned char> interfaceBytes(const ImDrawData& data);

}  // namespace relief::samples

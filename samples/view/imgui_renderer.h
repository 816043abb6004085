// Draws what Dear ImGui wants drawn, with SDL's own renderer: triangles with a texture, cut to rectangles.
#pragma once

struct ImDrawData;
struct SDL_Renderer;

namespace relief::samples {

void drawInterface(SDL_Renderer* renderer, const ImDrawData& data);

}  // namespace relief::samples

#include "view/imgui_renderer.h"

#include <SDL.h>

#include <imgui.h>

namespace relief::samples {

void drawInterface(SDL_Renderer* renderer, const ImDrawData& data)
{
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImVec4& clip = command.ClipRect;
            const SDL_Rect rectangle = {static_cast<int>(clip.x - data.DisplayPos.x),
                                        static_cast<int>(clip.y - data.DisplayPos.y), static_cast<int>(clip.z - clip.x),
                                        static_cast<int>(clip.w - clip.y)};
            if (command.UserCallback != nullptr || SDL_RectEmpty(&rectangle) == SDL_TRUE) continue;
            SDL_RenderSetClipRect(renderer, &rectangle);
            const ImDrawVert* const first = list.VtxBuffer.Data + command.VtxOffset;
            SDL_RenderGeometryRaw(
                renderer, static_cast<SDL_Texture*>(command.GetTexID()), &first->pos.x, sizeof(ImDrawVert),
                reinterpret_cast<const SDL_Color*>(&first->col), sizeof(ImDrawVert), &first->uv.x, sizeof(ImDrawVert),
                list.VtxBuffer.Size - static_cast<int>(command.VtxOffset), list.IdxBuffer.Data + command.IdxOffset,
                static_cast<int>(command.ElemCount), sizeof(ImDrawIdx));
        }
    }
    SDL_RenderSetClipRect(renderer, nullptr);
}

}  // namespace relief::samples

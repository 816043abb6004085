#include "view/imgui_renderer.h"

#include <cmath>

#include <SDL.h>

#include <imgui.h>

namespace relief::samples {

namespace {

// Whether the first two triangles are a rectangle of whole pixels in one colour that hides all: a window's background.
// SDL would blend it, pixel by pixel, which takes longer than all the rest.
bool isBackground(const ImDrawVert* vertices, const ImDrawIdx* indices, SDL_FRect& rectangle)
{
    const ImDrawVert &a = vertices[indices[0]], &b = vertices[indices[1]], &c = vertices[indices[2]],
                     &d = vertices[indices[5]];
    const auto looksLike = [&a](const ImDrawVert& v) { return v.col == a.col && v.uv.x == a.uv.x && v.uv.y == a.uv.y; };
    const auto isWhole = [](float x) { return x == std::floor(x); };
    rectangle = {a.pos.x, a.pos.y, c.pos.x - a.pos.x, c.pos.y - a.pos.y};
    return indices[3] == indices[0] && indices[4] == indices[2] && looksLike(b) && looksLike(c) && looksLike(d) &&
           (a.col & IM_COL32_A_MASK) == IM_COL32_A_MASK && b.pos.x == c.pos.x && b.pos.y == a.pos.y &&
           d.pos.x == a.pos.x && d.pos.y == c.pos.y && isWhole(a.pos.x) && isWhole(a.pos.y) && isWhole(c.pos.x) &&
           isWhole(c.pos.y) && rectangle.w > 0.0f && rectangle.h > 0.0f;
}

}  // namespace

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
            const ImDrawIdx* indices = list.IdxBuffer.Data + command.IdxOffset;
            auto count = static_cast<int>(command.ElemCount);
            SDL_FRect background;
            if (count >= 6 && isBackground(first, indices, background)) {
                const auto* const color = reinterpret_cast<const SDL_Color*>(&first[indices[0]].col);
                SDL_SetRenderDrawColor(renderer, color->r, color->g, color->b, 255);
                SDL_RenderFillRectF(renderer, &background);
                indices += 6;
                count -= 6;
            }
            SDL_RenderGeometryRaw(
                renderer, static_cast<SDL_Texture*>(command.GetTexID()), &first->pos.x, sizeof(ImDrawVert),
                reinterpret_cast<const SDL_Color*>(&first->col), sizeof(ImDrawVert), &first->uv.x, sizeof(ImDrawVert),
                list.VtxBuffer.Size - static_cast<int>(command.VtxOffset), indices, count, sizeof(ImDrawIdx));
        }
    }
    SDL_RenderSetClipRect(renderer, nullptr);
}

std::vector<unsigned char> interfaceBytes(const ImDrawData& data)
{
    std::vector<unsigned char> bytes;
    const auto add = [&bytes](const void* values, std::size_t size) {
        const auto* const first = static_cast<const unsigned char*>(values);
        bytes.insert(bytes.end(), first, first + size);
    };
    add(&data.DisplayPos, sizeof data.DisplayPos);
    add(&data.DisplaySize, sizeof data.DisplaySize);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImTextureID texture = command.GetTexID();
            add(&command.ClipRect, sizeof command.ClipRect);
            add(&texture, sizeof texture);
            add(&command.ElemCount, sizeof command.ElemCount);
        }
        add(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
        add(list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()));
    }
    return bytes;
}

}  // namespace relief::samples

#include "view/style.h"

#include <cmath>
#include <initializer_list>

#include <imgui.h>
#include <unistd.h>

namespace relief::samples {

namespace {

ImVec4 grey(float level, float alpha = 1.0f)
{
    return {level, level * 1.02f, level * 1.06f, alpha};
}

// The first file that is there; else Dear ImGui's own letters, which are small and square.
ImFont* firstOf(std::initializer_list<const char*> paths, float size, float scale)
{
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    for (const char* const path : paths) {
        if (::access(path, R_OK) != 0) continue;
        if (ImFont* const font = atlas.AddFontFromFileTTF(path, std::round(size * scale))) return font;
    }
    ImFontConfig config;
    config.SizePixels = 13.0f * std::round(scale);
    return atlas.AddFontDefault(&config);
}

}  // namespace

void applyStyle(float scale)
{
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = style.ChildRounding = style.PopupRounding = 6.0f;
    style.FrameRounding = style.GrabRounding = style.TabRounding = 4.0f;
    style.WindowPadding = ImVec2(10.0f, 10.0f);
    style.FramePadding = ImVec2(7.0f, 4.0f);
    style.ItemSpacing = ImVec2(7.0f, 6.0f);
    style.CellPadding = ImVec2(4.0f, 2.0f);
    style.GrabMinSize = 12.0f;
    style.ScrollbarSize = 12.0f;
    style.WindowBorderSize = 1.0f;
    const ImVec4 accent = {0.17f, 0.44f, 0.66f, 1.0f}, brighter = {0.22f, 0.53f, 0.78f, 1.0f};
    const struct
    {
        ImGuiCol where;
        ImVec4 color;
    } colors[] = {{ImGuiCol_WindowBg, grey(0.115f)},
                  {ImGuiCol_ChildBg, grey(0.115f, 0.0f)},
                  {ImGuiCol_PopupBg, grey(0.14f, 0.98f)},
                  {ImGuiCol_Border, grey(0.25f)},
                  {ImGuiCol_Text, grey(0.90f)},
                  {ImGuiCol_TextDisabled, grey(0.58f)},
                  {ImGuiCol_FrameBg, grey(0.19f)},
                  {ImGuiCol_FrameBgHovered, grey(0.24f)},
                  {ImGuiCol_FrameBgActive, grey(0.28f)},
                  {ImGuiCol_Button, grey(0.22f)},
                  {ImGuiCol_ButtonHovered, accent},
                  {ImGuiCol_ButtonActive, brighter},
                  {ImGuiCol_Header, grey(0.19f)},
                  {ImGuiCol_HeaderHovered, grey(0.25f)},
                  {ImGuiCol_HeaderActive, accent},
                  {ImGuiCol_SliderGrab, {0.20f, 0.50f, 0.74f, 1.0f}},
                  {ImGuiCol_SliderGrabActive, brighter},
                  {ImGuiCol_CheckMark, {0.34f, 0.71f, 0.91f, 1.0f}},
                  {ImGuiCol_Tab, grey(0.16f)},
                  {ImGuiCol_TabHovered, brighter},
                  {ImGuiCol_TabActive, accent},
                  {ImGuiCol_PlotLines, {0.34f, 0.71f, 0.91f, 1.0f}},
                  {ImGuiCol_PlotHistogram, {0.34f, 0.71f, 0.91f, 1.0f}},
                  {ImGuiCol_TitleBgActive, accent},
                  {ImGuiCol_ModalWindowDimBg, grey(0.0f, 0.45f)},
                  {ImGuiCol_Separator, grey(0.25f)}};
    for (const auto& [where, color] : colors) style.Colors[where] = color;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

Fonts loadFonts(float scale)
{
    ImGui::GetIO().Fonts->Clear();
    Fonts fonts;
    fonts.text = firstOf({"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                          "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                          "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"},
                         14.0f, scale);
    fonts.title =
        firstOf({"/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf", "/usr/share/fonts/TTF/DejaVuSans-Bold.ttf",
                 "/usr/share/fonts/truetype/liberation/LiberationSans-Bold.ttf",
                 "/usr/share/fonts/truetype/noto/NotoSans-Bold.ttf"},
                17.0f, scale);
    fonts.code =
        firstOf({"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", "/usr/share/fonts/TTF/DejaVuSansMono.ttf",
                 "/usr/share/fonts/truetype/liberation/LiberationMono-Regular.ttf",
                 "/usr/share/fonts/truetype/noto/NotoSansMono-Regular.ttf"},
                14.0f, scale);
    return fonts;
}

}  // namespace relief::samples

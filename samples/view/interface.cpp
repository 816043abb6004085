#include "view/interface.h"

#include <SDL.h>

#include <imgui.h>
#include <imgui_internal.h>

#include "view/style.h"

namespace relief::samples {

Interface::Interface(Viewer& itsViewer, Window& itsWindow) : viewer(itsViewer), window(itsWindow) {}

void Interface::place(const std::string& name)
{
    if (!ImGui::IsItemVisible()) return;
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    places[name] = {low.x, low.y, high.x, high.y};
}

void Interface::tooltip(const std::string& text) const
{
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(points(360.0f));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool Interface::button(const char* label, const std::string& name, const char* meaning)
{
    const bool pressed = ImGui::Button(label);
    place(name);
    if (meaning != nullptr) tooltip(meaning);
    return pressed;
}

void Interface::draw()
{
    if (closeLists) ImGui::ClosePopupToLevel(0, true);
    closeLists = false;
    places.clear();
    thumbnailsWanted = false;
    thumbnailBudget = 3;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0.0f, 0.0f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0f, 0.0f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
    ImGui::Begin("window", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus |
                     ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar(3);
    const float status = ImGui::GetFrameHeight() + points(8.0f);
    const auto part = [&](const char* name, ImVec2 extent, ImVec2 padding, auto contents) {
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
        ImGui::BeginChild(name, extent, false,
                          ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                              ImGuiWindowFlags_NoScrollWithMouse);
        ImGui::PopStyleVar();
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(points(7.0f), points(6.0f)));
        contents();
        ImGui::PopStyleVar();
        ImGui::EndChild();
    };
    const ImVec2 padding(points(10.0f), points(8.0f));
    if (panelShown) {
        part("panel", ImVec2(points(320.0f), size.y), padding, [&] { panel(); });
        ImGui::SameLine();
    }
    ImGui::BeginGroup();
    const float line = ImGui::GetFrameHeight() + points(6.0f);
    const int lines = toolbarLines + (viewer.besideKind() != Viewer::Beside::nothing ? 1 : 0);
    const float above = static_cast<float>(lines) * line + points(10.0f);
    part("toolbar", ImVec2(0.0f, above), ImVec2(padding.x, points(8.0f)), [&] { toolbar(); });
    part("picture", ImVec2(0.0f, size.y - above - status), ImVec2(0.0f, 0.0f), [&] { pictureArea(); });
    part("status", ImVec2(0.0f, status), ImVec2(padding.x, points(4.0f)), [&] { this->status(); });
    ImGui::EndGroup();
    ImGui::End();
    ImGui::PopStyleVar();
    dialogs();
}

bool Interface::update()
{
    if (newScale) window.setScale(*newScale);
    newScale.reset();
    const bool news = std::max(updatePixel(), updateDoctor());
    if (!turn || dialog != Dialog::recording) return news;
    const Expected<void> written = turn->update(viewer);
    if (written && !turn->done()) return news;
    notice = written ? "Wrote " + std::to_string(turn->frames) + " pictures into " + turnFolder : "";
    if (!written) viewer.refusal = written.error().message;
    turn->end(viewer);
    turn.reset();
    dialog = Dialog::none;
    return true;
}

void Interface::take(const SDL_Event& event)
{
    const ImGuiIO& io = ImGui::GetIO();
    if (event.type == SDL_QUIT) running = false;
    if (event.type == SDL_DROPFILE) {
        droppedFiles.emplace_back(event.drop.file);
        SDL_free(event.drop.file);
        if (dialog == Dialog::none) dialog = Dialog::drop;
    }
    if (event.type == SDL_KEYDOWN || event.type == SDL_MOUSEBUTTONDOWN) notice.clear();
    if (event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) magnifying = false;
    if (event.type == SDL_KEYUP && event.key.keysym.sym == SDLK_m) magnifying = false;
    if (event.type != SDL_KEYDOWN || (io.WantTextInput && event.key.keysym.sym != SDLK_ESCAPE)) return;
    const bool listOpen = dialog == Dialog::none && ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    if (listOpen && event.key.keysym.sym == SDLK_ESCAPE) {
        closeLists = true;
        return;
    }
    const Uint16 held = event.key.keysym.mod;
    press(event.key.keysym.sym, (held & (KMOD_CTRL | KMOD_GUI)) != 0, (held & KMOD_SHIFT) != 0);
}

}  // namespace relief::samples

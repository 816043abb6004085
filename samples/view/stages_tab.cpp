// The panel's second tab: chapters and stages, with their pictures, and a search.
#include <algorithm>
#include <cmath>
#include <utility>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "view/interface.h"
#include "view/stage_list.h"
#include "view/style.h"

namespace relief::samples {

// The golden picture, small; a few are read in each frame, so that the window never waits for all of them.
void Interface::thumbnail(const live::StageSource& source, float width, float height)
{
    const std::string file = goldenOf(source);
    auto found = thumbnails.find(file);
    if (found == thumbnails.end() && thumbnailBudget > 0) {
        --thumbnailBudget;
        found = thumbnails.try_emplace(file).first;
        if (const Expected<Pixels> golden = readPixels(file)) {
            const auto columns = static_cast<int>(std::lround(width)), rows = static_cast<int>(std::lround(height));
            found->second.update(window, shrunk(*golden, columns, rows), true);
        }
    }
    thumbnailsWanted = thumbnailsWanted || found == thumbnails.end();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 end(corner.x + width, corner.y + height);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (found != thumbnails.end() && found->second.texture() != nullptr) {
        list.AddImage(found->second.texture(), corner, end);
    } else {
        list.AddRectFilled(corner, end, 0xff2a2a2a);
    }
}

void Interface::stagesTab()
{
    ImGui::SetNextItemWidth(-1.0f);
    if (std::exchange(searching, false)) ImGui::SetKeyboardFocusHere();
    ImGui::InputTextWithHint("##search", "Search: normals, 1.2, triplanar ...", &search);
    place("search");
    ImGui::BeginChild("stages");
    const float width = points(96.0f), height = points(54.0f), gap = points(12.0f);
    std::string tutorial;
    int shown = 0;
    for (const Listed& stage : listedStages()) {
        if (!matches(stage, search)) continue;
        ++shown;
        if (stage.source.tutorial != tutorial) {
            tutorial = stage.source.tutorial;
            ImGui::PushStyleColor(ImGuiCol_Text, kDim);
            ImGui::TextWrapped("%s", tutorial.c_str());
            ImGui::PopStyleColor();
        }
        ImGui::PushID(stage.source.id.c_str());
        const ImVec2 corner = ImGui::GetCursorPos();
        const bool here = stage.source.path == viewer.session().source().path;
        const bool chosen = ImGui::Selectable("##stage", here, 0, ImVec2(0.0f, height + points(6.0f)));
        place("stage." + stage.source.id);
        tooltip(stage.news);
        const bool visible = ImGui::IsItemVisible();
        const ImVec2 after = ImGui::GetCursorPos();
        if (visible) {
            ImGui::SetCursorPos(ImVec2(corner.x + points(3.0f), corner.y + points(3.0f)));
            thumbnail(stage.source, width, height);
            ImGui::SetCursorPos(ImVec2(corner.x + width + gap, corner.y + points(3.0f)));
            ImGui::PushTextWrapPos(0.0f);
            ImGui::BeginGroup();
            ImGui::TextDisabled("%s", stage.source.id.c_str());
            ImGui::TextWrapped("%s", stage.title.c_str());
            ImGui::EndGroup();
            ImGui::PopTextWrapPos();
            ImGui::SetCursorPos(after);
        }
        ImGui::PopID();
        if (!chosen) continue;
        if (const Expected<void> opened = viewer.open(stage.source); !opened) viewer.refusal = opened.error().message;
    }
    if (shown == 0) ImGui::TextDisabled("No stage has all of these words.");
    ImGui::EndChild();
}

}  // namespace relief::samples

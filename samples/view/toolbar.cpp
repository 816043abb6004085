// Above the picture: what it is compared with, and how to take it away. Below it: the pixel below the mouse, the kept
// one, and the frame's time.
#include <algorithm>
#include <cstdio>

#include <imgui.h>

#include "view/interface.h"
#include "view/stage_list.h"
#include "view/style.h"

namespace relief::samples {

// The next control on the same line where there is room for it, else on another one.
bool Interface::flow(float width)
{
    const float after = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetStyle().ItemSpacing.x;
    const bool fits = after + width <= ImGui::GetWindowWidth() - points(4.0f);
    if (fits) ImGui::SameLine();
    if (!fits) ++toolbarLines;
    return fits;
}

void Interface::toolbar()
{
    const auto width = [](const char* text) {
        return ImGui::CalcTextSize(text).x + 2.0f * ImGui::GetStyle().FramePadding.x;
    };
    const auto next = [&](const char* label, const std::string& name, const char* meaning) {
        flow(width(label));
        return button(label, name, meaning);
    };
    toolbarLines = 1;
    if (button(panelShown ? "Hide panel" : "Panel", "panel", "Shows and hides the panel (Tab)")) {
        panelShown = !panelShown;
    }
    flow(width("Show") + points(110.0f));
    chooseView();
    flow(width("Beside") + points(150.0f));
    chooseBeside();
    if (next("Keep", "keep", "Keeps this picture, to compare others with it")) {
        viewer.keepSnapshot();
        notice = viewer.snapshots.empty() ? "" : viewer.snapshots.back().name + ": choose it under Beside";
    }
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float right = width("Copy command") + width("Save PNG") + width("Record turn") + width("Help") + 3.0f * gap;
    if (flow(right)) ImGui::SameLine(ImGui::GetWindowWidth() - right - points(10.0f));
    if (button("Copy command", "copy", "Copies the command that renders this very picture (Ctrl+C)")) copyCommand();
    if (next("Save PNG", "save", "Writes this picture to a file (Ctrl+S)")) press('s', true, false);
    if (next("Record turn", "record", "Writes a turn of the camera, a PNG for each frame")) {
        turnFolder = viewer.session().source().stem + "_turn";
        dialogProblem.clear();
        dialog = Dialog::turn;
    }
    if (next("Help", "help", "Keys and mouse (F1)")) dialog = Dialog::help;
    if (viewer.besideKind() != Viewer::Beside::nothing) comparison();
}

// What lies behind the picture: depths, normals, interpolators ...
void Interface::chooseView()
{
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Show");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(points(110.0f));
    live::Look look = viewer.look();
    const bool open = ImGui::BeginCombo("##view", look.show.empty() ? "color" : look.show.c_str());
    place("show");
    if (!open) return tooltip("What lies behind the picture: depths, normals, what is interpolated ...");
    for (const live::ViewName& view : viewer.views()) {
        if (ImGui::Selectable(view.name.c_str(), view.name == look.show)) {
            look.show = view.name == "color" ? "" : view.name;
            viewer.change(look);
        }
        place("show." + view.name);
        tooltip(view.meaning);
    }
    ImGui::EndCombo();
}

void Interface::chooseBeside()
{
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Beside");
    ImGui::SameLine();
    const std::string shown = viewer.besideKind() == Viewer::Beside::nothing ? "nothing" : viewer.besideName();
    ImGui::SetNextItemWidth(points(150.0f));
    const bool open = ImGui::BeginCombo("##beside", shown.c_str(), ImGuiComboFlags_HeightLarge);
    place("beside");
    if (!open) {
        tooltip("What this picture is compared with");
        return;
    }
    const auto choice = [this](const std::string& label, const std::string& name) {
        const bool chosen = ImGui::Selectable(label.c_str());
        place("beside." + name);
        return chosen;
    };
    const auto report = [this](const Expected<void>& done) {
        if (!done) viewer.refusal = done.error().message;
    };
    if (choice("nothing", "nothing")) viewer.compareWithNothing();
    if (!viewer.session().source().id.empty() && choice("the golden picture (480x270)", "golden")) {
        report(viewer.compareWithGolden());
    }
    if (viewer.hasGoal() && choice("the goal of this exercise", "goal")) report(viewer.compareWithGoal());
    for (std::size_t i = 0; i < viewer.snapshots.size(); ++i) {
        if (choice(viewer.snapshots[i].name, "snapshot." + std::to_string(i))) viewer.compareWithSnapshot(i);
    }
    ImGui::Separator();
    for (const Listed& stage : listedStages()) {
        if (choice(stage.source.id + " " + stage.title, stage.source.id)) report(viewer.compareWith(stage.source));
    }
    ImGui::EndCombo();
}

void Interface::comparison()
{
    if (!viewer.canCompare()) {
        const Pixels& other = viewer.besidePicture();
        ImGui::AlignTextToFramePadding();
        if (other.empty()) {
            ImGui::TextDisabled(viewer.besideHasProblem() ? "It gives no picture: look at it alone, to see why."
                                                          : "Waiting for its picture ...");
            return;
        }
        ImGui::TextDisabled("The other picture has %dx%d pixels.", other.width, other.height);
        ImGui::SameLine();
        if (!button("Take its size", "take size")) return;
        live::Look look = viewer.look();
        look.width = other.width;
        look.height = other.height;
        viewer.fit = Fit::fixed;
        viewer.change(look);
        return;
    }
    if (ImGui::RadioButton("All three", viewer.showsGrid())) viewer.setGrid(true);
    place("compare.grid");
    tooltip("The other picture, this one, and their difference");
    ImGui::SameLine();
    if (ImGui::RadioButton("Divider", viewer.showsDivider())) viewer.setDifference(false);
    place("compare.divider");
    tooltip("Drag the line in the picture");
    ImGui::SameLine();
    if (ImGui::RadioButton("Difference", viewer.showsDifference())) viewer.setDifference(true);
    place("compare.difference");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(points(76.0f));
    char times[16];
    std::snprintf(times, sizeof times, "%d\xc3\x97", viewer.enlargement());
    if (ImGui::BeginCombo("##enlargement", times)) {
        for (const int factor : {1, 2, 4, 8, 16, 32, 64, 255}) {
            std::snprintf(times, sizeof times, "%d\xc3\x97", factor);
            if (ImGui::Selectable(times, factor == viewer.enlargement())) viewer.setEnlargement(factor);
            place("enlargement." + std::to_string(factor));
        }
        ImGui::EndCombo();
    }
    place("enlargement");
    tooltip("How much the difference is enlarged");
    ImGui::SameLine();
    const Difference& d = viewer.difference();
    if (d.pixels == 0) {
        ImGui::TextUnformatted("No difference: every byte is the same.");
        return;
    }
    const double percent = 100.0 * static_cast<double>(d.pixels) / static_cast<double>(viewer.picture().colors.size());
    ImGui::Text("Largest: %d of 255, at %d, %d. %.1f %% of the pixels differ.", d.largest, d.x, d.y, percent);
}

void Interface::times()
{
    const std::vector<float>& all = viewer.frameTimes;
    if (all.empty()) return;
    std::vector<float> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%6.2f ms", static_cast<double>(all.back()));
    ImGui::SameLine();
    ImGui::PlotLines("##times", all.data(), static_cast<int>(all.size()), 0, nullptr, 0.0f, sorted.back() * 1.1f,
                     ImVec2(points(110.0f), ImGui::GetFrameHeight()));
    place("times");
    if (!ImGui::IsItemHovered()) return;
    char text[160];
    std::snprintf(text, sizeof text, "The last %zu frames: %.2f ms at best, median %.2f, worst %.2f", all.size(),
                  static_cast<double>(sorted.front()), static_cast<double>(sorted[sorted.size() / 2]),
                  static_cast<double>(sorted.back()));
    tooltip(text);
}

void Interface::status()
{
    times();
    const Pixels& shown = viewer.pointable();
    const auto pixel = [&](const char* what, const Viewer::Point& p) {
        if (p.x >= shown.width || p.y >= shown.height) return;
        const std::uint32_t color = shown.at(p.x, p.y);
        ImGui::SameLine(0.0f, points(14.0f));
        ImGui::Text("%s%d, %d: %s = %s", what, p.x, p.y, storedText(color).c_str(), decodedText(color).c_str());
    };
    if (viewer.kept) {
        pixel("kept ", *viewer.kept);
        place("kept");
        tooltip("The kept pixel as it is stored, 0 to 255, and decoded, linear light");
        ImGui::SameLine();
        if (button("its life", "kept.life", "Tells why it has its colour, line by line")) {
            panelShown = true;
            chosenTab = 2;
        }
        ImGui::SameLine();
        if (button("\xc3\x97", "kept.release", "Lets the pixel go")) viewer.kept.reset();
    } else if (pointed) {
        pixel("", *pointed);
    }
    pointedPixel();
    std::string text = notice;
    if (viewer.session().compiling()) text = "compiling ...";
    if (text.empty()) return;
    ImGui::SameLine(0.0f, points(14.0f));
    ImGui::TextDisabled("%s", text.c_str());
    tooltip(text);
}

}  // namespace relief::samples

// The panel's tab that tells the kept pixel's life: its lines one by one, forwards and backwards, in all four pixels of
// its quad.
#include <algorithm>

#include <imgui.h>

#include "common/shell.h"
#include "live/toolchain.h"
#include "picture_command.h"
#include "view/interface.h"
#include "view/style.h"

namespace relief::samples {

void Interface::pixelTab()
{
    if (!viewer.kept) {
        ImGui::TextWrapped("Keep a pixel: hold M, and click on it. Then its life is told here, line by line.");
        return;
    }
    ImGui::Text("Pixel %d, %d", viewer.kept->x, viewer.kept->y);
    ImGui::SameLine();
    const struct
    {
        const char *label, *name, *meaning;
        int x, y;
    } neighbours[] = {{"<##p", "pixel.left", "The pixel to the left (Shift and an arrow)", -1, 0},
                      {">##p", "pixel.right", "The pixel to the right", 1, 0},
                      {"^##p", "pixel.up", "The pixel above", 0, -1},
                      {"v##p", "pixel.down", "The pixel below", 0, 1}};
    for (const auto& n : neighbours) {
        if (button(n.label, n.name, n.meaning)) moveKept(n.x, n.y);
        ImGui::SameLine();
    }
    if (button("page", "pixel.page", "All of it, triangles and texels too, on a page")) tellPage();
    if (!teller.problem().empty()) ImGui::TextWrapped("%s", teller.problem().c_str());
    const PixelLife* const life = teller.told(viewer.kept->x, viewer.kept->y);
    if (life == nullptr) {
        ImGui::TextDisabled(teller.isTelling() || teller.problem().empty() ? "telling ..." : "");
        return;
    }
    ImGui::TextWrapped("%s", life->summary.c_str());
    place("pixel.summary");
    if (life->steps.empty()) return;
    const int count = static_cast<int>(life->steps.size());
    step = std::clamp(step, 0, count - 1);
    const auto go = [&](const char* label, const char* name, const char* meaning, int to) {
        ImGui::BeginDisabled(std::clamp(to, 0, count - 1) == step);
        if (button(label, name, meaning)) step = std::clamp(to, 0, count - 1);
        ImGui::EndDisabled();
        ImGui::SameLine();
    };
    go("|<", "step.first", "The first value", 0);
    go("< back", "step.back", "The value before (Shift and F10)", step - 1);
    go("on >", "step.on", "The next value (F10)", step + 1);
    go(">|", "step.last", "The last value", count - 1);
    ImGui::Text("%d of %d", step + 1, count);
    currentStep(life->steps[static_cast<std::size_t>(step)], life->inQuad());
    ImGui::Separator();
    ImGui::BeginChild("steps");
    for (int i = 0; i < count; ++i) {
        const PixelStep& s = life->steps[static_cast<std::size_t>(i)];
        const std::string row = std::to_string(s.line) + "  " + s.name + "  " +
                                s.values[static_cast<std::size_t>(life->inQuad())] + "##" + std::to_string(i);
        if (s.isInvalid) ImGui::PushStyleColor(ImGuiCol_Text, kVermilion);
        if (ImGui::Selectable(row.c_str(), i == step)) step = i;
        if (s.isInvalid) ImGui::PopStyleColor();
        place("step." + std::to_string(i));
        if (i == step && shownStep != step) ImGui::SetScrollHereY();
    }
    shownStep = step;
    ImGui::EndChild();
}

void Interface::currentStep(const PixelStep& its, int pixel)
{
    ImGui::PushFont(window.fonts.code);
    ImGui::TextWrapped("%s:%d", its.file.c_str(), its.line);
    ImGui::PushStyleColor(ImGuiCol_Text, kBright);
    if (!its.code.empty()) ImGui::TextWrapped("%s", its.code.c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::Text("%s, in the four pixels:", its.name.c_str());
    if (ImGui::BeginTable("quad", 2, ImGuiTableFlags_Borders | ImGuiTableFlags_SizingStretchSame)) {
        for (int i = 0; i < 4; ++i) {
            ImGui::TableNextColumn();
            ImGui::PushStyleColor(ImGuiCol_Text, i == pixel ? kOrange : kDim);
            ImGui::TextWrapped("%s", its.values[static_cast<std::size_t>(i)].c_str());
            ImGui::PopStyleColor();
        }
        ImGui::EndTable();
    }
    if (button("in every pixel", "step.everywhere", "A picture of this value, beside the stage's")) {
        live::Look look = viewer.look();
        look.show = its.name + "@" + std::to_string(its.line);
        const std::string file = temporaryFile("values.png");
        const Expected<void> begun =
            everywhere.begin(renderCommand(live::programPath(), viewer.session().source(), look, file), file);
        notice = begun ? "drawing " + look.show + " ..." : begun.error().message;
        shownName = look.show;
    }
}

PixelStep Interface::shown() const
{
    const PixelLife* const life = viewer.kept ? teller.told(viewer.kept->x, viewer.kept->y) : nullptr;
    if (life == nullptr || life->steps.empty()) return {};
    return life->steps[static_cast<std::size_t>(std::clamp(step, 0, static_cast<int>(life->steps.size()) - 1))];
}

void Interface::moveKept(int x, int y)
{
    if (!viewer.kept) return;
    const Pixels& all = viewer.picture();
    viewer.kept->x = std::clamp(viewer.kept->x + x, 0, std::max(all.width - 1, 0));
    viewer.kept->y = std::clamp(viewer.kept->y + y, 0, std::max(all.height - 1, 0));
}

void Interface::tellPage()
{
    const std::string file = temporaryFile("pixel.html");
    const std::string words = "--pixel " + std::to_string(viewer.kept->x) + "," + std::to_string(viewer.kept->y) +
                              " --html " + samples::quoted(file);
    const Expected<void> begun =
        lifePage.begin(traceCommand(live::programPath(), viewer.session().source(), words, viewer.look()), file);
    notice = begun ? "telling the pixel's life ..." : begun.error().message;
}

// The short form, beside the mouse.
void Interface::pointedPixel() const
{
    if (!pixelTabShown || !pointed) return;
    if (const PixelLife* const life = teller.told(pointed->x, pointed->y)) {
        ImGui::SetTooltip("%d, %d: %s", life->x, life->y, life->summary.c_str());
    }
}

bool Interface::updatePixel()
{
    bool news = teller.poll();
    const auto ask = [this](const Viewer::Point& pixel) {
        teller.ask(viewer.session().source(), viewer.look(), viewer.session().picture().version, pixel.x, pixel.y);
    };
    if (pixelTabShown && viewer.kept && viewer.idle() && viewer.session().problem() == nullptr) {
        ask(*viewer.kept);
        if (pointed && teller.told(viewer.kept->x, viewer.kept->y) != nullptr) ask(*pointed);
    }
    if (const std::optional<Expected<std::string>> told = lifePage.poll()) {
        if (*told) {
            openPage(**told);
        } else {
            notice = told->error().message;
        }
        news = true;
    }
    if (const std::optional<Expected<std::string>> drawn = everywhere.poll()) {
        const Expected<Pixels> values = *drawn ? readPixels(**drawn) : tl::unexpected(drawn->error());
        notice = values ? shownName + " in every pixel" : values.error().message;
        if (!values) return true;
        viewer.snapshots.push_back({shownName, *values});
        viewer.compareWithSnapshot(viewer.snapshots.size() - 1);
        viewer.setDivider(0.0f);
        news = true;
    }
    return news;
}

}  // namespace relief::samples

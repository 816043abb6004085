// The picture, and what the mouse does to it: turns it, drags the divider, looks closer. What is wrong with the
// learner's file stands over it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <imgui.h>

#include "relief/path.h"
#include "view/interface.h"
#include "view/orbit.h"
#include "view/style.h"

namespace relief::samples {

namespace {

// A few words on a dark ground.
void label(ImDrawList& list, ImVec2 corner, const std::string& text, float pad, bool toTheLeft)
{
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    if (toTheLeft) corner.x -= size.x + 2.0f * pad;
    list.AddRectFilled(corner, ImVec2(corner.x + size.x + 2.0f * pad, corner.y + size.y + pad), 0xc8101010, pad);
    list.AddText(ImVec2(corner.x + pad, corner.y + pad / 2.0f), kBright, text.c_str());
}

}  // namespace

void Interface::pictureArea()
{
    const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    ImGui::GetWindowDrawList()->AddRectFilled(corner, ImVec2(corner.x + room.x, corner.y + room.y), 0xff151312);
    viewer.fitTo(static_cast<int>(room.x), static_cast<int>(room.y));
    const Pixels& shown = viewer.shown();
    pointed.reset();
    if (shown.empty()) {
        const char* const text = viewer.session().compiling() ? "compiling ..." : "";
        const ImVec2 size = ImGui::CalcTextSize(text);
        ImGui::GetWindowDrawList()->AddText(
            ImVec2(corner.x + (room.x - size.x) / 2.0f, corner.y + (room.y - size.y) / 2.0f), kDim, text);
        return problem(corner.x, corner.y, room.x, room.y);
    }
    const auto columns = static_cast<float>(shown.width), rows = static_cast<float>(shown.height);
    float factor = std::min(room.x / columns, room.y / rows);
    if (factor >= 1.0f) factor = std::floor(factor);  // whole pixels
    const float width = std::round(columns * factor), height = std::round(rows * factor);
    const float x = corner.x + std::floor((room.x - width) / 2.0f), y = corner.y + std::floor((room.y - height) / 2.0f);
    const bool smooth = factor < 1.0f;
    if (pictureVersion != viewer.version || pictureSmooth != smooth) picture.update(window, shown, smooth);
    pictureVersion = viewer.version;
    pictureSmooth = smooth;

    ImGui::SetCursorScreenPos(ImVec2(x, y));
    ImGui::Image(picture.texture(), ImVec2(width, height));
    place("picture");
    handlePicture(x, y, factor);
    if (viewer.showsDivider()) drawComparison(x, y, width, height);
    if (viewer.showsGrid()) labelGrid(x, y, width, height);
    if (viewer.kept) {
        const float column = viewer.showsGrid() ? x + width / 2.0f : x;  // of three, this stage's own
        const auto at = [factor](float from, int pixel) { return from + (static_cast<float>(pixel) + 0.5f) * factor; };
        const ImVec2 middle(at(column, viewer.kept->x), at(y, viewer.kept->y));
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddCircle(middle, points(6.0f), 0xff000000, 0, points(3.0f));
        list.AddCircle(middle, points(6.0f), kOrange, 0, points(1.5f));
    }
    problem(corner.x, corner.y, room.x, room.y);
}

void Interface::handlePicture(float x, float y, float factor)
{
    const ImGuiIO& io = ImGui::GetIO();
    const Pixels& shown = viewer.shown();
    const float width = static_cast<float>(shown.width) * factor, height = static_cast<float>(shown.height) * factor;
    ImGui::SetCursorScreenPos(ImVec2(x, y));
    ImGui::InvisibleButton(
        "picture", ImVec2(width, height),
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    const float line = x + static_cast<float>(viewer.dividerColumn()) * factor;
    const bool overLine = viewer.showsDivider() && hovered && std::abs(io.MousePos.x - line) < points(7.0f);
    if (hovered) {
        const auto column = static_cast<int>((io.MousePos.x - x) / factor);
        const auto row = static_cast<int>((io.MousePos.y - y) / factor);
        pointed = Viewer::Point{std::clamp(column, 0, shown.width - 1), std::clamp(row, 0, shown.height - 1)};
        const Pixels& part = viewer.pointable();
        *pointed = {pointed->x % part.width, pointed->y % part.height};
    }
    if (overLine || draggingDivider) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActivated()) draggingDivider = overLine && !magnifying;
    if (!active) draggingDivider = false;

    if (magnifying && pointed) {
        if (ImGui::IsItemActivated()) viewer.kept = pointed;
        if (io.MouseWheel > 0.0f) magnification = std::min(32, 2 * magnification);
        if (io.MouseWheel < 0.0f) magnification = std::max(8, magnification / 2);
        return magnify(io.MousePos.x, io.MousePos.y, *pointed);
    }
    if (hovered && io.MouseWheel != 0.0f) viewer.setCamera(zoomed(viewer.camera(), std::pow(0.9f, io.MouseWheel)));
    const ImVec2 moves = io.MouseDelta;
    if (!active || (moves.x == 0.0f && moves.y == 0.0f)) return;
    if (draggingDivider) {
        viewer.setDivider((io.MousePos.x - x) / width);
    } else if (!io.MouseDown[0]) {
        viewer.setCamera(moved(viewer.camera(), -moves.x / height, moves.y / height));
    } else if (io.KeyShift) {
        viewer.turnLight(moves.y * 0.4f / window.scale(), moves.x * 0.4f / window.scale());
    } else {
        viewer.setCamera(orbited(viewer.camera(), moves.x * 0.4f / window.scale(), moves.y * 0.4f / window.scale()));
    }
}

void Interface::drawComparison(float x, float y, float width, float height) const
{
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float line =
        std::round(x + static_cast<float>(viewer.dividerColumn()) * width / static_cast<float>(viewer.shown().width));
    list.AddRectFilled(ImVec2(line - points(1.5f), y), ImVec2(line + points(1.5f), y + height), 0xff000000);
    list.AddRectFilled(ImVec2(line - points(0.5f), y), ImVec2(line + points(0.5f), y + height), 0xffffffff);
    const float middle = y + height / 2.0f;
    list.AddRectFilled(ImVec2(line - points(4.0f), middle - points(16.0f)),
                       ImVec2(line + points(4.0f), middle + points(16.0f)), 0xffffffff, points(4.0f));
    const float pad = points(6.0f);
    list.PushClipRect(ImVec2(x, y), ImVec2(x + width, y + height), true);
    label(list, ImVec2(line - pad, y + pad), viewer.besideName(), pad, true);
    label(list, ImVec2(line + pad, y + pad), viewer.name(), pad, false);
    list.PopClipRect();
}

void Interface::labelGrid(float x, float y, float width, float height) const
{
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float pad = points(6.0f), right = x + width / 2.0f, below = y + height / 2.0f;
    label(list, ImVec2(x + pad, y + pad), viewer.besideName(), pad, false);
    label(list, ImVec2(right + pad, y + pad), "yours", pad, false);
    label(list, ImVec2(x + pad, below + pad), "difference, " + std::to_string(viewer.enlargement()) + " times", pad,
          false);
}

// The pixels about one, each as a square, with the middle one's values.
void Interface::magnify(float mouseX, float mouseY, Viewer::Point pixel) const
{
    const Pixels& shown = viewer.pointable();
    const auto cell = static_cast<float>(magnification);
    const int reach = 132 / magnification;
    const float side = cell * static_cast<float>(2 * reach + 1), pad = points(6.0f);
    const std::string stored = "stored " + storedText(shown.at(pixel.x, pixel.y));
    const std::string decoded = "decoded " + decodedText(shown.at(pixel.x, pixel.y));
    const float lines = 3.0f * ImGui::GetTextLineHeight() + 2.0f * pad;
    const float width = std::max(side, ImGui::CalcTextSize(decoded.c_str()).x + 2.0f * pad), height = side + lines;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float gap = points(24.0f);
    float left = mouseX + gap, top = mouseY - height / 2.0f;
    if (left + width > screen.x) left = mouseX - gap - width;
    top = std::clamp(top, 0.0f, std::max(0.0f, screen.y - height));
    left = std::round(left);
    top = std::round(top);

    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.AddRectFilled(ImVec2(left - 2.0f, top - 2.0f), ImVec2(left + width + 2.0f, top + height + 2.0f), kBright,
                       points(4.0f));
    list.AddRectFilled(ImVec2(left, top), ImVec2(left + width, top + height), 0xff181818, points(4.0f));
    const float begin = std::round(left + (width - side) / 2.0f);
    for (int row = -reach; row <= reach; ++row) {
        for (int column = -reach; column <= reach; ++column) {
            const int px = pixel.x + column, py = pixel.y + row;
            if (px < 0 || py < 0 || px >= shown.width || py >= shown.height) continue;
            const ImVec2 low(begin + cell * static_cast<float>(column + reach),
                             top + cell * static_cast<float>(row + reach));
            list.AddRectFilled(low, ImVec2(low.x + cell, low.y + cell), shown.at(px, py) | 0xff000000u);
        }
    }
    const float middle = cell * static_cast<float>(reach);
    const ImVec2 low(begin + middle, top + middle), high(low.x + cell, low.y + cell);
    list.AddRect(ImVec2(low.x - 1.0f, low.y - 1.0f), ImVec2(high.x + 1.0f, high.y + 1.0f), 0xff000000, 0.0f, 0, 3.0f);
    list.AddRect(low, high, 0xffffffff);
    char head[64];
    std::snprintf(head, sizeof head, "%d, %d   %d\xc3\x97", pixel.x, pixel.y, magnification);
    float y = top + side + pad;
    for (const std::string& text : {std::string(head), stored, decoded}) {
        list.AddText(ImVec2(left + pad, y), kBright, text.c_str());
        y += ImGui::GetTextLineHeight();
    }
}

// One error: where and what, in words, then the line and a mark below it.
void Interface::diagnostic(const live::Diagnostic& d, bool first) const
{
    std::string place = utf8Of(pathOf(d.file).filename());
    if (d.line > 0) place += ", line " + std::to_string(d.line);
    ImGui::PushStyleColor(ImGuiCol_Text, first ? kVermilion : kDim);
    ImGui::TextWrapped("%s", place.c_str());
    ImGui::PopStyleColor();
    if (first) ImGui::PushFont(window.fonts.title);
    ImGui::TextWrapped("%s", d.message.c_str());
    if (first) ImGui::PopFont();
    // The lines below the first one, whose place and message stand above.
    std::istringstream lines(live::formatted({d}));
    std::string line;
    std::getline(lines, line);
    ImGui::PushFont(window.fonts.code);
    while (std::getline(lines, line)) ImGui::TextUnformatted(line.c_str());
    ImGui::PopFont();
}

void Interface::problem(float x, float y, float width, float height)
{
    const live::Problem* const wrong = viewer.session().problem();
    const bool refused = !viewer.refusal.empty();
    if (!refused && (wrong == nullptr || dialog != Dialog::none)) return;
    const float margin = points(12.0f);
    const float wide = std::min(width - 2.0f * margin, points(900.0f));
    ImGui::SetNextWindowPos(ImVec2(x + (width - wide) / 2.0f, y + margin));
    ImGui::SetNextWindowSizeConstraints(ImVec2(wide, 0.0f), ImVec2(wide, std::max(height * 0.45f, points(120.0f))));
    ImGui::SetNextWindowBgAlpha(0.96f);
    ImGui::PushStyleColor(ImGuiCol_Border, kVermilion);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(points(14.0f), points(12.0f)));
    ImGui::Begin("##problem", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_HorizontalScrollbar);
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    places["problem"] = {corner.x, corner.y, corner.x + size.x, corner.y + size.y};
    if (refused) {
        ImGui::TextWrapped("%s", viewer.refusal.c_str());
        if (button("All right", "refusal.close")) viewer.refusal.clear();
    } else {
        diagnostic(wrong->diagnostics.front(), true);
        const bool behind = viewer.session().picture().version > 0;
        if (behind) ImGui::TextDisabled("The picture behind this is the last good one.");
        if (wrong->diagnostics.size() > 1) {
            ImGui::Separator();
            ImGui::TextDisabled("%zu more:", wrong->diagnostics.size() - 1);
            for (std::size_t i = 1; i < wrong->diagnostics.size(); ++i) diagnostic(wrong->diagnostics[i], false);
        }
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

}  // namespace relief::samples

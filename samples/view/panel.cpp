// The panel's first tab: the stage and everything of it that can be changed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>

#include <SDL.h>

#include <imgui.h>

#include "prepare.h"
#include "relief/path.h"
#include "view/interface.h"
#include "view/stage_list.h"
#include "view/style.h"

namespace relief::samples {

namespace {

bool isOfLight(const Property& p)
{
    return p.name == "lightPitch" || p.name == "lightYaw";
}

std::string text(const Property& p, const glm::vec4& value)
{
    std::string list;
    for (int i = 0; i < p.components; ++i) list += (i > 0 ? ", " : "") + exactText(value[i]);
    return list;
}

std::string meaningOf(const Property& p)
{
    return p.meaning + "\n" + exactText(p.minimum) + " to " + exactText(p.maximum) + ", default " + text(p, p.value);
}

// Such ranges are passed in factors.
bool isWide(const Property& p)
{
    return p.minimum >= 0.0f && p.maximum - p.minimum > 150.0f;
}

}  // namespace

void Interface::panel()
{
    if (!ImGui::BeginTabBar("tabs")) return;
    const auto tab = [this](int index, const char* title, const char* name, auto contents) {
        const bool open = ImGui::BeginTabItem(title, nullptr, chosenTab == index ? ImGuiTabItemFlags_SetSelected : 0);
        place(name);
        if (!open) return;
        contents();
        ImGui::EndTabItem();
    };
    tab(0, "This stage", "tab.stage", [this] { stageTab(); });
    tab(1, "All stages", "tab.stages", [this] { stagesTab(); });
    pixelTabShown = false;
    tab(2, "A pixel", "tab.pixel", [this] {
        pixelTabShown = true;
        pixelTab();
    });
    chosenTab = -1;
    ImGui::EndTabBar();
}

void Interface::stageTab()
{
    heading();
    ImGui::BeginChild("choices");
    if (viewer.stage() != nullptr) {
        const std::vector<Property>& all = viewer.properties();
        if (section("Properties")) properties(false);
        if (std::any_of(all.begin(), all.end(), isOfLight) && section("Light")) properties(true);
        if (section("Camera")) cameraSection();
        if (section("Picture")) pictureSection();
        if (!viewer.slots().empty() && section("Inputs", false)) inputSection();
    }
    ImGui::EndChild();
}

void Interface::heading()
{
    const live::StageSource& source = viewer.session().source();
    ImGui::PushFont(window.fonts.title);
    ImGui::TextWrapped("%s", viewer.name().c_str());
    ImGui::PopFont();
    ImGui::PushStyleColor(ImGuiCol_Text, kDim);
    if (!source.tutorial.empty()) ImGui::TextWrapped("%s", source.tutorial.c_str());
    ImGui::PopStyleColor();
    if (viewer.stage() != nullptr) ImGui::TextWrapped("%s", viewer.stage()->news.c_str());
    if (source.id.empty()) return;
    if (button("<", "before", "The stage before, in the book (left arrow)")) viewer.step(-1);
    ImGui::SameLine();
    if (button(">", "next", "The next stage (right arrow)")) viewer.step(1);
    ImGui::SameLine();
    std::error_code ignored;
    const std::string page = pageOf(viewer.session().source());
    const bool there = std::filesystem::exists(pathOf(page), ignored);
    ImGui::BeginDisabled(!there);
    if (button("Read its page", "page", there ? "Opens the stage's page of the book" : "The page is not there")) {
        openPage(page);
    }
    ImGui::EndDisabled();
}

void Interface::openPage(const std::string& path)
{
    std::error_code ignored;
    const std::string address = "file://" + std::filesystem::weakly_canonical(pathOf(path), ignored).generic_string();
    notice = SDL_OpenURL(address.c_str()) == 0 ? "Opened " + address : "Nothing opens " + address;
}

bool Interface::section(const char* title, bool open)
{
    const bool shown = ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    place(std::string("section.") + title);
    return shown;
}

// The label, and room for a control beside it, or below it where the label is long.
bool Interface::row(const std::string& label, bool changed, bool hasReset)
{
    const float button = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float left = ImGui::GetCursorPosX(), right = left + ImGui::GetContentRegionAvail().x;
    bool pressed = false;
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, changed ? kOrange : kBright);
    ImGui::TextUnformatted(label.c_str());
    ImGui::PopStyleColor();
    place("label." + label);
    const float column = left + points(116.0f);
    if (changed && hasReset) {
        ImGui::SameLine(right - button);
        pressed = ImGui::Button("\xc3\x97", ImVec2(button, button));  // a multiplication sign
        place("reset." + label);
        tooltip("Back to its default");
    }
    const bool below = left + ImGui::CalcTextSize(label.c_str()).x + gap > column;
    if (!below) ImGui::SameLine(column);
    ImGui::SetNextItemWidth(right - button - gap - (below ? left : column));
    return pressed;
}

void Interface::properties(bool ofLight)
{
    int shown = 0;
    for (const Property& p : viewer.properties()) {
        if (isOfLight(p) != ofLight) continue;
        property(p);
        ++shown;
    }
    if (ofLight) return;
    if (shown == 0) ImGui::TextDisabled("This stage has none.");
    if (button("Reset all", "reset all", "All properties and the camera back to their defaults (R)")) viewer.resetAll();
}

void Interface::property(const Property& p)
{
    ImGui::PushID(p.name.c_str());
    if (row(p.name, viewer.isChanged(p), true)) viewer.reset(p);
    glm::vec4 value = viewer.value(p);
    ImGui::BeginGroup();
    const bool changed = control(p, value);
    ImGui::EndGroup();
    place("property." + p.name);
    if (!ImGui::IsItemActive()) tooltip(meaningOf(p));
    if (changed) viewer.set(p, value);
    ImGui::PopID();
}

// A mark below a slider, where the default is.
void Interface::markDefault(const Property& p) const
{
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    float at = (p.value.x - p.minimum) / (p.maximum - p.minimum);
    if (isWide(p)) {
        const float least = std::max(p.minimum, 0.001f);  // what Dear ImGui takes for 0
        at = p.value.x <= least ? 0.0f : std::log(p.value.x / least) / std::log(p.maximum / least);
    }
    const float inset = 2.0f + ImGui::GetStyle().GrabMinSize / 2.0f;
    const float x = std::round(low.x + inset + std::clamp(at, 0.0f, 1.0f) * (high.x - low.x - 2.0f * inset));
    ImGui::GetWindowDrawList()->AddTriangleFilled(ImVec2(x, high.y - points(5.0f)),
                                                  ImVec2(x - points(4.0f), high.y + points(1.0f)),
                                                  ImVec2(x + points(4.0f), high.y + points(1.0f)), kDim);
}

bool Interface::control(const Property& p, glm::vec4& value)
{
    using Kind = Property::Kind;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (isWide(p) ? ImGuiSliderFlags_Logarithmic : 0);
    bool changed = false;
    switch (p.kind) {
        case Kind::number:
            changed = ImGui::SliderFloat("##value", &value.x, p.minimum, p.maximum, "%.4g", flags);
            markDefault(p);
            return changed;
        case Kind::color: {
            const ImGuiColorEditFlags how =
                ImGuiColorEditFlags_Float | ImGuiColorEditFlags_AlphaPreviewHalf | ImGuiColorEditFlags_NoInputs;
            changed = p.components == 4 ? ImGui::ColorEdit4("##value", &value.x, how)
                                        : ImGui::ColorEdit3("##value", &value.x, how);
            ImGui::SameLine();
            ImGui::AlignTextToFramePadding();
            char numbers[64];
            std::snprintf(numbers, sizeof numbers, "%.2f %.2f %.2f", static_cast<double>(value.x),
                          static_cast<double>(value.y), static_cast<double>(value.z));
            ImGui::TextDisabled("%s", numbers);
            return changed;
        }
        case Kind::vector: {
            const float width = ImGui::CalcItemWidth(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
            const int columns = p.components == 3 ? 3 : 2;
            for (int i = 0; i < p.components; ++i) {
                if (i % columns != 0) ImGui::SameLine(0.0f, gap);
                ImGui::PushID(i);
                const auto count = static_cast<float>(columns);
                ImGui::SetNextItemWidth(std::floor((width - gap * (count - 1.0f)) / count));
                changed = ImGui::DragFloat("##part", &value[i], (p.maximum - p.minimum) / 1000.0f, p.minimum, p.maximum,
                                           "%.4g", ImGuiSliderFlags_AlwaysClamp) ||
                          changed;
                place("property." + p.name + "." + std::to_string(i));
                ImGui::PopID();
            }
            return changed;
        }
        case Kind::toggle: {
            bool on = value.x != 0.0f;
            changed = ImGui::Checkbox("##value", &on);
            value.x = on ? 1.0f : 0.0f;
            return changed;
        }
        case Kind::choice: {
            int chosen = std::clamp(static_cast<int>(std::lround(value.x)), 0, static_cast<int>(p.choices.size()) - 1);
            if (!ImGui::BeginCombo("##value", p.choices[static_cast<std::size_t>(chosen)].c_str())) return false;
            for (int i = 0; i < static_cast<int>(p.choices.size()); ++i) {
                if (ImGui::Selectable(p.choices[static_cast<std::size_t>(i)].c_str(), i == chosen)) {
                    value.x = static_cast<float>(i);
                    changed = true;
                }
                place("choice." + std::to_string(i));
            }
            ImGui::EndCombo();
            return changed;
        }
    }
    return false;
}

void Interface::cameraSection()
{
    Camera camera = viewer.camera();
    const bool changed = viewer.look().camera.has_value();
    const auto edit = [&](const char* label, const char* name, glm::vec3& point) {
        ImGui::PushID(name);
        row(label, false, false);
        const bool moved = ImGui::DragFloat3("##value", &point.x, 0.01f, -80.0f, 80.0f, "%.2f");
        place(name);
        ImGui::PopID();
        return moved;
    };
    bool moved = edit("stands at", "camera.position", camera.position);
    moved = edit("looks at", "camera.target", camera.target) || moved;
    row("field of view", false, false);
    moved = ImGui::SliderFloat("##field", &camera.fieldOfView, 5.0f, 120.0f, "%.1f degrees",
                               ImGuiSliderFlags_AlwaysClamp) ||
            moved;
    place("camera.field");
    if (moved) viewer.setCamera(camera);
    ImGui::BeginDisabled(!changed);
    if (button("Reset the camera", "camera.reset", "Where the stage put it")) viewer.resetCamera();
    ImGui::EndDisabled();
}

void Interface::pictureSection()
{
    live::Look look = viewer.look();
    bool changed = false;
    row("size", false, false);
    static constexpr const char* kFits[] = {"fixed", "window, 16:9", "window"};
    if (ImGui::BeginCombo("##fit", kFits[static_cast<int>(viewer.fit)])) {
        for (int i = 0; i < 3; ++i) {
            if (ImGui::Selectable(kFits[i], i == static_cast<int>(viewer.fit))) viewer.fit = static_cast<Fit>(i);
            place("fit." + std::to_string(i));
        }
        ImGui::EndCombo();
    }
    place("picture.fit");
    row("pixels", false, false);
    int size[2] = {look.width, look.height};
    if (ImGui::InputInt2("##size", size, ImGuiInputTextFlags_EnterReturnsTrue)) {
        look.width = std::clamp(size[0], 1, kMaxTargetSize);
        look.height = std::clamp(size[1], 1, kMaxTargetSize);
        viewer.fit = Fit::fixed;
        changed = true;
    }
    place("picture.size");
    tooltip("Width and height; Enter takes them");
    row("threads", false, false);
    const auto processors = static_cast<int>(std::thread::hardware_concurrency());
    changed = ImGui::SliderInt("##threads", &look.threads, 0, std::max(2 * processors, 4),
                               look.threads == 0 ? "all" : "%d", ImGuiSliderFlags_AlwaysClamp) ||
              changed;
    place("picture.threads");
    const auto oneOf = [&](const char* name, const std::string& word, std::initializer_list<int> numbers, int& chosen) {
        row(name, false, false);
        if (ImGui::BeginCombo(("##" + word).c_str(), std::to_string(chosen).c_str())) {
            for (const int number : numbers) {
                if (ImGui::Selectable(std::to_string(number).c_str(), number == chosen)) {
                    chosen = number;
                    changed = true;
                }
                place(word + "." + std::to_string(number));
            }
            ImGui::EndCombo();
        }
        place("picture." + word);
    };
    oneOf("tile size", "tile", {16, 32, 64, 128}, look.tileSize);
    oneOf("samples", "samples", {1, 2, 4, 8}, look.samples);
    tooltip("Of a pixel: more make smooth edges");
    row("tangent space", false, false);
    changed = ImGui::Checkbox("as lines", &look.showTangents) || changed;
    place("picture.tangents");
    tooltip("Normals green, tangents red, binormals blue");
    if (look.showTangents) {
        row("their length", false, false);
        const auto slider = [&](const char* name, float& value, float most) {
            changed = ImGui::SliderFloat(name, &value, 0.0f, most, "%.3f", ImGuiSliderFlags_AlwaysClamp) || changed;
        };
        slider("##length", look.tangentScale, 1.0f);
        place("tangents.length");
        row("their distance", false, false);
        slider("##distance", look.tangentOffset, 0.2f);
        place("tangents.distance");
    }
    row("text", false, false);
    char times[16];
    std::snprintf(times, sizeof times, "%g\xc3\x97", static_cast<double>(window.scale()));
    if (ImGui::BeginCombo("##text", times)) {
        for (const float scale : {1.0f, 1.5f, 2.0f, 3.0f}) {
            std::snprintf(times, sizeof times, "%g\xc3\x97", static_cast<double>(scale));
            if (ImGui::Selectable(times, scale == window.scale())) newScale = scale;
            place(std::string("text.") + times);
        }
        ImGui::EndCombo();
    }
    place("picture.text");
    tooltip("How large text and controls are");
    if (changed) viewer.change(look);
}

void Interface::inputSection()
{
    for (const Slot& slot : viewer.slots()) {
        live::Look look = viewer.look();
        std::string& file = slot.in(look.files);
        ImGui::PushID(slot.name);
        if (row(slot.name, !file.empty(), true)) {
            file.clear();
            viewer.change(look);
        }
        const std::string own = slot.usual == kNone ? "nothing" : slot.usual;
        const std::string shown = file.empty() ? own : utf8Of(pathOf(file).filename());
        if (ImGui::BeginCombo("##file", shown.c_str())) {
            std::vector<std::pair<std::string, std::string>> choices = {{"the stage's: " + own, ""}};
            if (std::string(slot.name) == "mesh") {
                for (const char* shape : {"quad", "cube", "sphere", "low-sphere", "terrain"}) {
                    choices.emplace_back(shape, shape);
                }
            } else {
                choices.emplace_back("nothing", kNone);
            }
            for (const auto& [label, value] : choices) {
                if (ImGui::Selectable(label.c_str(), value == file)) {
                    file = value;
                    viewer.change(look);
                }
                place("input." + label);
            }
            const std::string map = file.empty() ? slot.usual : file;
            if (std::string(slot.name).ends_with("normal") && map != kNone) {
                ImGui::Separator();
                if (ImGui::Selectable("ask the doctor ...")) examine(*slot.texture, map);
                place("input.doctor");
            }
            ImGui::EndCombo();
        }
        place(std::string("input.") + slot.name);
        tooltip(file.empty() ? "Or drop a file on the window" : file);
        ImGui::PopID();
    }
}

}  // namespace relief::samples

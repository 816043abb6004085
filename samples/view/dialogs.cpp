// Keys, and what asks before it does something: files to write, files that were dropped, help.
#include <algorithm>

#include <SDL.h>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "relief/path.h"
#include "view/interface.h"
#include "view/style.h"

namespace relief::samples {

void Interface::press(int key, bool control, bool shift)
{
    if (key == SDLK_ESCAPE && dialog != Dialog::none) {
        if (turn) turn->end(viewer);
        turn.reset();
        dialog = Dialog::none;
        droppedFiles.clear();
        return;
    }
    if (dialog != Dialog::none && dialog != Dialog::help) return;
    if (control) {
        if (key == SDLK_c) copyCommand();
        if (key == SDLK_s) {
            savePath = viewer.session().source().stem + ".png";
            dialogProblem.clear();
            dialog = Dialog::save;
        }
        if (key == SDLK_f) {
            panelShown = searching = true;
            chosenTab = 1;
        }
        if (key == SDLK_q) running = false;
        return;
    }
    switch (key) {
        case SDLK_F1:
            dialog = dialog == Dialog::help ? Dialog::none : Dialog::help;
            break;
        case SDLK_F2:
            viewer.compareWithStageBefore();
            break;
        case SDLK_F3:
            viewer.setDifference(!viewer.showsDifference());
            break;
        case SDLK_F11:
            window.toggleFullScreen();
            break;
        case SDLK_TAB:
            panelShown = !panelShown;
            break;
        case SDLK_m:
            magnifying = true;
            break;
        case SDLK_k:
            viewer.keepSnapshot();
            break;
        case SDLK_F10:
            step = std::max(step + (shift ? -1 : 1), 0);
            break;
        case SDLK_LEFT:
        case SDLK_RIGHT:
            if (shift) {
                moveKept(key == SDLK_LEFT ? -1 : 1, 0);
            } else {
                viewer.step(key == SDLK_LEFT ? -1 : 1);
            }
            break;
        case SDLK_UP:
        case SDLK_DOWN:
            if (shift) moveKept(0, key == SDLK_UP ? -1 : 1);
            break;
        case SDLK_r:
            if (shift) {
                viewer.resetCamera();
            } else {
                viewer.resetAll();
            }
            break;
        case SDLK_q:
        case SDLK_ESCAPE:
            running = false;
            break;
        default:
            break;
    }
}

void Interface::copyCommand()
{
    copied = viewer.command(viewer.session().source().stem + ".png");
    notice = SDL_SetClipboardText(copied.c_str()) == 0 ? "Copied: " + copied : copied;
}

bool Interface::beginDialog(Dialog which, const char* title)
{
    if (dialog == which && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(size.x / 2.0f, size.y / 2.0f), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    if (!ImGui::BeginPopupModal(
            title, nullptr,
            ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
        return false;
    }
    if (dialog == which) return true;
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return false;
}

void Interface::dialogs()
{
    help();
    savePicture();
    recordTurn();
    recording();
    dropped();
    doctorDialog();
}

void Interface::help()
{
    if (!beginDialog(Dialog::help, "Keys and mouse")) return;
    static constexpr const char* kKeys[][2] = {
        {"drag", "turn the camera around what it looks at"},
        {"right or middle drag", "move the camera, and what it looks at"},
        {"shift and drag", "turn the light"},
        {"wheel", "nearer, farther"},
        {"hold M", "magnifier; the wheel: 8, 16, 32 times; a click keeps the pixel"},
        {"left, right", "the stage before, the next one"},
        {"Ctrl and click", "on a slider: type the number"},
        {"R", "properties and camera back to their defaults; with shift: the camera alone"},
        {"F2", "this stage beside the one before it"},
        {"F3", "divider or difference"},
        {"K", "keep this picture, to compare others with it"},
        {"Ctrl+F", "the list of stages"},
        {"Ctrl+C", "copy the command that renders this picture"},
        {"Ctrl+S", "save the picture"},
        {"Tab", "hide and show the panel"},
        {"F10, Shift+F10", "the kept pixel's next value, and the one before"},
        {"Shift and an arrow", "the pixel beside it"},
        {"F11", "full screen, and back"},
        {"Q, Escape", "close"},
        {"drop a file", "a picture or a mesh takes the place of the stage's"},
    };
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const auto& [key, what] : kKeys) {
            ImGui::TableNextColumn();
            ImGui::PushStyleColor(ImGuiCol_Text, kBlue);
            ImGui::TextUnformatted(key);
            ImGui::PopStyleColor();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(what);
        }
        ImGui::EndTable();
    }
    if (button("Close", "help.close")) dialog = Dialog::none;
    ImGui::EndPopup();
}

void Interface::savePicture()
{
    if (!beginDialog(Dialog::save, "Save the picture")) return;
    ImGui::SetNextItemWidth(points(420.0f));
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    bool save =
        ImGui::InputText("##file", &savePath, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    place("save.file");
    if (!dialogProblem.empty()) {
        ImGui::PushTextWrapPos(points(420.0f));
        ImGui::TextUnformatted(dialogProblem.c_str());
        ImGui::PopTextWrapPos();
    }
    save = button("Save", "save.save") || save;
    ImGui::SameLine();
    if (button("Cancel", "save.cancel")) dialog = Dialog::none;
    if (save) {
        const Expected<void> written = writePixels(savePath, viewer.picture());
        dialogProblem = written ? "" : written.error().message;
        if (written) {
            notice = "Wrote " + savePath;
            dialog = Dialog::none;
        }
    }
    ImGui::EndPopup();
}

void Interface::recordTurn()
{
    if (!beginDialog(Dialog::turn, "Record a turn")) return;
    ImGui::TextDisabled("The camera goes once around what it looks at: one PNG for each frame.");
    ImGui::SetNextItemWidth(points(300.0f));
    ImGui::InputText("folder", &turnFolder, ImGuiInputTextFlags_AutoSelectAll);
    place("turn.folder");
    ImGui::SetNextItemWidth(points(300.0f));
    ImGui::SliderInt("frames", &turnFrames, 2, 360, "%d", ImGuiSliderFlags_AlwaysClamp);
    place("turn.frames");
    if (!dialogProblem.empty()) ImGui::TextUnformatted(dialogProblem.c_str());
    if (button("Record", "turn.begin")) {
        Expected<Turn> begun = Turn::begin(viewer, turnFolder, turnFrames);
        dialogProblem = begun ? "" : begun.error().message;
        if (begun) {
            turn = std::move(*begun);
            dialog = Dialog::recording;
        }
    }
    ImGui::SameLine();
    if (button("Cancel", "turn.cancel")) dialog = Dialog::none;
    ImGui::EndPopup();
}

void Interface::recording()
{
    if (!beginDialog(Dialog::recording, "Recording")) return;
    if (turn) {
        const std::string text = std::to_string(turn->written) + " of " + std::to_string(turn->frames);
        ImGui::ProgressBar(static_cast<float>(turn->written) / static_cast<float>(turn->frames),
                           ImVec2(points(300.0f), 0.0f), text.c_str());
    }
    if (button("Stop", "turn.stop")) press(SDLK_ESCAPE, false, false);
    ImGui::EndPopup();
}

// A mesh fits in one place, a picture in several.
void Interface::dropped()
{
    if (!beginDialog(Dialog::drop, "A file was dropped")) return;
    const std::string file = droppedFiles.empty() ? "" : droppedFiles.front();
    ImGui::Text("What is %s?", utf8Of(pathOf(file).filename()).c_str());
    const bool mesh = hasEnding(file, {".obj"});
    int count = 0;
    bool answered = false;
    for (const Slot& slot : viewer.slots()) {
        if ((std::string(slot.name) == "mesh") != mesh) continue;
        ++count;
        if (!button(("The " + std::string(slot.name) + (mesh ? "" : " map")).c_str(),
                    std::string("drop.") + slot.name)) {
            continue;
        }
        live::Look look = viewer.look();
        slot.in(look.files) = file;
        if (mesh) look.camera.reset();
        viewer.change(look);
        answered = true;
    }
    if (count == 0) ImGui::TextDisabled("This stage reads no %s.", mesh ? "mesh" : "pictures");
    answered = button("Leave it", "drop.cancel") || answered;
    if (answered && !droppedFiles.empty()) droppedFiles.erase(droppedFiles.begin());
    if (droppedFiles.empty()) dialog = Dialog::none;
    ImGui::EndPopup();
}

}  // namespace relief::samples

// The doctor in the window: what a map of the stage's is, what is wrong with it, and the cured map in its place.
// Another process examines it, half a second for a million texels.
#include <algorithm>
#include <filesystem>

#include <imgui.h>

#include "common/assets.h"
#include "common/shell.h"
#include "live/toolchain.h"
#include "relief/path.h"
#include "view/interface.h"

namespace relief::samples {

namespace {

constexpr float kWidth = 760.0f;  // of the dialog, in points

std::string doctorCommand(const std::string& file, const std::string& option, const std::string& output)
{
    return quoted(live::programPath()) + " doctor " + quoted(file) + " " + option + " " + quoted(output);
}

}  // namespace

void Interface::examine(TextureSlot slot, const std::string& file)
{
    const Expected<std::string> own = assetPath(file);
    examined = {slot, own ? *own : file, ""};
    evidence = {};
    const std::string output = temporaryFile("evidence.png");
    const Expected<void> begun = doctor.begin(doctorCommand(examined.file, "--evidence", output), output, 1);
    if (!begun) examined.words = begun.error().message;
    dialog = Dialog::doctor;
}

void Interface::cure()
{
    // Another name each time: a file of the same name is taken for the same map.
    const std::string output = temporaryFile("cured-" + std::to_string(++cures) + ".png");
    const Expected<void> begun = cured.begin(doctorCommand(examined.file, "--fix", output), output, 1);
    if (!begun) examined.words = begun.error().message;
}

bool Interface::updateDoctor()
{
    if (dialog != Dialog::doctor) {
        doctor = {};
        cured = {};
    }
    const auto examination = doctor.poll();
    if (examination) {
        const Expected<Pixels> seen = *examination ? readPixels(**examination) : tl::unexpected(examination->error());
        examined.words = seen ? doctor.said() : seen.error().message;
        if (seen) {
            const std::size_t name = examined.words.rfind(**examination);
            if (name != std::string::npos) examined.words.replace(name, (**examination).size(), "below");
            std::error_code ignored;
            std::filesystem::remove(**examination, ignored);
            const auto width = static_cast<int>(points(kWidth));
            const int height = std::max(1, width * seen->height / seen->width);
            examined.height = static_cast<float>(height);
            evidence.update(window, width < seen->width ? shrunk(*seen, width, height) : *seen, true);
        }
    }
    const auto cure = cured.poll();
    if (cure && *cure) {
        live::Look look = viewer.look();
        look.files.textures[examined.slot] = **cure;
        viewer.change(look);
        notice = "The cured map is in its place: " + **cure;
        dialog = Dialog::none;
    }
    if (cure && !*cure) examined.words = cure->error().message;
    return examination || cure;
}

void Interface::doctorDialog()
{
    if (!beginDialog(Dialog::doctor, "The doctor")) return;
    const bool isBusy = doctor.descriptor() >= 0;
    ImGui::PushTextWrapPos(points(kWidth));
    if (isBusy) ImGui::TextDisabled("examining %s ...", examined.file.c_str());
    if (!isBusy) ImGui::TextUnformatted(examined.words.c_str());
    place("doctor.words");
    ImGui::PopTextWrapPos();
    if (evidence.texture() != nullptr) {
        ImGui::Image(evidence.texture(), ImVec2(points(kWidth), examined.height));
        place("doctor.evidence");
    }
    if (examined.words.find("--fix") != std::string::npos) {
        if (button("Use the cured map", "doctor.cure", "In place of this one, in the window alone")) cure();
        ImGui::SameLine();
    }
    if (button("Close", "doctor.close")) dialog = Dialog::none;
    ImGui::EndPopup();
}

}  // namespace relief::samples

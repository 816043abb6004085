// All controls of the window, drawn with Dear ImGui: they show the viewer's state and call its functions. Which file
// has what: panel.cpp the stage's properties, stages_tab.cpp the list of stages, toolbar.cpp what is above and below
// the picture, picture_area.cpp the picture, doctor_dialog.cpp what is wrong with a map, dialogs.cpp questions and
// help.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "view/errand.h"
#include "view/pixel_teller.h"
#include "view/turn.h"
#include "view/viewer.h"
#include "view/window.h"

namespace relief::samples {

class Interface
{
public:
    Interface(Viewer& viewer, Window& window);

    void take(const SDL_Event& event);  // keys and dropped files
    bool update();                      // after Viewer::update(); true: there is news
    // Opens the doctor's dialog about a map of the stage's.
    void examine(TextureSlot slot, const std::string& file);
    void draw();  // between Window's beginFrame() and endFrame()
    bool wantsMore() const { return thumbnailsWanted; }

    // Call update() when one of them is readable; -1: nothing.
    std::array<int, 5> descriptors() const
    {
        return {lifePage.descriptor(), everywhere.descriptor(), teller.descriptor(), doctor.descriptor(),
                cured.descriptor()};
    }

    bool running = true;

    // Where a control was drawn last, in pixels; for tests that click on all of them.
    struct Place
    {
        float left, top, right, bottom;
    };
    std::map<std::string, Place> places;
    std::string copied;  // to the clipboard
    const std::string& diagnosis() const { return examined.words; }
    PixelStep shown() const;  // of the kept pixel's life; empty where none is told

private:
    enum class Dialog
    {
        none,
        help,
        save,
        turn,
        recording,
        drop,
        doctor
    };
    static constexpr int kTabs = 3;

    void place(const std::string& name);
    bool button(const char* label, const std::string& name, const char* meaning = nullptr);
    void tooltip(const std::string& text) const;
    float points(float number) const { return number * window.scale(); }

    // panel.cpp
    void panel();
    void stageTab();
    void heading();
    bool section(const char* title, bool open = true);
    bool row(const std::string& label, bool changed, bool hasReset);  // true: the reset button was pressed
    void property(const Property& property);
    bool control(const Property& property, glm::vec4& value);
    void markDefault(const Property& property) const;
    void properties(bool ofLight);
    void cameraSection();
    void pictureSection();
    void inputSection();

    // stages_tab.cpp
    void stagesTab();
    void thumbnail(const live::StageSource& source, float width, float height);

    // pixel_tab.cpp
    void pixelTab();
    void currentStep(const PixelStep& its, int pixel);
    void pointedPixel() const;
    void moveKept(int x, int y);
    void tellPage();
    bool updatePixel();

    // toolbar.cpp
    void toolbar();
    void comparison();
    bool flow(float width);
    void chooseView();
    void chooseBeside();
    void status();
    void times();

    // picture_area.cpp
    void pictureArea();
    void handlePicture(float x, float y, float factor);
    void drawComparison(float x, float y, float width, float height) const;
    void labelGrid(float x, float y, float width, float height) const;
    void magnify(float mouseX, float mouseY, Viewer::Point pixel) const;
    void problem(float x, float y, float width, float height);
    void diagnostic(const live::Diagnostic& diagnostic, bool first) const;

    // doctor_dialog.cpp
    void doctorDialog();
    void cure();
    bool updateDoctor();

    // dialogs.cpp
    void dialogs();
    bool beginDialog(Dialog which, const char* title);
    void help();
    void savePicture();
    void recordTurn();
    void recording();
    void dropped();
    void press(int key, bool control, bool shift);
    void copyCommand();
    void openPage(const std::string& path);

    Viewer& viewer;
    Window& window;
    std::string search, notice;
    bool panelShown = true, thumbnailsWanted = false, closeLists = false, searching = false;
    std::optional<float> newScale;
    int toolbarLines = 1;  // as many as its width needs
    int chosenTab = -1;    // one that is to come to the front

    Picture picture;
    int pictureVersion = -1;
    bool pictureSmooth = false;
    std::map<std::string, Picture> thumbnails;  // by the file's name; without a texture: there is none
    int thumbnailBudget = 0;                    // of this frame

    bool magnifying = false, draggingDivider = false;
    int magnification = 16;
    std::optional<Viewer::Point> pointed;  // the pixel below the mouse

    PixelTeller teller;           // of the kept pixel
    Errand lifePage, everywhere;  // its life as a page; a value of it in every pixel
    std::string shownName;        // of that value
    bool pixelTabShown = false;
    int step = 0, shownStep = -1;  // of the pixel's values, from 0

    Errand doctor, cured;
    Picture evidence;
    struct
    {
        TextureSlot slot = {};
        std::string file;
        std::string words;    // the diagnosis, or why there is none
        float height = 0.0f;  // of the evidence, in pixels
    } examined;
    int cures = 0;

    Dialog dialog = Dialog::none;
    std::string dialogProblem, savePath, turnFolder;
    int turnFrames = 36;
    std::optional<Turn> turn;
    std::vector<std::string> droppedFiles;
};

}  // namespace relief::samples

// What is shown and what the user has chosen, without a window: a stage that follows its file, its properties, camera,
// size and files, and the picture beside it. A window calls these functions, and update() when there is news.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "live/session.h"
#include "options.h"
#include "view/pixels.h"

namespace relief::samples {

// How the picture's size follows the window's.
enum class Fit
{
    fixed,
    wide,  // 16:9, as large as there is room
    all    // all the room
};

// What a stage can read from a file.
struct Slot
{
    const char* name;                    // "mesh", "albedo", ...
    std::optional<TextureSlot> texture;  // none: the mesh
    std::string usual;                   // the stage's own

    std::string& in(InputFiles& files) const { return texture ? files.textures[*texture] : files.mesh; }
};

class Viewer
{
public:
    enum class Beside
    {
        nothing,
        stage,
        golden,
        snapshot,
        goal  // of an exercise, whose file this is
    };
    struct Snapshot
    {
        std::string name;
        Pixels picture;
    };
    struct Point
    {
        int x, y;
    };

    // The settings, files and size of the options, which hold until another stage is opened.
    Viewer(live::Maker& maker, const RenderOptions& options, const live::Look& look);

    // --- the stage ---
    Expected<void> open(const live::StageSource& source);
    void step(int direction);  // to the next one of the book, or the one before
    const live::Session& session() const { return *current; }
    const live::Description* stage() const { return current->stage(); }
    std::string name() const;  // "1.12 Bump scale"
    const std::vector<Property>& properties() const;
    const std::vector<live::ViewName>& views() const;  // for Look::show

    // --- its properties; a value is cut to its range ---
    glm::vec4 value(const Property& property) const;
    bool isChanged(const Property& property) const;
    void set(const Property& property, glm::vec4 value);
    void reset(const Property& property);
    void resetAll();  // the camera too

    // --- camera and light ---
    Camera camera() const;
    bool setCamera(const Camera& camera);  // false: one that is not possible
    void resetCamera();
    void turnLight(float pitch, float yaw);  // degrees; nothing where the stage has no such light

    // --- everything else that is drawn: size, threads, files, lines ---
    const live::Look& look() const { return wanted; }
    void change(const live::Look& look);
    void fitTo(int width, int height);  // the room that there is
    std::vector<Slot> slots() const;

    // --- the picture beside it ---
    Expected<void> compareWith(const live::StageSource& source);
    Expected<void> compareWithGolden();
    void compareWithSnapshot(std::size_t index);
    bool hasGoal() const { return goal.has_value(); }
    Expected<void> compareWithGoal();
    void compareWithStageBefore();  // and back: F2
    void compareWithNothing();
    void keepSnapshot();
    Beside besideKind() const { return kind; }
    const std::string& besideName() const { return otherName; }
    const Pixels& besidePicture() const { return other; }
    bool besideHasProblem() const { return second && second->problem() != nullptr; }
    void setDivider(float fraction);  // of the width, from the left
    void setDifference(bool shown);
    void setGrid(bool shown);         // the other one, this one and their difference, in a picture of twice the size
    void setEnlargement(int factor);  // of the difference
    float divider() const { return dividerAt; }
    bool showsDifference() const { return differenceShown; }
    bool showsGrid() const { return gridShown && canCompare(); }
    bool showsDivider() const { return canCompare() && !differenceShown && !gridShown; }
    int enlargement() const { return enlarged; }
    bool canCompare() const { return kind != Beside::nothing && !other.empty() && other.sameSize(own); }

    // --- what is to be seen ---
    const Pixels& picture() const { return own; }  // of the stage
    const Pixels& pointable();                     // what the mouse points into: shown(), or of three this one
    const Pixels& shown();                         // with the one beside it
    const Difference& difference();                // where canCompare()
    int dividerColumn() const;
    std::string command(const std::string& output) const;  // that renders picture()

    // Hears from the sessions; true if something is to be drawn again. Never waits.
    bool update();
    std::vector<int> descriptors() const;
    std::chrono::milliseconds patience() const;
    bool idle() const { return current->idle() && (!second || second->idle()); }
    void ask();  // draws what is wanted now

    // Where the learner's file is right and what was asked for is not: one line. Empty: all is well.
    std::string refusal;

    Fit fit = Fit::fixed;
    std::vector<Snapshot> snapshots;
    std::optional<Point> kept;      // a pixel whose values stay in sight
    std::vector<float> frameTimes;  // milliseconds, the last one last
    int version = 0;                // of shown(): another number, another picture

private:
    void takeValues();
    void hear(const live::Session::News& news);
    void refuse();
    void setBeside(Beside its, std::string name);
    void changed();

    live::Maker& maker;
    std::string compiler;
    live::Look wanted, lastGood;
    std::vector<std::string> given;  // settings of the command line, until the stage's properties are known
    std::map<std::string, glm::vec4> values;
    std::unique_ptr<live::Session> current, second;

    Pixels own, other, composed;
    Beside kind = Beside::nothing;
    std::string otherName;
    bool differenceShown = false, gridShown = false;
    std::optional<live::StageSource> goal;
    int enlarged = 8;
    float dividerAt = 0.5f;
    Difference lastDifference;
    bool composedIsOld = true, differenceIsOld = true;

    struct Size
    {
        Fit fit;
        int width, height;
    };
    std::optional<Size> sizeBefore;  // a golden has its own
};

}  // namespace relief::samples

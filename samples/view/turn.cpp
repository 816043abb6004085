#include "view/turn.h"

#include <cstdio>
#include <filesystem>

#include "relief/path.h"
#include "view/orbit.h"

namespace relief::samples {

Expected<Turn> Turn::begin(Viewer& viewer, const std::string& folder, int frames)
{
    std::error_code error;
    std::filesystem::create_directories(pathOf(folder), error);
    if (error) return fail(folder + ": cannot make the folder (" + error.message() + "); choose another");
    Turn turn;
    turn.frames = frames;
    turn.folder = folder;
    turn.stem = viewer.session().source().stem;
    turn.before = viewer.look().camera;
    turn.start = viewer.camera();
    turn.ask(viewer);
    return turn;
}

void Turn::ask(Viewer& viewer) const
{
    const float degrees = 360.0f * static_cast<float>(written) / static_cast<float>(frames);
    viewer.setCamera(orbited(start, degrees, 0.0f));
}

Expected<void> Turn::update(Viewer& viewer)
{
    if (done() || !viewer.session().idle()) return {};
    if (viewer.session().problem() != nullptr) return fail("the turn stopped: the stage gives no picture");
    char name[16];
    std::snprintf(name, sizeof name, "_%03d.png", written);
    const Expected<void> saved = writePixels(folder + "/" + stem + name, viewer.picture());
    if (!saved) return saved;
    if (++written < frames) ask(viewer);
    return {};
}

void Turn::end(Viewer& viewer)
{
    live::Look look = viewer.look();
    look.camera = before;
    viewer.change(look);
}

}  // namespace relief::samples

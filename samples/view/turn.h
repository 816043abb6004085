// A turn of the camera around what it looks at, as one PNG for each frame.
#pragma once

#include <string>

#include "view/viewer.h"

namespace relief::samples {

class Turn
{
public:
    // Makes the folder where it is missing. Frames go into folder/NAME_000.png and so on.
    static Expected<Turn> begin(Viewer& viewer, const std::string& folder, int frames);

    // Writes the frame that was drawn, and asks for the next one. Call it after Viewer::update().
    Expected<void> update(Viewer& viewer);

    bool done() const { return written == frames; }
    void end(Viewer& viewer);  // the camera goes back to where it was

    int written = 0, frames = 0;

private:
    void ask(Viewer& viewer) const;

    std::string folder, stem;
    std::optional<Camera> before;
    Camera start;
};

}  // namespace relief::samples

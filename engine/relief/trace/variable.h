// One name of a traced program over the whole picture: the value that its line gives, for every pixel. And where
// something that is not finite first appears.
#pragma once

#include <optional>

#include "relief/pipeline/inspect.h"
#include "relief/trace/recorder.h"

namespace relief::inline RELIEF_WIDTH::trace {

// "tangentSpaceNormal@57", "albedo@81:length": a name as the source has it, the line that gives it a value, and how it
// is shown: `range` (between the smallest and largest, the default), `colour` (0 to 1, as a screen shows it), `unit`
// (-1 to 1), `length`, `sign` (-1, 0 or 1), or one of its components, `x` to `w`.
inline bool namesVariable(const std::string& view)
{
    return view.find('@') != std::string::npos;
}

// As inspect() does with a view. Of several draws the last one's that was drawn there counts, and of a loop the last
// round's. An error for a line that gives no such value in any pixel names those that there are.
Expected<Inspection> inspectVariable(Frame& frame, const std::string& view);

struct NotFinite
{
    int x, y;
    int draw;
    Site site;
    std::string field;  // of a struct
    float value;
};

// Runs the frame: the first pixel, row by row from the upper left, in which some line's value is NaN or infinite, and
// the first such line there. Nothing where all are finite.
std::optional<NotFinite> firstNotFinite(Frame& frame);

}  // namespace relief::inline RELIEF_WIDTH::trace

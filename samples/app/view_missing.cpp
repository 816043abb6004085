// In place of view.cpp where SDL2 was not found.
#include "commands.h"

namespace relief::samples {

Expected<void> view(const RenderOptions&, int)
{
    return fail(
        "view: this build has no window, SDL2 was not found; install libsdl2-dev and build again "
        "(`relief render` works without it)");
}

}  // namespace relief::samples

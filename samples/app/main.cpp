// The program relief: pictures of stages, and what can be said of them. Measurements are programs of their own, so that
// nobody who wants a picture builds them.
#include "command_line.h"
#include "commands.h"
#include "doctor/command.h"
#include "grader/commands.h"
#include "grader/submission.h"
#include "trace/command.h"

namespace {

using namespace relief;
using namespace relief::samples;

#if defined(RELIEF_HAS_WINDOW)
constexpr auto showWindow = view;
constexpr auto measureSaves = benchLive;
#else
constexpr Expected<void> (*measureSaves)(const LiveBenchOptions&) = nullptr;
Expected<void> showWindow(const ViewOptions&)
{
    return fail(
        "view: this build has no window (`relief render` works without one); a clone of the sources has one in "
        "./relief "
        "view, with libsdl2-dev and libimgui-dev; if they were not there at first, delete the build's CMakeCache.txt");
}
#endif

}  // namespace

int main(int argc, char** argv)
{
    return runProgram(argc, argv,
                      {.list = list,
                       .render = render,
                       .renderScene = renderScene,
                       .renderAtEverySave = renderAtEverySave,
                       .newStage = newStage,
                       .gallery = gallery,
                       .view = showWindow,
                       .hash = hash,
                       .signature = signature,
                       .explain = explain,
                       .trace = traceStage,
                       .benchLive = measureSaves,
                       .exercise = exercise,
                       .checkExercise = checkExercise,
                       .grade = grade,
                       .renderSubmission = grader::renderSubmission,
                       .doctor = examineMap});
}

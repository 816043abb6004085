// The program relief, and relief_view, which has no stages: all that is done with a stage, by a command or in the
// window. Pictures alone have a program without the rest (pictures_main.cpp), and measurements are programs of their
// own, so that nobody builds them who wants a picture.
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

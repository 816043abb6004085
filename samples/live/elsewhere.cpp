// Where there is no Linux: what needs live stages says so.
#include "live/load.h"
#include "live/new_stage.h"
#include "live/session.h"

namespace relief::samples::live {

namespace {

tl::unexpected<Error> needsLinux()
{
    return fail("stages are compiled while the program runs on Linux only; build the stage with relief_add_stage()");
}

}  // namespace

bool namesFile(const std::string& stage)
{
    return stage.ends_with(".cpp");
}
Expected<StageSource> findSource(const std::string&)
{
    return needsLinux();
}
Expected<const Stage*> loadStage(const std::string&)
{
    return needsLinux();
}
Expected<void> writeNewStage(const std::string&, const std::string&)
{
    return needsLinux();
}

}  // namespace relief::samples::live

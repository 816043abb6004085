// What stands in programs of pictures in the place of all that no stage's picture needs: scenes of files, and the
// values of a program's lines.
#include "common/scene.h"
#include "relief/trace/variable.h"

namespace relief::inline RELIEF_WIDTH::trace {

Expected<Inspection> inspectVariable(Frame&, const std::string& view)
{
    return fail("--show " + view + ": this program compiles no stages; `./relief render` does");
}

}  // namespace relief::inline RELIEF_WIDTH::trace

namespace relief::samples {

Expected<std::shared_ptr<const LitScene>> readLitScene(const std::string& path)
{
    return fail(path + ": this program draws stages alone; `./relief render --scene " + path + "` draws a scene");
}

void Scene::drawFile(const Surroundings&) const {}  // of none that was read

}  // namespace relief::samples

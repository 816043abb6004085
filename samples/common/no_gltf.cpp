// What stands in programs of pictures in the place of the engine's reader of glTF.
#include "relief/scene/gltf.h"

namespace relief::inline RELIEF_WIDTH {

Expected<SceneFile> readGltf(const std::string& path)
{
    return fail(path + ": this program draws stages alone; `./relief render --scene " + path + "` draws a scene");
}

}  // namespace relief::inline RELIEF_WIDTH

// What scene.h says of a user's glTF file. Programs of pictures have pictures_only.cpp in its place.
#include "common/lit_scene.h"
#include "common/scene.h"
#include "relief/scene/gltf.h"

namespace relief::samples {

Expected<std::shared_ptr<const LitScene>> readLitScene(const std::string& path)
{
    return readGltf(path).map([](SceneFile&& file) { return std::make_shared<const LitScene>(std::move(file)); });
}

void Scene::drawFile(const Surroundings& day) const
{
    const Surroundings light = inputs.usersScene->lightOf(day);
    const SceneFile& file = inputs.usersScene->file();
    for (const std::string& line : file.notes) note(line);
    for (const auto& texture : file.textures) log.textures.insert(texture.get());
    // The sun's shadows stay as long as the sun does.
    if (!log.sunShadow || log.sunShadow->sun != firstLane(light.sun.dir)) {
        Expected<SunShadow> shadow = inputs.usersScene->shadowOf(light.sun.dir, frame.options().threads);
        if (!shadow) {
            log.problem = shadow.error().message;
            return;
        }
        log.sunShadow = std::make_shared<SunShadow>(std::move(*shadow));
    }
    Surroundings shadowed = light;
    shadowed.shadow = log.sunShadow.get();
    if (const auto drawn = inputs.usersScene->draw(frame, {clipFromWorld, cameraPosition}, shadowed); !drawn) {
        log.problem = drawn.error().message;
    }
}

}  // namespace relief::samples

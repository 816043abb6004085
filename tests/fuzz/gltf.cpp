// Any bytes as a glTF file: an error of one line, or a scene whose meshes are valid and whose numbers name what is
// there.
#include "relief/scene/gltf.h"

#include <cstdlib>

#include "file_in_memory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const FileInMemory file(data, size);
    const relief::Expected<relief::SceneFile> scene = relief::readGltf(file.path());
    if (!scene) {
        if (scene.error().message.find('\n') != std::string::npos) std::abort();
        return 0;
    }
    for (const relief::Mesh& mesh : scene->meshes) {
        if (!relief::validate(mesh).has_value() || mesh.uvs.empty() || mesh.colors.empty()) std::abort();
    }
    for (const relief::SceneInstance& instance : scene->instances) {
        if (instance.mesh >= scene->meshes.size() || instance.material >= scene->materials.size()) std::abort();
        const bool needsTangents = scene->materials[instance.material].hasNormalMap();
        if (needsTangents && scene->meshes[instance.mesh].tangents.empty()) std::abort();
    }
    for (const relief::SceneLight& light : scene->lights) {
        const bool isSpot = light.kind == relief::SceneLight::Kind::spot;
        if (!(light.intensity >= 0.0f) || !(light.range > 0.0f) || (isSpot && !(light.cosOuter <= light.cosInner)))
            std::abort();
    }
    return scene->instances.empty() ? (std::abort(), 1) : 0;
}

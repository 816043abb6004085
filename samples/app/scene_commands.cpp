// `render --scene`: a glTF file, lit.
#include <cstdio>

#include "commands.h"
#include "common/lit_scene.h"
#include "common/read_environment.h"
#include "relief/path.h"
#include "relief/pipeline/save.h"
#include "relief/scene/gltf.h"

namespace relief::samples {

Expected<void> renderScene(const RenderOptions& options, const std::string& output)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    Expected<SceneFile> file = readGltf(options.scene);
    if (!file) return tl::unexpected(file.error());
    for (const std::string& note : file->notes)
        std::fprintf(stderr, "relief: %s: %s\n", options.scene.c_str(), note.c_str());
    LitScene scene(std::move(*file));
    if (!options.camera.empty()) {
        const Expected<Camera> camera = parseCamera(options.camera);
        if (!camera) return tl::unexpected(camera.error());
        scene.lookFrom(*camera);
    }
    Expected<Framebuffer> target =
        Framebuffer::create(size->width, size->height, Format::rgba8Srgb, Store::discard, options.samples);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {.threads = options.threads, .tileSize = options.tileSize});
    Surroundings light = scene.lightOf(usualSurroundings());
    std::optional<Environment> environment;
    if (!options.files.textures[TextureSlot::environment].empty()) {
        Expected<Environment> read = readEnvironment(options.files.textures[TextureSlot::environment], options.threads);
        if (!read) return tl::unexpected(read.error());
        environment = std::move(*read);
        light.sky = environment->irradiance;
        light.mirrored = &environment->mirrored;
    }
    const Expected<SunShadow> shadow = scene.shadowOf(light.sun.dir, options.threads);
    if (!shadow) return tl::unexpected(shadow.error());
    light.shadow = &*shadow;
    if (const auto recorded = scene.record(frame, size->width, size->height, light); !recorded) {
        return tl::unexpected(recorded.error());
    }
    frame.run();
    const std::string path = output.empty() ? utf8Of(pathOf(options.scene).stem()) + ".png" : output;
    std::vector<std::uint8_t> picture = bytesOf(*target);
    for (std::size_t i = 3; i < picture.size(); i += 4) picture[i] = 255;  // blending leaves less where it was
    if (const Expected<void> written = writePng(path, size->width, size->height, picture); !written) return written;
    std::printf("%s\n", path.c_str());
    return {};
}

}  // namespace relief::samples

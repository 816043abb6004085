#include "common/read_environment.h"

#include <functional>
#include <utility>

#include "relief/pipeline/workers.h"
#include "relief/texture/image.h"

namespace relief::samples {

Expected<Environment> readEnvironment(const std::string& path, int threads)
{
    const Expected<ImageFile> picture = readImage(path);
    if (!picture) return tl::unexpected(picture.error());
    const auto inFile = [&path](const Error& error) { return fail(path + ": " + error.message); };
    Expected<CubeMap> map = CubeMap::fromPicture(*picture, ColorSpace::srgb);
    if (!map) return inFile(map.error());
    const SphericalHarmonics irradiance = irradianceOf(*map);
    if (isPrefiltered(*map)) return Environment{*map, *map, irradiance};
    Workers workers(threads);
    const auto run = [&workers](int tasks, const std::function<void(int)>& function) {
        workers.run(tasks, [&function](int task, int) { function(task); });
    };
    const Expected<ImageFloat> levels = prefilteredEnvironment(*map, {.side = 128, .samples = 256}, run);
    if (!levels) return inFile(levels.error());
    Expected<CubeMap> mirrored = CubeMap::fromPicture(*levels, ColorSpace::linear);
    if (!mirrored) return inFile(mirrored.error());
    return Environment{std::move(*map), std::move(*mirrored), irradiance};
}

}  // namespace relief::samples

#include "prepare.h"

#include <charconv>

#include "live/load.h"

namespace relief::samples {

Expected<Size> parseSize(const std::string& text)
{
    const Error error = {"--size " + text + ": write WIDTHxHEIGHT, each from 1 to " + std::to_string(kMaxTargetSize) +
                         ", such as 960x540"};
    const char* const end = text.data() + text.size();
    Size size{};
    const auto [separator, widthError] = std::from_chars(text.data(), end, size.width);
    if (widthError != std::errc() || separator == end || *separator != 'x') return tl::unexpected(error);
    const auto [rest, heightError] = std::from_chars(separator + 1, end, size.height);
    if (heightError != std::errc() || rest != end) return tl::unexpected(error);
    const auto possible = [](int side) { return side >= 1 && side <= kMaxTargetSize; };
    if (!possible(size.width) || !possible(size.height)) return tl::unexpected(error);
    return size;
}

Expected<const Stage*> stageOf(const std::string& name)
{
    return live::namesFile(name) ? live::loadStage(name) : findStage(name);
}

Expected<Camera> parseCamera(const std::string& text)
{
    const Error error = {"--camera " + text +
                         ": write X,Y,Z, such as 1,1,-2, 0.1 to 90 from the origin and not straight above or below"};
    Camera camera;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int i = 0; i < 3; ++i) {
        const auto [rest, failure] = std::from_chars(at, end, camera.position[i]);
        const bool separated = i == 2 ? rest == end : rest != end && *rest == ',';
        if (failure != std::errc() || !separated) return tl::unexpected(error);
        at = rest + 1;
    }
    const glm::vec3& p = camera.position;
    const float square = p.x * p.x + p.y * p.y + p.z * p.z;
    const bool overhead = p.x == 0.0f && p.z == 0.0f;
    if (!(square >= 0.01f && square <= 8100.0f) || overhead) return tl::unexpected(error);
    return camera;
}

Expected<PreparedStage> prepare(const RenderOptions& options)
{
    const Expected<const Stage*> stage = stageOf(options.stage);
    if (!stage) return tl::unexpected(stage.error());
    Expected<PreparedStage> prepared = PreparedStage::prepare(**stage, options.settings, options.files);
    if (prepared && !options.camera.empty()) {
        const Expected<Camera> camera = parseCamera(options.camera);
        if (!camera) return tl::unexpected(camera.error());
        prepared->usersCamera = *camera;
    }
    if (prepared && options.showTangents) prepared->tangentLines = {options.tangentOffset, options.tangentScale};
    return prepared;
}

Expected<live::Look> lookOf(const RenderOptions& options)
{
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    live::Look look{.width = size->width,
                    .height = size->height,
                    .camera = {},
                    .settings = options.settings,
                    .files = options.files,
                    .threads = options.threads,
                    .showTangents = options.showTangents,
                    .tangentScale = options.tangentScale,
                    .tangentOffset = options.tangentOffset,
                    .show = options.show};
    if (options.camera.empty()) return look;
    const Expected<Camera> camera = parseCamera(options.camera);
    if (!camera) return tl::unexpected(camera.error());
    look.camera = *camera;
    return look;
}

}  // namespace relief::samples

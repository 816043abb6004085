#include "prepare.h"

#include <charconv>

#include "live/load.h"
#include "trace/traced_stage.h"

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

std::string exactText(float number)
{
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

bool isPossible(const Camera& camera)
{
    const glm::vec3 d = camera.position - camera.target;
    const float square = d.x * d.x + d.y * d.y + d.z * d.z;
    const glm::vec3& t = camera.target;
    const bool near = t.x * t.x + t.y * t.y + t.z * t.z <= 8100.0f;
    const bool planes = camera.nearPlane > 0.0f && camera.farPlane > camera.nearPlane && camera.farPlane <= 1e6f;
    return near && planes && square >= 0.01f && square <= 8100.0f && (d.x != 0.0f || d.z != 0.0f) &&
           camera.fieldOfView >= 1.0f && camera.fieldOfView <= 170.0f;
}

Expected<Camera> parseCamera(const std::string& text)
{
    const Error error = {"--camera " + text +
                         ": write X,Y,Z, such as 1,1,-2, or with what it looks at X,Y,Z,X,Y,Z, then the field of view "
                         "in degrees, then the two planes; 0.1 to 90 from there and not straight above or below"};
    Camera camera;
    float* const numbers[] = {&camera.position.x,  &camera.position.y, &camera.position.z,
                              &camera.target.x,    &camera.target.y,   &camera.target.z,
                              &camera.fieldOfView, &camera.nearPlane,  &camera.farPlane};
    const char* at = text.data();
    const char* const end = at + text.size();
    std::size_t count = 0;
    for (float* const number : numbers) {
        const auto [rest, failure] = std::from_chars(at, end, *number);
        if (failure != std::errc() || (rest != end && *rest != ',')) return tl::unexpected(error);
        ++count;
        at = rest + 1;
        if (rest == end) break;
    }
    const bool complete = count == 3 || count == 6 || count == 7 || count == 9;
    if (!complete || at != end + 1 || !isPossible(camera)) return tl::unexpected(error);
    return camera;
}

std::string cameraText(const Camera& camera)
{
    const Camera usual;
    std::vector<float> numbers = {camera.position.x, camera.position.y, camera.position.z};
    const bool planes = camera.nearPlane != usual.nearPlane || camera.farPlane != usual.farPlane;
    const bool field = planes || camera.fieldOfView != usual.fieldOfView;
    if (field || camera.target != usual.target) {
        numbers.insert(numbers.end(), {camera.target.x, camera.target.y, camera.target.z});
    }
    if (field) numbers.push_back(camera.fieldOfView);
    if (planes) numbers.insert(numbers.end(), {camera.nearPlane, camera.farPlane});
    std::string text;
    for (const float number : numbers) text += (text.empty() ? "" : ",") + exactText(number);
    return text;
}

Expected<PreparedStage> prepare(const RenderOptions& options)
{
    const Expected<const Stage*> stage = stageOf(options.stage);
    if (!stage) return tl::unexpected(stage.error());
    return prepare(**stage, options);
}

Expected<PreparedStage> prepareTraced(const RenderOptions& options)
{
    const Expected<trace::TracedStage> stage = trace::loadTraced(options.stage);
    if (!stage) return tl::unexpected(stage.error());
    return prepare(*stage->traced, options);
}

Expected<PreparedStage> prepare(const Stage& stage, const RenderOptions& options)
{
    Expected<PreparedStage> prepared = PreparedStage::prepare(stage, options.settings, options.files);
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
                    .tileSize = options.tileSize,
                    .samples = options.samples,
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

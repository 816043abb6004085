#include "common/render.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "relief/decimal.h"

namespace relief::samples {

namespace {

// A number as it is written: "0.5", not "0.500000".
std::string text(float number)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", static_cast<double>(number));
    return buffer;
}

// "0 (off), 1 (on)".
std::string choicesOf(const Property& property)
{
    if (property.choices.empty()) return "0 (off), 1 (on)";
    std::string all;
    for (std::size_t i = 0; i < property.choices.size(); ++i) {
        all += (i > 0 ? ", " : "") + std::to_string(i) + " (" + property.choices[i] + ")";
    }
    return all;
}

}  // namespace

Expected<void> applySetting(const std::string& setting, const std::string& stageId, std::vector<Property>& properties)
{
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) return fail("--set " + setting + ": write name=value");
    const std::string name = setting.substr(0, equals);
    Property* property = nullptr;
    std::string names;
    for (Property& p : properties) {
        if (p.name == name) property = &p;
        names += (names.empty() ? "" : ", ") + p.name;
    }
    if (property == nullptr) {
        return fail("--set " + setting + ": stage " + stageId + " has no property '" + name + "'; it has " +
                    (names.empty() ? "none" : names));
    }

    const char* at = setting.data() + equals + 1;
    const char* const end = setting.data() + setting.size();
    for (int i = 0; i < property->components; ++i) {
        const char* const rest = std::find(at, end, ',');
        const std::optional<float> parsed = parseDecimal({at, static_cast<std::size_t>(rest - at)});
        const bool last = rest == end;
        if (!parsed || (!last && i + 1 == property->components)) {
            return fail("--set " + setting + ": '" + std::string(setting, equals + 1) + "' is not " +
                        (property->components == 1
                             ? std::string("a number")
                             : "up to " + std::to_string(property->components) + " numbers with commas between them"));
        }
        const float number = *parsed;
        if (number < property->minimum || number > property->maximum) {
            return fail("--set " + setting + ": " + text(number) + " is outside the range of " + name + ", " +
                        text(property->minimum) + " to " + text(property->maximum));
        }
        if (property->isWhole() && number != std::floor(number)) {
            return fail("--set " + setting + ": " + name + " is one of " + choicesOf(*property));
        }
        property->value[i] = number;
        if (last) break;
        at = rest + 1;
    }
    return {};
}

Expected<PreparedStage> PreparedStage::prepare(const Stage& stage, const std::vector<std::string>& settings,
                                               const InputFiles& files)
{
    PreparedStage prepared;
    prepared.stage = &stage;
    prepared.properties = stage.properties();
    for (const std::string& setting : settings) {
        const Expected<void> result = applySetting(setting, stage.id, prepared.properties);
        if (!result) return tl::unexpected(result.error());
    }
    Expected<std::unique_ptr<LoadedInputs>> inputs = loadInputs(stage.inputs(), files);
    if (!inputs) return tl::unexpected(inputs.error());
    prepared.inputs = std::move(*inputs);
    prepared.log = std::make_unique<SceneLog>();
    return prepared;
}

const Camera& PreparedStage::camera() const
{
    static const Camera facing = {.position = {0.0f, 0.4f, -1.7f}};
    if (usersCamera) return *usersCamera;
    return inputs->usersMesh.has_value() ? facing : stage->camera;
}

void PreparedStage::record(Frame& frame, int width, int height, const Camera& camera) const
{
    frame.reset();
    frame.clear(kBackground);
    log->clear();
    const Scene drawn = scene(frame, width, height, camera);
    stage->draw(drawn);
    if (tangentLines) drawn.showTangents(*tangentLines);
}

Scene PreparedStage::scene(Frame& frame, int width, int height, const Camera& camera) const
{
    return Scene(frame, *log, width, height, camera, *inputs, properties);
}

}  // namespace relief::samples

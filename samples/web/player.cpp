#include "web/player.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "common/inside.h"
#include "view/orbit.h"

namespace relief::samples {

namespace {

using nlohmann::json;

constexpr const char* kKinds[] = {"number", "vector", "color", "toggle", "choice"};
constexpr int kGoldenWidth = 480, kGoldenHeight = 270;

json described(const Property& property)
{
    json value = json::array();
    for (int i = 0; i < property.components; ++i) value.push_back(property.value[i]);
    return {{"name", property.name},
            {"kind", kKinds[static_cast<std::size_t>(property.kind)]},
            {"value", value},
            {"minimum", property.minimum},
            {"maximum", property.maximum},
            {"meaning", property.meaning},
            {"choices", property.choices}};
}

}  // namespace

Expected<Player> Player::open(const std::string& name)
{
    const Expected<const Stage*> found = findStage(name);
    if (!found) return tl::unexpected(found.error());
    Player player;
    player.source = *found;
    return player;
}

std::string Player::description() const
{
    json files = json::array(), properties = json::array();
    PerTexture<Inputs::TextureInput> textures = source->inputs().textures;
    textures[TextureSlot::environment].file.clear();  // it is made, not read
    for (const Inputs::TextureInput& texture : textures) {
        const bool isNew = std::find(files.begin(), files.end(), texture.file) == files.end();
        if (!texture.file.empty() && texture.file != kNone && isNew) files.push_back(texture.file);
    }
    for (const Property& property : source->properties()) properties.push_back(described(property));
    return json{{"stage", source->name()}, {"files", files}, {"properties", properties}}.dump();
}

Expected<void> Player::load()
{
    Expected<PreparedStage> prepared = PreparedStage::prepare(*source);
    if (!prepared) return tl::unexpected(prepared.error());
    stage = std::move(*prepared);
    return {};
}

Expected<std::string> Player::views() const
{
    Expected<Framebuffer> target = Framebuffer::create(16, 9, Format::rgba8Srgb);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target);
    stage->record(frame, 16, 9);
    json all = json::array();
    for (const View& view : viewsOf(frame)) all.push_back({{"name", view.name}, {"meaning", view.meaning}});
    return all.dump();
}

Expected<void> Player::set(const std::string& setting)
{
    return applySetting(setting, source->id, stage->properties);
}

void Player::reset()
{
    stage->properties = source->properties();
    stage->usersCamera.reset();
}

void Player::orbit(float yaw, float pitch)
{
    stage->usersCamera = orbited(stage->camera(), yaw, pitch);
}

void Player::zoom(float factor)
{
    stage->usersCamera = zoomed(stage->camera(), factor);
}

void Player::move(float right, float up)
{
    stage->usersCamera = moved(stage->camera(), right, up);
}

std::string Player::camera() const
{
    const Camera& its = stage->camera();
    return json{its.position.x, its.position.y, its.position.z, its.target.x, its.target.y, its.target.z}.dump();
}

Expected<void> Player::look(const std::string& text)
{
    const json numbers = json::parse(text, nullptr, false);
    const bool areNumbers = numbers.is_array() && numbers.size() == 6 &&
                            std::all_of(numbers.begin(), numbers.end(), [](const json& n) { return n.is_number(); });
    if (!areNumbers) return fail("camera " + text + ": is not [x, y, z, x, y, z], its place and what it looks at");
    Camera its = source->camera;
    for (int i = 0; i < 3; ++i) {
        its.position[i] = numbers[static_cast<std::size_t>(i)];
        its.target[i] = numbers[static_cast<std::size_t>(i) + 3];
    }
    const float distance = glm::distance(its.position, its.target);
    if (!(distance >= 0.01f && distance <= 100.0f)) {
        return fail("camera " + text + ": must be 0.01 to 100 away from what it looks at");
    }
    stage->usersCamera = its;
    return {};
}

Expected<Framebuffer> Player::render(int width, int height, const std::string& view) const
{
    Expected<Framebuffer> target = Framebuffer::create(width, height, Format::rgba8Srgb);
    if (!target) return target;
    Frame frame(*target);
    stage->record(frame, width, height);
    if (const std::string problem = stage->problem(frame); !problem.empty()) return fail(problem);
    const Expected<Statistics> run = runInside(frame, *target, view, stage->log->labels);
    if (!run) return tl::unexpected(run.error());
    return target;
}

Expected<std::string> Player::restingHash() const
{
    Expected<Framebuffer> target = Framebuffer::create(kGoldenWidth, kGoldenHeight, Format::rgba32f, Store::keep);
    if (!target) return tl::unexpected(target.error());
    const Expected<PreparedStage> resting = PreparedStage::prepare(*source);
    if (!resting) return tl::unexpected(resting.error());
    Frame frame(*target);
    resting->record(frame, kGoldenWidth, kGoldenHeight);
    if (const std::string problem = resting->problem(frame); !problem.empty()) return fail(problem);
    frame.run();
    return hexadecimal(hashOf(*target));
}

}  // namespace relief::samples

#include "view/viewer.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "grader/goal.h"
#include "picture_command.h"
#include "prepare.h"
#include "view/orbit.h"

namespace relief::samples {

namespace {

constexpr std::size_t kTimes = 120;

std::string settingOf(const Property& p, const glm::vec4& value)
{
    std::string text = p.name + "=";
    for (int i = 0; i < p.components; ++i) text += (i > 0 ? "," : "") + exactText(value[i]);
    return text;
}

// The value of "name=1,2" where it is the property's.
std::optional<glm::vec4> valueIn(const std::string& setting, const Property& p)
{
    if (!setting.starts_with(p.name + "=")) return std::nullopt;
    glm::vec4 value = p.value;
    const char* at = setting.data() + p.name.size() + 1;
    const char* const end = setting.data() + setting.size();
    for (int i = 0; i < p.components && at < end; ++i) at = std::from_chars(at, end, value[i]).ptr + 1;
    return value;
}

}  // namespace

Viewer::Viewer(live::Maker& itsMaker, const RenderOptions& options, const live::Look& look)
    : maker(itsMaker), compiler(options.compiler), wanted(look), lastGood(look), given(look.settings)
{
}

// --- the stage ---

Expected<void> Viewer::open(const live::StageSource& source)
{
    live::Look look = wanted;
    if (current) {
        look.settings.clear();
        look.files = {};
        look.camera.reset();
        look.show.clear();
    }
    Expected<std::unique_ptr<live::Session>> opened = live::Session::open(source, look, maker, compiler);
    if (!opened) return tl::unexpected(opened.error());
    if (current) given.clear();
    wanted = lastGood = look;
    current = std::move(*opened);
    compareWithNothing();
    values.clear();
    kept.reset();
    frameTimes.clear();
    refusal.clear();
    goal = grader::goalOf(source);
    return compareWithGoal();
}

void Viewer::step(int direction)
{
    const std::vector<live::StageSource>& all = live::stageSources();
    const auto is = [this](const live::StageSource& s) { return s.path == current->source().path; };
    const auto here = std::find_if(all.begin(), all.end(), is);
    if (here == all.end()) return;
    const auto count = static_cast<std::ptrdiff_t>(all.size());
    const auto next = static_cast<std::size_t>((here - all.begin() + direction + count) % count);
    if (const Expected<void> opened = open(all[next]); !opened) refusal = opened.error().message;
}

std::string Viewer::name() const
{
    const live::StageSource& source = current->source();
    if (stage() == nullptr) return source.id.empty() ? source.stem : source.id + " " + source.stem;
    return source.id.empty() ? stage()->title : source.id + " " + stage()->title;
}

const std::vector<Property>& Viewer::properties() const
{
    static const std::vector<Property> none;
    return stage() != nullptr ? stage()->properties : none;
}

const std::vector<live::ViewName>& Viewer::views() const
{
    static const std::vector<live::ViewName> none;
    return stage() != nullptr ? stage()->views : none;
}

// --- its properties ---

glm::vec4 Viewer::value(const Property& p) const
{
    const auto found = values.find(p.name);
    return found != values.end() ? found->second : p.value;
}

bool Viewer::isChanged(const Property& p) const
{
    return values.count(p.name) != 0;
}

void Viewer::set(const Property& p, glm::vec4 value)
{
    for (int i = 0; i < p.components; ++i) value[i] = std::clamp(value[i], p.minimum, p.maximum);
    bool isDefault = true;
    for (int i = 0; i < p.components; ++i) isDefault = isDefault && value[i] == p.value[i];
    if (isDefault) return reset(p);
    values[p.name] = value;
    ask();
}

void Viewer::reset(const Property& p)
{
    values.erase(p.name);
    ask();
}

void Viewer::resetAll()
{
    values.clear();
    resetCamera();
}

// What the command line says, as values; later ones win.
void Viewer::takeValues()
{
    for (const std::string& setting : given) {
        for (const Property& p : properties()) {
            if (const std::optional<glm::vec4> value = valueIn(setting, p)) values[p.name] = *value;
        }
    }
    given.clear();
}

// --- camera and light ---

Camera Viewer::camera() const
{
    if (wanted.camera) return *wanted.camera;
    if (current->picture().version > 0) return current->picture().drawn.camera;
    return stage() != nullptr ? stage()->camera : Camera();
}

bool Viewer::setCamera(const Camera& camera)
{
    if (!isPossible(camera)) return false;
    wanted.camera = camera;
    ask();
    return true;
}

void Viewer::resetCamera()
{
    wanted.camera.reset();
    ask();
}

void Viewer::turnLight(float pitch, float yaw)
{
    const auto turn = [this](const Property& p, float degrees) {
        float angle = value(p).x + degrees;
        if (angle > 180.0f) angle -= 360.0f;
        if (angle < -180.0f) angle += 360.0f;
        set(p, glm::vec4(angle));
    };
    for (const Property& p : properties()) {
        if (p.name == "lightPitch") turn(p, pitch);
        if (p.name == "lightYaw") turn(p, yaw);
    }
}

// --- everything else that is drawn ---

void Viewer::change(const live::Look& look)
{
    wanted = look;
    ask();
}

void Viewer::fitTo(int width, int height)
{
    if (fit == Fit::fixed || width < 16 || height < 16) return;
    if (showsGrid()) {
        width /= 2;
        height /= 2;
    }
    Size size{fit, std::min(width, kMaxTargetSize), std::min(height, kMaxTargetSize)};
    if (fit == Fit::wide) {
        size.width = std::min(size.width, size.height * 16 / 9);
        size.height = size.width * 9 / 16;
    }
    if (size.width == wanted.width && size.height == wanted.height) return;
    wanted.width = size.width;
    wanted.height = size.height;
    ask();
}

std::vector<Slot> Viewer::slots() const
{
    if (stage() == nullptr) return {};
    const Inputs& inputs = stage()->inputs;
    std::vector<Slot> all = {{"mesh", {}, inputs.mesh}};
    for (std::size_t i = 0; i < inputs.textures.size(); ++i) {
        all.push_back({kTextureOptions[i], static_cast<TextureSlot>(i), inputs.textures[i].file});
    }
    std::erase_if(all, [](const Slot& slot) { return slot.usual.empty(); });
    return all;
}

std::string Viewer::command(const std::string& output) const
{
    return renderCommand("./relief", current->source(), wanted, output);
}

// --- the sessions ---

// Until the stage is known, the session has what it needs.
void Viewer::ask()
{
    if (stage() == nullptr) return;
    wanted.settings.clear();
    for (const Property& p : properties()) {
        if (isChanged(p)) wanted.settings.push_back(settingOf(p, value(p)));
    }
    current->look(wanted);
    if (!second || second->stage() == nullptr) return;
    // The camera only where the two belong together; values of the properties that both have.
    live::Look its = wanted;
    if (second->source().folder != current->source().folder) its.camera.reset();
    if (second->source().path != current->source().path) its.files = {};
    second->look(its);
}

bool Viewer::update()
{
    const live::Session::News news = current->update();
    hear(news);
    if (!second) return news.any();
    const live::Session::News its = second->update();
    if (its.stage) ask();
    if (its.picture) {
        const live::Picture& picture = second->picture();
        other = {picture.drawn.width, picture.drawn.height, picture.pixels};
        changed();
    }
    return news.any() || its.any();
}

void Viewer::hear(const live::Session::News& news)
{
    if (news.problem && current->problem() != nullptr) {
        if (current->problem()->isRefusal) {
            if (current->picture().version > 0) refuse();  // else the program ends with it
        } else {
            std::fputs(current->problem()->text().c_str(), stderr);
        }
    }
    if (news.stage && stage() != nullptr && !given.empty()) takeValues();
    if (!news.picture) return;
    const live::Picture& picture = current->picture();
    own = {picture.drawn.width, picture.drawn.height, picture.pixels};
    if (frameTimes.size() == kTimes) frameTimes.erase(frameTimes.begin());
    frameTimes.push_back(static_cast<float>(picture.drawn.milliseconds));
    if (current->idle()) lastGood = wanted;
    changed();
}

// What was asked for cannot be drawn: back to what could.
void Viewer::refuse()
{
    const bool sameFiles = wanted.files == lastGood.files;
    if (sameFiles && wanted.width == lastGood.width && wanted.height == lastGood.height) return;
    refusal = current->problem()->diagnostics.front().message;
    wanted.files = lastGood.files;
    wanted.width = lastGood.width;
    wanted.height = lastGood.height;
    fit = Fit::fixed;
    ask();
}

std::vector<int> Viewer::descriptors() const
{
    std::vector<int> all = current->descriptors();
    if (!second) return all;
    const std::vector<int> more = second->descriptors();
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

std::chrono::milliseconds Viewer::patience() const
{
    return second ? std::min(current->patience(), second->patience()) : current->patience();
}

}  // namespace relief::samples

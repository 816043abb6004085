// The window: a stage that can be turned, zoomed and changed while it runs, and that follows its file: what is saved is
// compiled, and drawn by another process (live/session.h). SDL2 shows the pixels.
//
//   drag           orbit                     up, down    choose a property
//   wheel          zoom                      + and -     change it (shift: ten times as fast)
//   left, right    previous, next stage      R           everything back to its default
//   F2             before/after: left half the previous stage, right half this one
//   Q, escape      close
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "commands.h"
#include "live/session.h"
#include "window.h"

namespace relief::samples {

namespace {

// The camera on a sphere around its target.
struct Orbit
{
    float yaw = 0.0f, pitch = 0.0f, distance = 1.0f;

    explicit Orbit(const Camera& camera)
    {
        const glm::vec3 d = camera.position - camera.target;
        distance = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        yaw = std::atan2(-d.x, -d.z) / kDegree;
        pitch = std::asin(std::clamp(d.y / distance, -1.0f, 1.0f)) / kDegree;
    }

    Camera applied(Camera camera) const
    {
        const glm::vec4 offset = rotationY(yaw) * (rotationX(pitch) * glm::vec4(0, 0, -distance, 0));
        camera.position = camera.target + glm::vec3(offset);
        return camera;
    }
};

std::string setting(const Property& p, const glm::vec4& value)
{
    std::string text = p.name + "=";
    for (int i = 0; i < p.components; ++i) {
        char number[32];
        std::snprintf(number, sizeof number, "%s%.9g", i > 0 ? "," : "", static_cast<double>(value[i]));
        text += number;
    }
    return text;
}

struct Viewer
{
    live::Maker& maker;
    const RenderOptions& options;
    live::Look look;
    std::unique_ptr<live::Session> current, previous;
    std::map<std::string, glm::vec4> changed;  // properties
    std::size_t property = 0;
    bool running = true, dirty = true;

    Expected<std::unique_ptr<live::Session>> sessionOf(const live::StageSource& source)
    {
        return live::Session::open(source, look, maker, options.compiler);
    }
    Expected<void> open(const live::StageSource& source);
    void step(int direction);
    void compare();
    void key(SDL_Keycode key, bool fast);
    void change(float direction);
    void turn(float yaw, float pitch, float zoom);
    void ask();
    void handleEvents();
    void update(int patience);
    std::vector<std::uint32_t> pixels() const;
    std::string title() const;
};

Expected<void> Viewer::open(const live::StageSource& source)
{
    Expected<std::unique_ptr<live::Session>> opened = sessionOf(source);
    if (!opened) return tl::unexpected(opened.error());
    current = std::move(*opened);
    previous.reset();
    changed.clear();
    property = 0;
    return {};
}

// The stage before this one in the book, or after it.
void Viewer::step(int direction)
{
    const std::vector<live::StageSource>& all = live::stageSources();
    const auto is = [this](const live::StageSource& s) { return s.path == current->source().path; };
    const auto here = std::find_if(all.begin(), all.end(), is);
    if (here == all.end()) return;
    const auto count = static_cast<std::ptrdiff_t>(all.size());
    const auto next = static_cast<std::size_t>((here - all.begin() + direction + count) % count);
    look.settings.clear();
    look.files = {};
    look.camera.reset();
    if (const Expected<void> opened = open(all[next]); !opened) {
        std::fprintf(stderr, "relief: %s\n", opened.error().message.c_str());
    }
}

void Viewer::compare()
{
    if (previous) {
        previous.reset();
        return;
    }
    const std::vector<live::StageSource>& all = live::stageSources();
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].path != current->source().path) continue;
        if (Expected<std::unique_ptr<live::Session>> opened = sessionOf(all[i - 1])) previous = std::move(*opened);
    }
    ask();
}

// Draws what the user sees now.
void Viewer::ask()
{
    if (current->stage() == nullptr) return;
    look.settings = options.settings;
    for (const Property& p : current->stage()->stage.uniforms.properties) {
        if (changed.count(p.name) != 0) look.settings.push_back(setting(p, changed.at(p.name)));
    }
    current->look(look);
    if (!previous) return;
    // The camera only where the two belong together.
    live::Look other = look;
    if (previous->source().folder != current->source().folder) other.camera.reset();
    previous->look(other);
}

void Viewer::change(float direction)
{
    if (current->stage() == nullptr || current->stage()->stage.uniforms.properties.empty()) return;
    const std::vector<Property>& all = current->stage()->stage.uniforms.properties;
    const Property& p = all[std::min(property, all.size() - 1)];
    glm::vec4& value = changed.try_emplace(p.name, p.value).first->second;
    value.x = std::clamp(value.x + (p.maximum - p.minimum) / 200.0f * direction, p.minimum, p.maximum);
    ask();
}

void Viewer::turn(float yaw, float pitch, float zoom)
{
    if (current->picture().version == 0) return;
    const Camera camera = look.camera.value_or(current->picture().drawn.camera);
    Orbit orbit(camera);
    orbit.yaw += yaw;
    orbit.pitch = std::clamp(orbit.pitch + pitch, -89.0f, 89.0f);
    orbit.distance = std::clamp(orbit.distance * zoom, 0.1f, 50.0f);
    look.camera = orbit.applied(camera);
    ask();
}

void Viewer::key(SDL_Keycode pressed, bool fast)
{
    const std::size_t count =
        current->stage() != nullptr ? std::max<std::size_t>(1, current->stage()->stage.uniforms.properties.size()) : 1;
    switch (pressed) {
        case SDLK_q:
        case SDLK_ESCAPE:
            running = false;
            break;
        case SDLK_UP:
            property = (property + count - 1) % count;
            break;
        case SDLK_DOWN:
            property = (property + 1) % count;
            break;
        case SDLK_MINUS:
        case SDLK_KP_MINUS:
            change(fast ? -10.0f : -1.0f);
            break;
        case SDLK_PLUS:
        case SDLK_EQUALS:
        case SDLK_KP_PLUS:
            change(fast ? 10.0f : 1.0f);
            break;
        case SDLK_LEFT:
            step(-1);
            break;
        case SDLK_RIGHT:
            step(1);
            break;
        case SDLK_r:
            changed.clear();
            look.camera.reset();
            ask();
            break;
        case SDLK_F2:
            compare();
            break;
        default:
            break;
    }
}

void Viewer::handleEvents()
{
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) {
        dirty = true;
        if (event.type == SDL_QUIT) running = false;
        if (event.type == SDL_KEYDOWN) key(event.key.keysym.sym, (event.key.keysym.mod & KMOD_SHIFT) != 0);
        if (event.type == SDL_MOUSEWHEEL) turn(0.0f, 0.0f, event.wheel.y > 0 ? 0.9f : 1.11f);
        if (event.type == SDL_MOUSEMOTION && (event.motion.state & SDL_BUTTON_LMASK) != 0) {
            turn(static_cast<float>(event.motion.xrel) * 0.4f, static_cast<float>(event.motion.yrel) * 0.4f, 1.0f);
        }
    }
}

void Viewer::update(int patience)
{
    const live::Session::News news = current->update(std::chrono::milliseconds(patience));
    dirty = dirty || news.any();
    if (news.problem && current->problem() != nullptr) std::fputs(current->problem()->text().c_str(), stderr);
    if (previous) dirty = previous->update().any() || dirty;
}

std::vector<std::uint32_t> Viewer::pixels() const
{
    std::vector<std::uint32_t> all = current->picture().pixels;
    if (!previous || previous->picture().pixels.size() != all.size()) return all;
    const auto width = static_cast<std::size_t>(look.width);
    for (std::size_t row = 0; row < all.size(); row += width) {
        std::copy_n(previous->picture().pixels.data() + row, width / 2, all.data() + row);
    }
    return all;
}

std::string Viewer::title() const
{
    if (current->stage() == nullptr) return current->source().stem + " | compiling ...";
    const Stage& stage = current->stage()->stage;
    char text[256];
    std::string chosen = "no properties";
    if (!stage.uniforms.properties.empty()) {
        const Property& p = stage.uniforms.properties[std::min(property, stage.uniforms.properties.size() - 1)];
        const glm::vec4 value = changed.count(p.name) != 0 ? changed.at(p.name) : p.value;
        std::snprintf(text, sizeof text, "%s = %g", p.name.c_str(), static_cast<double>(value.x));
        chosen = text;
    }
    std::snprintf(text, sizeof text, "%s %s%s | %s | %.1f ms%s", stage.id.c_str(), stage.title.c_str(),
                  previous ? " (left: the stage before)" : "", chosen.c_str(), current->picture().drawn.milliseconds,
                  current->compiling() ? " | compiling ..." : "");
    return text;
}

}  // namespace

Expected<void> view(const RenderOptions& options, int frames)
{
    const Expected<live::StageSource> source = live::findSource(options.stage);
    if (!source) return tl::unexpected(source.error());
    const Expected<live::Look> look = lookOf(options);
    if (!look) return tl::unexpected(look.error());
    const Expected<std::unique_ptr<live::Maker>> maker = live::Maker::start();  // before there is a window
    if (!maker) return tl::unexpected(maker.error());
    Viewer viewer{.maker = **maker, .options = options, .look = *look, .current = {}, .previous = {}, .changed = {}};
    if (const Expected<void> opened = viewer.open(*source); !opened) return opened;

    Window window;
    if (const Expected<void> opened = window.open(look->width, look->height); !opened) return opened;
    int shown = 0;
    while (viewer.running && (frames == 0 || shown < frames)) {
        viewer.handleEvents();
        viewer.update(10);
        if (!viewer.dirty) continue;
        viewer.dirty = false;
        const live::Session& session = *viewer.current;
        const live::Problem* const problem = session.problem();
        if (problem != nullptr && problem->isRefusal && session.picture().version == 0) {
            return fail(problem->diagnostics.front().message);
        }
        window.setTitle(viewer.title());
        window.show(viewer.pixels(), problem != nullptr ? problem->text() : "");
        if (frames > 0 && session.picture().version > 0 && session.idle()) {
            ++shown;
            viewer.ask();
        }
        if (frames > 0 && problem != nullptr) return fail(options.stage + ": see above");
    }
    return {};
}

}  // namespace relief::samples

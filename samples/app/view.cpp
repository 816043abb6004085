// The window: a stage that can be turned, zoomed and changed while it runs. SDL2 shows the pixels; every one of them is
// computed by the engine.
//
//   drag           orbit                     up, down    choose a property
//   wheel          zoom                      + and -     change it (shift: ten times as fast)
//   left, right    previous, next stage      R           everything back to its default
//   F2             before/after: left half the previous stage, right half this one
//   Q, escape      close
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <SDL.h>

#include "commands.h"

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

struct Viewer
{
    const RenderOptions& options;
    std::size_t index = 0;
    PreparedStage current, previous;
    Orbit orbit{Camera{}};
    std::size_t property = 0;
    bool compare = false;
    bool running = true;

    Expected<void> open(std::size_t stage, bool keepSettings);
    void key(SDL_Keycode key, bool fast);
    void change(float direction);
    std::string title(double milliseconds) const;
    void draw(Framebuffer& target, Framebuffer& scratch, Frame& frame, Frame& scratchFrame);
};

Expected<void> Viewer::open(std::size_t stage, bool keepSettings)
{
    const std::vector<std::string> none;
    Expected<PreparedStage> opened = PreparedStage::prepare(allStages()[stage], keepSettings ? options.settings : none,
                                                            keepSettings ? options.files : InputFiles{});
    if (!opened) return tl::unexpected(opened.error());
    Expected<PreparedStage> before = PreparedStage::prepare(allStages()[stage == 0 ? 0 : stage - 1]);
    if (!before) return tl::unexpected(before.error());
    if (options.showTangents) opened->tangentLines = {options.tangentOffset, options.tangentScale};
    index = stage;
    current = std::move(*opened);
    previous = std::move(*before);
    orbit = Orbit(current.camera());
    property = 0;
    return {};
}

void Viewer::change(float direction)
{
    if (current.properties.empty()) return;
    Property& p = current.properties[property];
    const float step = (p.maximum - p.minimum) / 200.0f * direction;
    p.value.x = std::clamp(p.value.x + step, p.minimum, p.maximum);
}

void Viewer::key(SDL_Keycode pressed, bool fast)
{
    const std::size_t properties = std::max<std::size_t>(1, current.properties.size());
    Expected<void> opened;
    switch (pressed) {
        case SDLK_q:
        case SDLK_ESCAPE:
            running = false;
            break;
        case SDLK_UP:
            property = (property + properties - 1) % properties;
            break;
        case SDLK_DOWN:
            property = (property + 1) % properties;
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
            opened = open(index == 0 ? allStages().size() - 1 : index - 1, false);
            break;
        case SDLK_RIGHT:
            opened = open((index + 1) % allStages().size(), false);
            break;
        case SDLK_r:
            opened = open(index, false);
            break;
        case SDLK_F2:
            compare = !compare;
            break;
        default:
            break;
    }
    if (!opened) std::fprintf(stderr, "relief: %s\n", opened.error().message.c_str());
}

std::string Viewer::title(double milliseconds) const
{
    char text[256];
    std::string chosen = "no properties";
    if (!current.properties.empty()) {
        const Property& p = current.properties[property];
        std::snprintf(text, sizeof text, "%s = %g", p.name.c_str(), static_cast<double>(p.value.x));
        chosen = text;
    }
    std::snprintf(text, sizeof text, "%s %s%s | %s | %.1f ms", current.stage->id.c_str(), current.stage->title.c_str(),
                  compare ? " (left: the stage before)" : "", chosen.c_str(), milliseconds);
    return text;
}

void Viewer::draw(Framebuffer& target, Framebuffer& scratch, Frame& frame, Frame& scratchFrame)
{
    const int width = target.width(), height = target.height();
    const Camera camera = orbit.applied(current.camera());
    current.record(frame, width, height, camera);
    frame.run();
    if (!compare) return;

    // The previous stage, with the same camera where the two belong together and the same values of the properties that
    // both have; its left half is shown.
    for (Property& p : previous.properties) {
        for (const Property& mine : current.properties) {
            if (mine.name == p.name) p.value = mine.value;
        }
    }
    const bool together = previous.stage->folder == current.stage->folder;
    previous.record(scratchFrame, width, height, together ? camera : previous.camera());
    scratchFrame.run();
    for (int y = 0; y < height; ++y) {
        const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        std::copy_n(scratch.color8().data() + row, width / 2, target.color8().data() + row);
    }
}

bool handleEvents(Viewer& viewer)
{
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) {
        if (event.type == SDL_QUIT) viewer.running = false;
        if (event.type == SDL_KEYDOWN) viewer.key(event.key.keysym.sym, (event.key.keysym.mod & KMOD_SHIFT) != 0);
        if (event.type == SDL_MOUSEWHEEL) {
            viewer.orbit.distance = std::clamp(viewer.orbit.distance * (event.wheel.y > 0 ? 0.9f : 1.11f), 0.1f, 50.0f);
        }
        if (event.type == SDL_MOUSEMOTION && (event.motion.state & SDL_BUTTON_LMASK) != 0) {
            viewer.orbit.yaw += static_cast<float>(event.motion.xrel) * 0.4f;
            viewer.orbit.pitch =
                std::clamp(viewer.orbit.pitch + static_cast<float>(event.motion.yrel) * 0.4f, -89.0f, 89.0f);
        }
    }
    return viewer.running;
}

// What SDL gives, freed in the right order.
struct Window
{
    SDL_Window* window = nullptr;
    SDL_Renderer* renderer = nullptr;
    SDL_Texture* texture = nullptr;

    Window() = default;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window()
    {
        if (texture != nullptr) SDL_DestroyTexture(texture);
        if (renderer != nullptr) SDL_DestroyRenderer(renderer);
        if (window != nullptr) SDL_DestroyWindow(window);
        SDL_Quit();
    }

    bool open(int width, int height)
    {
        if (SDL_Init(SDL_INIT_VIDEO) != 0) return false;
        window = SDL_CreateWindow("Relief", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height, 0);
        if (window == nullptr) return false;
        renderer = SDL_CreateRenderer(window, -1, 0);
        if (renderer == nullptr) return false;
        texture = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STREAMING, width, height);
        return texture != nullptr;
    }
};

}  // namespace

Expected<void> view(const RenderOptions& options, int frames)
{
    const Expected<const Stage*> stage = findStage(options.stage);
    if (!stage) return tl::unexpected(stage.error());
    const Expected<Size> size = parseSize(options.size);
    if (!size) return tl::unexpected(size.error());
    Viewer viewer{.options = options, .current = {}, .previous = {}};
    const Expected<void> opened = viewer.open(static_cast<std::size_t>(*stage - allStages().data()), true);
    if (!opened) return opened;

    Window window;
    if (!window.open(size->width, size->height)) {
        return fail(std::string("view: cannot open a window (") + SDL_GetError() + "); `relief render` needs none");
    }
    Expected<Framebuffer> target = Framebuffer::create(size->width, size->height);
    if (!target) return tl::unexpected(target.error());
    Framebuffer scratch = *target;
    Frame frame(*target, {.threads = options.threads}), scratchFrame(scratch, {.threads = options.threads});
    for (int shown = 0; handleEvents(viewer) && (frames == 0 || shown < frames); ++shown) {
        const auto begin = std::chrono::steady_clock::now();
        viewer.draw(*target, scratch, frame, scratchFrame);
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
        SDL_SetWindowTitle(window.window, viewer.title(time.count()).c_str());
        SDL_UpdateTexture(window.texture, nullptr, target->color8().data(), size->width * 4);
        SDL_RenderCopy(window.renderer, window.texture, nullptr, nullptr);
        SDL_RenderPresent(window.renderer);
    }
    return {};
}

}  // namespace relief::samples

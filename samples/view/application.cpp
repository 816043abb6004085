#include "view/application.h"

#include <SDL.h>

#include "prepare.h"
#include "relief/path.h"

namespace relief::samples {

namespace {

constexpr int kRest = 4;  // frames after an event, until what Dear ImGui shows of it no longer changes: a tab, chosen
                          // by a button, has its contents in the third and their size in the fourth

bool isPicture(const std::string& file)
{
    return hasEnding(file, {".png", ".jpg", ".jpeg", ".tga", ".bmp", ".hdr", ".pfm"});
}

// A file in place of a stage is shown by a stage: a scene by one that is there for it, a normal map by 1.12.
ViewOptions withStage(ViewOptions options)
{
    std::string& stage = options.render.stage;
    if (isPicture(stage)) {
        options.render.files.textures[TextureSlot::normal] = stage;
        options.render.settings.emplace_back("bumpScale=1");
        stage = "1.12";
    } else if (hasEnding(stage, {".glb", ".gltf"})) {
        options.render.files.mesh = stage;
        stage = live::sampleFolder() + "/view/scene_of_file.cpp";
    }
    return options;
}

}  // namespace

Expected<std::unique_ptr<Application>> Application::open(const ViewOptions& given)
{
    const ViewOptions options = withStage(given);
    const Expected<live::StageSource> source = live::findSource(options.render.stage);
    if (!source) return tl::unexpected(source.error());
    const Expected<live::Look> look = lookOf(options.render);
    if (!look) return tl::unexpected(look.error());
    std::unique_ptr<Application> made(new Application);
    Expected<std::unique_ptr<live::Maker>> maker = live::Maker::start();  // before there are threads or a window
    if (!maker) return tl::unexpected(maker.error());
    made->maker = std::move(*maker);
    made->viewer = std::make_unique<Viewer>(*made->maker, options.render, *look);
    if (options.render.size == RenderOptions().size) made->viewer->fit = Fit::wide;
    if (const Expected<void> opened = made->viewer->open(*source); !opened) return tl::unexpected(opened.error());
    if (const Expected<void> opened = made->window.open(1280, 800, options.scale); !opened) {
        return tl::unexpected(opened.error());
    }
    made->window.beginInterface();
    made->interface = std::make_unique<Interface>(*made->viewer, made->window);
    made->alarm = std::make_unique<Alarm>();
    made->redraws = kRest;
    if (isPicture(given.render.stage)) made->interface->examine(TextureSlot::normal, given.render.stage);
    return made;
}

bool Application::step()
{
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) {
        if (event.type == SDL_USEREVENT) continue;  // a session's: update() hears it
        window.take(event);
        interface->take(event);
        redraws = kRest;
    }
    if (viewer->update()) redraws = kRest;
    if (interface->update()) redraws = kRest;
    if (redraws == 0) return false;
    --redraws;
    window.setTitle("Relief: " + viewer->name());
    window.beginFrame();
    interface->draw();
    window.endFrame();
    if (interface->wantsMore()) redraws = std::max(redraws, 1);
    return true;
}

void Application::wait()
{
    std::vector<int> descriptors = viewer->descriptors();
    for (const int descriptor : interface->descriptors()) {
        if (descriptor >= 0) descriptors.push_back(descriptor);
    }
    alarm->arm(std::move(descriptors), viewer->patience());
    SDL_WaitEvent(nullptr);
}

}  // namespace relief::samples

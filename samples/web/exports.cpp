// What the book's pages call (docs/.vitepress/theme/player/worker.js): plain functions on one player. Those that return
// text return "" or JSON where all is well, and otherwise a line that begins with "error: ". It is valid until the next
// call.
#include <cstdlib>
#include <memory>

#include <emscripten/emscripten.h>

#include "web/player.h"
#ifdef RELIEF_WEB_TRACE
#include "relief/trace/pixel_trace.h"
#include "trace/tell.h"
#endif

namespace {

using namespace relief;
using namespace relief::samples;

std::unique_ptr<Player> player;
std::unique_ptr<Framebuffer> picture;
std::string answer;

const char* failed(const Error& error)
{
    answer = "error: " + error.message;
    return answer.c_str();
}

const char* answered(const Expected<void>& result)
{
    return result ? "" : failed(result.error());
}

const char* answered(const Expected<std::string>& result)
{
    if (!result) return failed(result.error());
    answer = *result;
    return answer.c_str();
}

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* relief_open(const char* stage)
{
    setenv("RELIEF_ASSETS", "/assets", 1);
    Expected<Player> opened = Player::open(stage);
    if (!opened) return failed(opened.error());
    player = std::make_unique<Player>(std::move(*opened));
    return answered(Expected<std::string>(player->description()));
}

EMSCRIPTEN_KEEPALIVE const char* relief_load()
{
    const Expected<void> loaded = player->load();
    return loaded ? answered(player->views()) : failed(loaded.error());
}

EMSCRIPTEN_KEEPALIVE const char* relief_set(const char* setting)
{
    return answered(player->set(setting));
}

EMSCRIPTEN_KEEPALIVE void relief_reset()
{
    player->reset();
}

EMSCRIPTEN_KEEPALIVE void relief_orbit(float yaw, float pitch)
{
    player->orbit(yaw, pitch);
}

EMSCRIPTEN_KEEPALIVE void relief_zoom(float factor)
{
    player->zoom(factor);
}

EMSCRIPTEN_KEEPALIVE void relief_move(float right, float up)
{
    player->move(right, up);
}

EMSCRIPTEN_KEEPALIVE const char* relief_camera()
{
    return answered(Expected<std::string>(player->camera()));
}

EMSCRIPTEN_KEEPALIVE const char* relief_look(const char* camera)
{
    return answered(player->look(camera));
}

// Its colours are at relief_pixels() until the next picture.
EMSCRIPTEN_KEEPALIVE const char* relief_render(int width, int height, const char* view)
{
    Expected<Framebuffer> target = player->render(width, height, view);
    if (!target) return failed(target.error());
    picture = std::make_unique<Framebuffer>(std::move(*target));
    return "";
}

EMSCRIPTEN_KEEPALIVE const std::uint32_t* relief_pixels()
{
    return picture->color8().data();
}

EMSCRIPTEN_KEEPALIVE const char* relief_hash()
{
    return answered(player->restingHash());
}

#ifdef RELIEF_WEB_TRACE
// The life of a pixel as a page (trace/tell.h), from this program's instrumented stage. `source`: its text.
EMSCRIPTEN_KEEPALIVE const char* relief_trace(int x, int y, int width, int height, const char* source)
{
    const PreparedStage& stage = player->prepared();
    Expected<Framebuffer> target = Framebuffer::create(width, height, Format::rgba8Srgb);
    if (!target) return failed(target.error());
    Frame frame(*target);
    stage.record(frame, width, height);
    if (const std::string problem = stage.problem(frame); !problem.empty()) return failed({problem});
    const Expected<relief::trace::PixelTrace> life = relief::trace::tracePixel(frame, x, y);
    if (!life) return failed(life.error());
    frame.run();
    const std::string command = "./relief trace " + stage.stage->id + " --pixel " + std::to_string(x) + "," +
                                std::to_string(y) + " --size " + std::to_string(width) + "x" + std::to_string(height);
    const samples::trace::Subject subject({stage.stage, stage.stage, stage.stage->stem + ".cpp", source, {}}, command);
    return answered(toHtml(*life, subject, target->color8()));
}
#endif

}  // extern "C"

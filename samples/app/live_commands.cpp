// `new`, and `render --watch`: what follows a file without a window.
#include <algorithm>
#include <csignal>
#include <cstdio>

#include "commands.h"
#include "live/new_stage.h"
#include "live/session.h"

namespace relief::samples {

Expected<void> newStage(const std::string& path, const std::string& from)
{
    const Expected<void> written = live::writeNewStage(path, from);
    if (!written) return written;
    std::printf("%s\n", path.c_str());
    return {};
}

namespace {

volatile std::sig_atomic_t stopped = 0;

Expected<void> write(const live::Picture& picture, const std::string& path)
{
    Expected<Framebuffer> target = Framebuffer::create(picture.drawn.width, picture.drawn.height);
    if (!target) return tl::unexpected(target.error());
    std::copy(picture.pixels.begin(), picture.pixels.end(), target->color8().begin());
    return writePng(path, *target);
}

}  // namespace

Expected<void> renderAtEverySave(const RenderOptions& options, const std::string& output)
{
    const Expected<live::Look> look = lookOf(options);
    if (!look) return tl::unexpected(look.error());
    const Expected<live::StageSource> source = live::findSource(options.stage);
    if (!source) return tl::unexpected(source.error());
    const Expected<std::unique_ptr<live::Maker>> maker = live::Maker::start();
    if (!maker) return tl::unexpected(maker.error());
    const Expected<std::unique_ptr<live::Session>> session =
        live::Session::open(*source, *look, **maker, options.compiler);
    if (!session) return tl::unexpected(session.error());

    struct sigaction action = {};
    action.sa_handler = [](int) { stopped = 1; };
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    const std::string path = output.empty() ? source->stem + ".png" : output;
    while (stopped == 0) {
        const live::Session::News news = (*session)->update(std::chrono::seconds(1));
        if (const live::Problem* const problem = (*session)->problem(); news.problem && problem != nullptr) {
            if (problem->isRefusal && (*session)->picture().version == 0) {
                return fail(problem->diagnostics.front().message);
            }
            std::fputs(problem->text().c_str(), stderr);
        }
        if (!news.picture) continue;
        if (const Expected<void> written = write((*session)->picture(), path); !written) return written;
        std::printf("%s (%.0f ms)\n", path.c_str(), (*session)->times().total());
        std::fflush(stdout);
    }
    return {};
}

}  // namespace relief::samples

// `view`: the window, until the user closes it.
#include "commands.h"
#include "view/application.h"

namespace relief::samples {

Expected<void> view(const ViewOptions& options)
{
    const Expected<std::unique_ptr<Application>> opened = Application::open(options);
    if (!opened) return tl::unexpected(opened.error());
    Application& application = **opened;
    Viewer& viewer = *application.viewer;
    int pictures = 0, version = -1;
    while (application.running()) {
        const bool drawn = application.step();
        const live::Session& session = viewer.session();
        const live::Problem* const problem = session.problem();
        if (problem != nullptr && problem->isRefusal && session.picture().version == 0) {
            return fail(problem->diagnostics.front().message);
        }
        if (options.frames > 0) {
            if (problem != nullptr) return fail(options.render.stage + ": see above");
            if (session.picture().version > 0 && session.idle() && version != viewer.version) {
                version = viewer.version;
                if (++pictures > options.frames) return {};
                viewer.ask();
            }
        }
        if (!drawn) application.wait();
    }
    return {};
}

}  // namespace relief::samples

// For programs that compile no stages, and for all of them where there is no Linux, or no source (RELIEF_LIVE=OFF):
// whatever needs live stages says so, in one line.
#include "live/load.h"
#include "live/new_stage.h"
#include "live/session.h"
#include "trace/traced_stage.h"

namespace relief::samples::live {

namespace {

tl::unexpected<Error> needsLinux()
{
    return fail("this program compiles no stages: ./relief does it, in a clone of the sources, on Linux");
}

}  // namespace

bool namesFile(const std::string& stage)
{
    return stage.ends_with(".cpp");
}
const std::vector<StageSource>& stageSources()
{
    static const std::vector<StageSource> none;
    return none;
}
Expected<StageSource> findSource(const std::string&)
{
    return needsLinux();
}
Expected<const Toolchain*> findToolchain(const std::string&)
{
    return needsLinux();
}
Expected<const Toolchain*> findTracedToolchain()
{
    return needsLinux();
}
Expected<const Stage*> loadStage(const std::string&)
{
    return needsLinux();
}
Expected<StageCompile> StageCompile::start(const StageSource&, const std::string&, bool)
{
    return needsLinux();
}
Expected<const Stage*> StageCompile::finish()
{
    return needsLinux();
}
Expected<void> writeNewStage(const std::string&, const std::string&)
{
    return needsLinux();
}
Expected<std::unique_ptr<Maker>> Maker::start()
{
    return needsLinux();
}
Expected<PrivateFolder> PrivateFolder::create()
{
    return needsLinux();
}
Expected<std::unique_ptr<Session>> Session::open(const StageSource&, const Look&, Maker&, const std::string&)
{
    return needsLinux();
}

// What no value of theirs ever gets to.
Maker::~Maker() = default;
Renderer::~Renderer() = default;
PrivateFolder::~PrivateFolder() = default;
Watch::~Watch() = default;
Compile::~Compile() = default;
void Session::look(const Look&) {}
Session::News Session::update(std::chrono::milliseconds)
{
    return {};
}
std::vector<int> Session::descriptors() const
{
    return {};
}
std::chrono::milliseconds Session::patience() const
{
    return {};
}
std::string sampleFolder()
{
    return "";
}
std::string programPath()
{
    return "";
}
std::string formatted(const std::vector<Diagnostic>&)
{
    return "";
}

}  // namespace relief::samples::live

namespace relief::samples::trace {

Expected<TracedStage> loadTraced(const std::string&)
{
    return live::needsLinux();
}

}  // namespace relief::samples::trace

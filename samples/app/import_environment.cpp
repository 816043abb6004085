// The program of `import-environment`: surroundings from a picture, prefiltered for rough surfaces, into one file that
// CubeMap::fromPicture takes. It needs no stage.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include <unistd.h>

#include "command_line.h"
#include "relief/path.h"
#include "relief/pipeline/workers.h"
#include "relief/shading/environment.h"
#include "relief/texture/image.h"

namespace {

using namespace relief;
using namespace relief::samples;

// How far it is, on a terminal and from the second second on; one thread prints.
class Progress
{
public:
    explicit Progress(int all) : tasks(all) {}
    ~Progress()
    {
        if (isShown) std::fputs("\r\033[K", stderr);
    }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void add(bool mayPrint)
    {
        const int now = ++done;
        if (!mayPrint || !isTerminal || Clock::now() < next) return;
        std::fprintf(stderr, "\r\033[Krelief: prefiltering: %d of %d rows", now, tasks);
        isShown = true;
        next = Clock::now() + std::chrono::milliseconds(200);
    }

private:
    using Clock = std::chrono::steady_clock;
    int tasks;
    std::atomic<int> done{0};
    bool isTerminal = isatty(STDERR_FILENO) != 0, isShown = false;
    Clock::time_point next = Clock::now() + std::chrono::seconds(1);
};

Expected<CubeMap> radianceOf(const std::string& file)
{
    const Expected<ImageFile> picture = readImage(file);
    if (!picture) return tl::unexpected(picture.error());
    Expected<CubeMap> map = CubeMap::fromPicture(*picture, ColorSpace::srgb);
    if (!map) return fail(file + ": " + map.error().message);
    if (isPrefiltered(*map)) return fail(file + ": is prefiltered already; give the picture that it was made of");
    return map;
}

Expected<void> write(const std::string& path, const std::string& ending, const ImageFloat& picture)
{
    std::vector<float> rgb;
    rgb.reserve(picture.pixels.size() / 4 * 3);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        if (i % 4 != 3) rgb.push_back(picture.pixels[i]);
    }
    if (ending == ".pfm") return writePfm(path, picture.width, picture.height, rgb);
    return writeHdr(path, picture.width, picture.height, rgb);
}

Expected<void> importEnvironment(const ImportEnvironmentOptions& options)
{
    const std::string output =
        options.output.empty() ? utf8Of(pathOf(options.file).stem()) + "-prefiltered.hdr" : options.output;
    const std::string ending = utf8Of(pathOf(output).extension());
    if (ending != ".hdr" && ending != ".pfm")
        return fail(output + ": the name must end in .hdr or .pfm; choose another with -o");
    const Expected<CubeMap> radiance = radianceOf(options.file);
    if (!radiance) return tl::unexpected(radiance.error());

    const RunTasks run = [&](int tasks, const std::function<void(int)>& function) {
        Progress progress(tasks);
        Workers(options.threads).run(tasks, [&](int task, int worker) {
            function(task);
            progress.add(worker == 0);
        });
    };
    const Expected<ImageFloat> picture =
        prefilteredEnvironment(*radiance, {.side = options.size, .samples = options.samples}, run);
    if (!picture) return fail(options.file + ": " + picture.error().message);
    if (const Expected<void> written = write(output, ending, *picture); !written) return written;
    std::printf("%s\n", output.c_str());
    return {};
}

}  // namespace

int main(int argc, char** argv)
{
    return runProgram(argc, argv, {.importEnvironment = importEnvironment});
}

// Rewrites every golden picture and the file of hashes. A commit that changes one says why.
#include <cstdio>

#include "golden_stage.h"
#include "relief/file.h"

int main()
{
    using namespace relief;
    using namespace relief::samples;
    std::string hashes;
    for (const Stage& stage : allStages()) {
        const Expected<Framebuffer> picture = renderForGolden(stage, Format::rgba8Srgb);
        const Expected<Framebuffer> floats = renderForGolden(stage, Format::rgba32f);
        const Expected<void> written =
            picture ? updateGolden(*picture, goldenPath(stage)) : Expected<void>(tl::unexpected(picture.error()));
        if (!written || !floats) {
            std::fprintf(stderr, "%s\n", (written ? floats.error() : written.error()).message.c_str());
            return 2;
        }
        hashes += hexadecimal(hashOf(*floats)) + " " + stage.id + " " + stage.stem + "\n";
    }
    const Expected<void> written =
        writeFileAtomically(hashesPath(), {reinterpret_cast<const std::uint8_t*>(hashes.data()), hashes.size()});
    if (!written) {
        std::fprintf(stderr, "%s\n", written.error().message.c_str());
        return 2;
    }
    std::printf("%zu goldens and hashes written to %s\n", allStages().size(), RELIEF_GOLDEN_FOLDER);
    return 0;
}

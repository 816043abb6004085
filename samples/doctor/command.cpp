#include "doctor/command.h"

#include <cstdio>

#include "doctor/examination.h"
#include "relief/file.h"

namespace relief::samples {

Expected<int> examineMap(const DoctorOptions& options)
{
    const Expected<doctor::Examination> all = doctor::examine(options.file, options.heights, options.mesh);
    if (!all) return tl::unexpected(all.error());
    const doctor::Diagnosis& d = all->diagnosis;
    if (!options.fix.empty() && !all->isNormalMap())
        return fail("--fix " + options.fix + ": " + options.file + " is no normal map; nothing was written");
    if (!options.writtenHeights.empty() && d.kind != doctor::Kind::tangentSpace)
        return fail(options.file + ": is no tangent-space map; there are no heights to write");
    const auto write = [](const std::string& path, const auto& makePicture) -> Expected<void> {
        if (path.empty()) return {};
        const Image8 picture = makePicture();
        return writePng(path, picture.width, picture.height, picture.pixels);
    };
    Expected<void> written = write(options.fix, [&] { return pictureOf(d.cured); });
    if (written) written = write(options.evidence, [&] { return evidencePicture(*all); });
    if (written) written = write(options.writtenHeights, [&] { return heightsPicture(d.heights); });
    if (!written) return tl::unexpected(written.error());
    std::string text = options.json ? jsonOf(*all) : textOf(*all);
    if (!options.json && !options.evidence.empty()) text += options.evidence + ": " + evidenceWords(*all) + "\n";
    std::fputs(text.c_str(), stdout);
    return d.findings.empty() ? 0 : 1;
}

}  // namespace relief::samples

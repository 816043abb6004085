#include "check/check.h"

#include <cstdio>

#include "relief/check/compare.h"
#include "relief/check/golden.h"
#include "relief/file.h"
#include "relief/texture/image.h"

namespace relief::samples::check {

Expected<void> writeText(const std::string& path, const std::string& text)
{
    return writeFileAtomically(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Expected<int> compareFiles(const CheckOptions& options)
{
    const Expected<Tolerance> tolerance = toleranceOf(options.range);
    if (!tolerance) return tl::unexpected(tolerance.error());
    const Expected<ImageFile> actual = readImage(options.first);
    if (!actual) return tl::unexpected(actual.error());
    const Expected<ImageFile> golden = readImage(options.second);
    if (!golden) return tl::unexpected(golden.error());
    const Expected<Comparison> comparison = compare(*actual, *golden);
    if (!comparison) {
        std::printf("%s: %s\n", options.first.c_str(), comparison.error().message.c_str());
        return 1;
    }
    if (!options.output.empty() && !comparison->same()) {
        const int width = std::visit([](const auto& p) { return p.width; }, *actual);
        const int height = std::visit([](const auto& p) { return p.height; }, *actual);
        const Expected<void> written = writePng(options.output, width, height, comparison->amplified);
        if (!written) return tl::unexpected(written.error());
    }
    const std::string breaks = comparison->breaks(*tolerance);
    if (!breaks.empty() && !tolerance->isExact()) std::printf("%s\n", breaks.c_str());
    if (comparison->same()) {
        std::printf("the same: %s, %s\n", sizeOf(*actual).c_str(), kindOf(*actual));
    } else {
        std::printf("%s", comparison->report().c_str());
    }
    return breaks.empty() ? 0 : 1;
}

Expected<int> run(const CheckOptions& options)
{
    if (options.what == "compare") return compareFiles(options);
    if (options.what == "folder") return compareFolders(options);
    return options.what == "review" ? review(options) : accept(options);
}

}  // namespace relief::samples::check

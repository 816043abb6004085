// Writes into every stage's page what changed since the stage before it.
#include <cstdio>

#include "common/stage.h"
#include "file.h"
#include "page_diff.h"

namespace {

using namespace relief;

Expected<std::string> text(const std::string& path)
{
    const Expected<std::vector<std::uint8_t>> bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Expected<bool> update(const samples::Stage& before, const samples::Stage& stage)
{
    const std::string root = RELIEF_SOURCE_FOLDER;
    const std::string path = root + "/docs/" + stage.folder + "/" + stage.stem + ".md";
    const Expected<std::string> old = text(root + "/samples/" + before.folder + "/" + before.stem + ".cpp");
    const Expected<std::string> now = text(root + "/samples/" + stage.folder + "/" + stage.stem + ".cpp");
    const Expected<std::string> page = text(path);
    for (const Expected<std::string>* file : {&old, &now, &page}) {
        if (!*file) return tl::unexpected(file->error());
    }
    const std::optional<std::string> updated = pages::withDifference(*page, pages::difference(*old, *now));
    if (!updated || *updated == *page) return false;
    const Expected<void> written =
        writeFileAtomically(path, {reinterpret_cast<const std::uint8_t*>(updated->data()), updated->size()});
    if (!written) return tl::unexpected(written.error());
    return true;
}

}  // namespace

int main()
{
    const std::vector<samples::Stage>& stages = samples::allStages();
    int changed = 0;
    for (std::size_t i = 1; i < stages.size(); ++i) {
        const Expected<bool> result = update(stages[i - 1], stages[i]);
        if (!result) {
            std::fprintf(stderr, "update_pages: %s\n", result.error().message.c_str());
            return 2;
        }
        changed += *result ? 1 : 0;
    }
    std::printf("%d pages changed\n", changed);
}

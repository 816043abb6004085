// Writes what changed since the stage before it into every stage's page, and "// new" behind those lines of its source
// (run clang-format afterwards, which lines them up).
#include <cstdio>

#include "common/stage.h"
#include "page_diff.h"
#include "relief/file.h"

namespace {

using namespace relief;

Expected<std::string> text(const std::string& path)
{
    const Expected<std::vector<std::uint8_t>> bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Expected<int> replace(const std::string& path, const std::string& old, const std::string& now)
{
    if (now == old) return 0;
    const Expected<void> written =
        writeFileAtomically(path, {reinterpret_cast<const std::uint8_t*>(now.data()), now.size()});
    if (!written) return tl::unexpected(written.error());
    return 1;
}

// How many files changed.
Expected<int> update(const samples::Stage& before, const samples::Stage& stage)
{
    const std::string root = RELIEF_SOURCE_FOLDER;
    const std::string page = root + "/docs/" + stage.folder + "/" + stage.stem + ".md";
    const std::string source = root + "/samples/" + stage.folder + "/" + stage.stem + ".cpp";
    const Expected<std::string> old = text(root + "/samples/" + before.folder + "/" + before.stem + ".cpp");
    const Expected<std::string> now = text(source), shown = text(page);
    for (const Expected<std::string>* file : {&old, &now, &shown}) {
        if (!*file) return tl::unexpected(file->error());
    }
    const std::string news = before.folder == stage.folder ? pages::marked(*old, *now) : pages::withoutMarks(*now);
    const Expected<int> marked = pages::sameMarks(*now, news) ? 0 : replace(source, *now, news);
    if (!marked) return marked;
    const std::optional<std::string> updated = pages::withDifference(*shown, pages::difference(*old, *now));
    const Expected<int> paged = replace(page, *shown, updated.value_or(*shown));
    if (!paged) return paged;
    return *marked + *paged;
}

}  // namespace

int main()
{
    const std::vector<samples::Stage>& stages = samples::allStages();
    int changed = 0;
    for (std::size_t i = 1; i < stages.size(); ++i) {
        const Expected<int> result = update(stages[i - 1], stages[i]);
        if (!result) {
            std::fprintf(stderr, "update_pages: %s\n", result.error().message.c_str());
            return 2;
        }
        changed += *result;
    }
    std::printf("%d files changed\n", changed);
}

#include "live/new_stage.h"

#include <cctype>
#include <cstdio>
#include <filesystem>

#include "common/pattern.h"
#include "live/compile.h"
#include "relief/file.h"

namespace relief::samples::live {

namespace {

void replaceAll(std::string& text, const std::string& from, const std::string& to)
{
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
}

std::string asFunction(const std::string& stem)
{
    std::string name;
    for (const char c : stem) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return std::isdigit(static_cast<unsigned char>(name[0])) != 0 ? "stage_" + name : name;
}

}  // namespace

Expected<void> writeNewStage(const std::string& path, const std::string& from)
{
    const std::filesystem::path file(path);
    if (!namesFile(path) || file.stem().empty() || file.stem() == ".cpp") {
        return fail("new " + path + ": a stage's file ends with .cpp, such as my_shader.cpp");
    }
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) {
        return fail("new " + path + ": is there already, and stays as it is; choose another name or remove it");
    }
    std::string source = sampleFolder() + "/live/new_stage.txt";
    if (!from.empty()) {
        const Expected<StageSource> found = findSource(from);
        if (!found) return fail("new " + path + " --from " + from + ": " + found.error().message);
        source = found->path;
    }
    Expected<std::string> text = readText(source);
    if (!text) return tl::unexpected(text.error());
    const std::string function = stageFunction(*text);
    if (function.empty()) return fail(source + ": has no function `Stage NAME()` at the beginning of a line");
    replaceAll(*text, " " + function + "()", " " + asFunction(file.stem().string()) + "()");
    if (from.empty()) replaceAll(*text, "@file@", path);
    if (!from.empty()) *text = Pattern(" +// new\n").replace(*text, "\n");  // against the book's stage before
    if (!from.empty())
        text->insert(0, "// " + path + ", from " + from + ". `./relief view " + path +
                            "` shows it, and shows it again whenever this file is saved.\n//\n");

    // "x": nothing is overwritten, even if somebody else writes it at the same moment.
    FILE* const out = std::fopen(path.c_str(), "wbx");
    bool written = out != nullptr && std::fwrite(text->data(), 1, text->size(), out) == text->size();
    if (out != nullptr) written = std::fclose(out) == 0 && written;
    if (out != nullptr && !written) std::filesystem::remove(file, ignored);
    if (!written) return fail("new " + path + ": cannot be written; look at the folder's name and permissions");
    return {};
}

}  // namespace relief::samples::live

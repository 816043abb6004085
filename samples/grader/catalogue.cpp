#include "grader/catalogue.h"

#include <algorithm>
#include <sstream>

#include <dlfcn.h>

#include "live/load.h"
#include "live/watch.h"
#include "relief/check/hash.h"
#include "relief/file.h"
#include "relief/texture/image.h"

namespace relief::samples::grader {

namespace {

Expected<Image8> readCodes(const std::string& path)
{
    Expected<ImageFile> file = readImage(path);
    if (!file) return tl::unexpected(file.error());
    if (!std::holds_alternative<Image8>(*file)) return fail(path + ": is no picture of 8 bits; run update_exercises");
    return std::get<Image8>(std::move(*file));
}

// All variants, compiled and loaded: their functions.
Expected<std::vector<Stage (*)()>> load(const Exercise& exercise, const std::vector<Variant>& variants)
{
    const Expected<const live::Toolchain*> toolchain = live::findToolchain();
    if (!toolchain) return tl::unexpected(toolchain.error());
    const Expected<live::PrivateFolder> folder = live::PrivateFolder::create();
    if (!folder) return tl::unexpected(folder.error());
    const std::string path = exercise.folder + "/answer/answer.cpp";
    live::Compile compile((*toolchain)->path, (*toolchain)->words, {path, allInOne(exercise, variants)},
                          {.parts = 1, .owners = {}}, folder->path, 0);
    const live::Compiled compiled = compile.wait();
    if (compiled.object.empty()) {
        return fail(path + ": a variant does not compile\n" + live::formatted(compiled.errors.front()));
    }
    void* const handle = ::dlopen(compiled.object.c_str(), RTLD_NOW | RTLD_LOCAL);
    const auto* const list =
        handle != nullptr ? static_cast<Stage (*const*)()>(::dlsym(handle, "relief_variants")) : nullptr;
    if (list == nullptr) return fail(path + ": the compiled variants cannot be loaded (" + ::dlerror() + ")");
    return std::vector<Stage (*)()>(list, list + variants.size());
}

// How many pixels are at least kLeastSeen codes apart.
int pixelsSeen(const Image8& first, const Image8& second)
{
    int seen = 0;
    for (std::size_t i = 0; i < first.pixels.size(); i += 4) {
        seen += distanceOf({&first.pixels[i], 4}, {&second.pixels[i], 4}, 1).largest >= kLeastSeen;
    }
    return seen;
}

// What is wrong with a new entry; empty: nothing.
std::string problemWith(const Variant& variant, const Entry& entry, const Image8& codes, const Catalogue& catalogue)
{
    for (const Entry& other : catalogue.entries) {
        if (other.hash == entry.hash) return "gives the same picture as " + other.name;
    }
    if (!variant.isRight && pixelsSeen(codes, catalogue.goal) < kLeastPixels) {
        return "does not show: its picture is the goal's, but for a few codes; leave it out, or make it larger";
    }
    return "";
}

}  // namespace

std::string allInOne(const Exercise& exercise, const std::vector<Variant>& variants)
{
    static const std::string kBegin = "namespace relief::samples {";
    const std::string function = live::stageFunction(exercise.answer);
    std::string text, list;
    for (std::size_t i = 0; i < variants.size(); ++i) {
        const std::string space = "variant" + std::to_string(i);
        std::string its = variants[i].text;
        const std::size_t at = its.find(kBegin);
        if (at != std::string::npos) its.replace(at, kBegin.size(), "namespace relief::samples::" + space + " {");
        text += "#line 1 \"" + variants[i].name + "\"\n" + its;
        list += space + "::" + function + ", ";
    }
    // The last function at the beginning of a line is the one that a loader of stages would call.
    return text + kBegin + "\nextern \"C\" {\nextern Stage (*const relief_variants[])();\n" +
           "Stage (*const relief_variants[])() = {" + list + "};\n}\n" +
           "Stage variants() { return variant0::" + function + "(); }\n}\n";
}

Expected<Catalogue> drawCatalogue(const Exercise& exercise)
{
    const Expected<std::vector<Variant>> variants = variantsOf(exercise);
    if (!variants) return tl::unexpected(variants.error());
    const Expected<std::vector<Stage (*)()>> functions = load(exercise, *variants);
    if (!functions) return tl::unexpected(functions.error());
    Catalogue catalogue;
    for (std::size_t i = 0; i < variants->size(); ++i) {
        const Variant& variant = (*variants)[i];
        const Expected<Framebuffer> picture = draw((*functions)[i](), 0);
        if (!picture) return fail(exercise.stem + ", " + variant.name + ": " + picture.error().message);
        const Image8 codes = codesOf(*picture);
        if (i == 0) catalogue.goal = codes;
        Entry entry{variant.name, hexadecimal(hashOf(*picture)), smallOf(codes)};
        const std::string problem = problemWith(variant, entry, codes, catalogue);
        const bool isPair = variant.mistakes.size() == 2;
        if (!problem.empty() && isPair) continue;
        if (!problem.empty()) return fail(exercise.folder + "/exercise.md: " + variant.name + " " + problem);
        catalogue.entries.push_back(std::move(entry));
    }
    return catalogue;
}

Expected<Catalogue> readCatalogue(const Exercise& exercise)
{
    const std::string path = exercise.folder + "/catalogue.txt";
    const Expected<std::string> text = live::readText(path);
    if (!text) return tl::unexpected(text.error());
    const Expected<Image8> small = readCodes(exercise.folder + "/catalogue.png");
    if (!small) return tl::unexpected(small.error());
    Expected<Image8> goal = readCodes(exercise.folder + "/goal.png");
    if (!goal) return tl::unexpected(goal.error());
    Catalogue catalogue{{}, std::move(*goal)};
    const std::size_t size = 4 * kSmallWidth * kSmallHeight;
    std::istringstream lines(*text);
    for (Entry entry; lines >> entry.hash >> entry.name;) {
        const std::size_t begin = catalogue.entries.size() * size;
        if (begin + size > small->pixels.size()) return fail(path + ": has other entries than catalogue.png");
        const auto first = small->pixels.begin() + static_cast<std::ptrdiff_t>(begin);
        entry.small = {kSmallWidth, kSmallHeight, {first, first + static_cast<std::ptrdiff_t>(size)}};
        catalogue.entries.push_back(entry);
    }
    if (catalogue.entries.size() < 2 || catalogue.goal.width != kWidth || catalogue.goal.height != kHeight) {
        return fail(path + ": is no catalogue; run update_exercises");
    }
    return catalogue;
}

Expected<void> writeCatalogue(const Exercise& exercise, const Catalogue& catalogue)
{
    std::string text;
    std::vector<std::uint8_t> small;
    for (const Entry& entry : catalogue.entries) {
        text += entry.hash + " " + entry.name + "\n";
        small.insert(small.end(), entry.small.pixels.begin(), entry.small.pixels.end());
    }
    const int rows = kSmallHeight * static_cast<int>(catalogue.entries.size());
    const auto writeText = [&](const char* name, const std::string& of) {
        return writeFileAtomically(exercise.folder + name,
                                   {reinterpret_cast<const std::uint8_t*>(of.data()), of.size()});
    };
    Expected<void> written = writeText("/catalogue.txt", text);
    if (written) written = writeText("/start.txt", learnersText(exercise, "exercises/" + exercise.stem + ".cpp"));
    if (written) written = writePng(exercise.folder + "/catalogue.png", kSmallWidth, rows, small);
    if (written) written = writePng(exercise.folder + "/goal.png", kWidth, kHeight, catalogue.goal.pixels);
    return written;
}

bool same(const Catalogue& first, const Catalogue& second)
{
    const auto equal = [](const Entry& a, const Entry& b) {
        return a.name == b.name && a.hash == b.hash && a.small.pixels == b.small.pixels;
    };
    return first.goal.pixels == second.goal.pixels &&
           std::equal(first.entries.begin(), first.entries.end(), second.entries.begin(), second.entries.end(), equal);
}

}  // namespace relief::samples::grader

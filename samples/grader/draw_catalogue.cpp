// Makes a catalogue: compiles and draws all that is known.
#include <dlfcn.h>

#include "grader/catalogue.h"
#include "live/load.h"
#include "relief/check/hash.h"

namespace relief::samples::grader {

namespace {

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

}  // namespace relief::samples::grader

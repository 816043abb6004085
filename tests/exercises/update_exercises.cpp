// Draws the catalogues of exercises (grader/catalogue.h): `update_exercises` writes those of all, `update_exercises
// 1.08a` of one; with --check nothing is written, and what is there must be what is drawn, to the last bit.
#include <cstdio>
#include <string>
#include <vector>

#include "grader/diagnosis.h"

namespace {

using namespace relief;
using namespace relief::samples::grader;

// An open exercise's answers meet its conditions, and its mistakes do not.
Expected<void> checkConditions(const Exercise& exercise, const Catalogue& catalogue)
{
    const Expected<std::vector<Variant>> variants = variantsOf(exercise);
    if (!variants) return tl::unexpected(variants.error());
    for (const Variant& variant : *variants) {
        for (const Entry& entry : catalogue.entries) {
            if (entry.name != variant.name) continue;
            const std::vector<std::string> missing = unmet(exercise, entry.small, catalogue.entries[1].small);
            if (missing.empty() == variant.isRight) continue;
            return fail(exercise.stem + ", " + variant.name + ": " +
                        (variant.isRight ? missing.front() : "meets all conditions, and is a mistake"));
        }
    }
    return {};
}

Expected<void> update(const Exercise& exercise, bool isCheck)
{
    const Expected<Catalogue> drawn = drawCatalogue(exercise);
    if (!drawn) return tl::unexpected(drawn.error());
    if (exercise.isOpen()) {
        if (const Expected<void> checked = checkConditions(exercise, *drawn); !checked) return checked;
    }
    if (!isCheck) {
        std::printf("%s: %zu pictures\n", exercise.stem.c_str(), drawn->entries.size());
        return writeCatalogue(exercise, *drawn);
    }
    const Expected<Catalogue> committed = readCatalogue(exercise);
    if (!committed) return tl::unexpected(committed.error());
    if (same(*drawn, *committed)) return {};
    for (std::size_t i = 0; i < drawn->entries.size() && i < committed->entries.size(); ++i) {
        const Entry &is = drawn->entries[i], &was = committed->entries[i];
        if (is.name == was.name && is.hash == was.hash) continue;
        return fail(exercise.stem + ": " + is.name + " has the hash " + is.hash + ", and the catalogue says " +
                    was.hash + " " + was.name + "; if that is meant, run update_exercises");
    }
    return fail(exercise.stem + ": the catalogue is another one; if that is meant, run update_exercises");
}

}  // namespace

int main(int argc, char** argv)
{
    bool isCheck = false;
    std::vector<std::string> names;
    for (int i = 1; i < argc; ++i) {
        if (std::string(argv[i]) == "--check")
            isCheck = true;
        else
            names.emplace_back(argv[i]);
    }
    const Expected<std::vector<Exercise>> all = allExercises();
    if (!all) std::fprintf(stderr, "%s\n", all.error().message.c_str());
    if (!all) return 2;
    std::vector<const Exercise*> chosen;
    for (const std::string& name : names) {
        const Expected<const Exercise*> found = findExercise(*all, name);
        if (!found) std::fprintf(stderr, "%s\n", found.error().message.c_str());
        if (!found) return 2;
        chosen.push_back(*found);
    }
    if (names.empty()) {
        for (const Exercise& exercise : *all) chosen.push_back(&exercise);
    }
    int code = 0;
    for (const Exercise* exercise : chosen) {
        const Expected<void> updated = update(*exercise, isCheck);
        if (!updated) std::fprintf(stderr, "%s\n", updated.error().message.c_str());
        if (!updated) code = 1;
    }
    return code;
}

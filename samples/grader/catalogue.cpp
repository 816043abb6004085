#include "grader/catalogue.h"

#include <algorithm>
#include <sstream>

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

}  // namespace

Expected<Catalogue> readCatalogue(const Exercise& exercise)
{
    const std::string path = exercise.folder + "/catalogue.txt";
    const Expected<std::string> text = readText(path);
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

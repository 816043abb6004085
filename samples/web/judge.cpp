// What the book's pages ask about pictures (docs/.vitepress/theme/player/judge.js): the doctor's diagnosis of a map,
// and the grader's of an exercise. A text that begins with "error: " is one line; it is valid until the next call.
#include <emscripten/emscripten.h>

#include <nlohmann/json.hpp>

#include "doctor/examination.h"
#include "grader/diagnosis.h"
#include "relief/file.h"

namespace {

using namespace relief;
using namespace relief::samples;

std::string answer;

Expected<std::string> examined(const std::string& file, const std::string& heights, const std::string& mesh)
{
    const Expected<doctor::Examination> all = doctor::examine(file, heights, mesh);
    if (!all) return tl::unexpected(all.error());
    const auto write = [](const char* path, const Image8& picture) {
        return writePng(path, picture.width, picture.height, picture.pixels);
    };
    if (const Expected<void> written = write("/evidence.png", evidencePicture(*all)); !written)
        return tl::unexpected(written.error());
    if (all->isNormalMap()) {
        if (const Expected<void> written = write("/cured.png", pictureOf(all->diagnosis.cured)); !written)
            return tl::unexpected(written.error());
    }
    return evidenceWords(*all) + "\n" + textOf(*all);
}

const char* answered(const Expected<std::string>& text)
{
    answer = text ? *text : "error: " + text.error().message;
    return answer.c_str();
}

Expected<std::string> diagnosed(const std::string& folder, const std::string& hash, const std::string& picture)
{
    using namespace grader;
    const Expected<Exercise> exercise = readExercise(folder);
    if (!exercise) return tl::unexpected(exercise.error());
    const Expected<Catalogue> catalogue = readCatalogue(*exercise);
    if (!catalogue) return tl::unexpected(catalogue.error());
    Expected<std::vector<std::uint8_t>> codes = readFile(picture);
    if (!codes) return tl::unexpected(codes.error());
    if (codes->size() != std::size_t{4} * kWidth * kHeight) return fail(picture + ": has another size than 480x270");
    const Diagnosis diagnosis = diagnose(*exercise, *catalogue, hash, {kWidth, kHeight, std::move(*codes)});
    return nlohmann::json{{"kind", wordOf(diagnosis.kind)}, {"sentence", diagnosis.sentence}}.dump();
}

}  // namespace

extern "C" {

// What stands in /evidence.png, a line; then the diagnosis. Of a normal map /cured.png is written, too. `heights` and
// `mesh` may be empty.
EMSCRIPTEN_KEEPALIVE const char* relief_examine(const char* file, const char* heights, const char* mesh)
{
    return answered(examined(file, heights, mesh));
}

// {"kind", "sentence"} of an exercise's picture: a file of 480x270 times R, G, B, A, and the hash of the same in
// floats.
EMSCRIPTEN_KEEPALIVE const char* relief_diagnose(const char* folder, const char* hash, const char* picture)
{
    return answered(diagnosed(folder, hash, picture));
}

}  // extern "C"

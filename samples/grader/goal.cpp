// Where the exercises are: in the sources' own folder.
#include "grader/goal.h"

#include <algorithm>
#include <filesystem>

#include "grader/exercise.h"
#include "relief/file.h"
#include "relief/path.h"

namespace relief::samples::grader {

namespace fs = std::filesystem;

Expected<std::vector<Exercise>> allExercises()
{
    const fs::path folder = pathOf(live::sampleFolder() + "/exercises");
    std::vector<std::string> folders;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        if (entry.is_directory(error)) folders.push_back(utf8Of(entry.path()));
    }
    if (folders.empty()) return fail(utf8Of(folder) + ": has no exercises; get Relief's sources again");
    std::sort(folders.begin(), folders.end());
    std::vector<Exercise> all;
    for (const std::string& one : folders) {
        Expected<Exercise> exercise = readExercise(one);
        if (!exercise) return tl::unexpected(exercise.error());
        all.push_back(std::move(*exercise));
    }
    return all;
}

std::optional<live::StageSource> goalOf(const live::StageSource& source)
{
    if (!source.id.empty()) return std::nullopt;
    const std::string id = exerciseIdOf(source.path, readText(source.path).value_or(""));
    if (id.empty()) return std::nullopt;
    const Expected<std::vector<Exercise>> all = allExercises();
    if (!all) return std::nullopt;
    const Expected<const Exercise*> found = findExercise(*all, id);
    if (!found) return std::nullopt;
    live::StageSource answer = source;
    answer.path = (*found)->folder + "/answer/answer.cpp";
    answer.stem = "goal";
    return answer;
}

}  // namespace relief::samples::grader

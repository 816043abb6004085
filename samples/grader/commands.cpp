// `exercise` and `check-exercise`: what a learner types.
#include "grader/commands.h"

#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>

#include "grader/diagnosis.h"
#include "grader/submission.h"
#include "live/toolchain.h"
#include "relief/file.h"
#include "relief/path.h"

namespace relief::samples {

namespace {

namespace fs = std::filesystem;
using namespace relief::samples::grader;

constexpr const char* kFolder = "exercises";
constexpr const char* kSolved = "solved.txt";  // beside the learner's files: an id a line

std::set<std::string> solvedIn(const fs::path& folder)
{
    std::set<std::string> ids;
    std::istringstream lines(readText(utf8Of(folder / kSolved)).value_or(""));
    for (std::string id; lines >> id;) ids.insert(id);
    return ids;
}

// The list beside a file is for `exercise` to show; where it cannot be written, nothing is lost.
void remember(const fs::path& folder, const std::string& id)
{
    std::set<std::string> ids = solvedIn(folder);
    if (!ids.insert(id).second) return;
    std::string text;
    for (const std::string& one : ids) text += one + "\n";
    const Expected<void> written = writeFileAtomically(
        utf8Of(folder / kSolved), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    if (!written) std::fprintf(stderr, "relief: %s\n", written.error().message.c_str());
}

void listAll(const std::vector<Exercise>& all)
{
    const std::set<std::string> solved = solvedIn(kFolder);
    std::size_t count = 0;
    for (const Exercise& e : all) {
        const bool isSolved = solved.count(e.id) != 0;
        std::error_code ignored;
        const bool isBegun = fs::exists(pathOf(std::string(kFolder)) / (e.stem + ".cpp"), ignored);
        count += isSolved;
        std::printf("  %s  %-8s %-36s %s\n", e.id.c_str(), e.kind.c_str(), e.title.c_str(),
                    isSolved  ? "solved"
                    : isBegun ? "begun"
                              : "");
    }
    std::printf("\n%zu of %zu solved. ./relief exercise %s writes %s/%s.cpp, for you to fill in.\n", count, all.size(),
                all.front().id.c_str(), kFolder, all.front().stem.c_str());
}

// What the learner reads about a file that gave no picture.
std::string sentenceOf(const Submission& submission)
{
    using Outcome = Submission::Outcome;
    switch (submission.outcome) {
        case Outcome::notCompiled:
            return submission.said + "Not compiled: the first error is above.";
        case Outcome::refused:
            return "It cannot be drawn: " + submission.said;
        case Outcome::tooLong:
            return "It takes too long: is there a loop that does not end?";
        case Outcome::tooMuch:
            return "It wrote more than a picture.";
        default:
            return "It crashed: " + submission.said + "\n`./relief view` names the line.";
    }
}

}  // namespace

Expected<void> exercise(const std::string& name)
{
    const Expected<std::vector<Exercise>> all = allExercises();
    if (!all) return tl::unexpected(all.error());
    if (name.empty()) {
        listAll(*all);
        return {};
    }
    const Expected<const Exercise*> found = findExercise(*all, name);
    if (!found) return tl::unexpected(found.error());
    const std::string path = std::string(kFolder) + "/" + (*found)->stem + ".cpp";
    std::error_code error;
    if (fs::exists(pathOf(path), error)) {
        return fail(path + ": is there already, and stays as it is; rename or remove it to begin again");
    }
    fs::create_directories(kFolder, error);
    const std::string text = learnersText(**found, path);
    const Expected<void> written =
        writeFileAtomically(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    if (written) std::printf("%s\n", path.c_str());
    return written;
}

Expected<int> checkExercise(const std::string& file)
{
    if (!live::namesFile(file)) {
        return fail("check-exercise " + file + ": name your file, such as exercises/" + file + "_....cpp");
    }
    const Expected<live::StageSource> source = live::findSource(file);
    if (!source)
        return fail(file + ": there is no such file; `relief exercise` lists exercises, and writes one's file");
    const Expected<std::string> text = readText(source->path);
    if (!text) return tl::unexpected(text.error());
    const std::string id = exerciseIdOf(file, *text);
    if (id.empty()) {
        return fail(file + ": does not say which exercise it is; let it begin with a line such as // Exercise 1.08a");
    }
    const Expected<std::vector<Exercise>> all = allExercises();
    if (!all) return tl::unexpected(all.error());
    const Expected<const Exercise*> found = findExercise(*all, id);
    if (!found) return fail(file + ": " + found.error().message);
    const Expected<Catalogue> catalogue = readCatalogue(**found);
    if (!catalogue) return tl::unexpected(catalogue.error());
    const Expected<const live::Toolchain*> toolchain = live::findToolchain();
    if (!toolchain) return tl::unexpected(toolchain.error());

    const Submission submission = run(source->path, {});
    if (!submission.picture) {
        std::printf("%s\n", sentenceOf(submission).c_str());
        return 1;
    }
    const Diagnosis diagnosis = diagnose(**found, *catalogue, *submission.picture);
    std::printf("%s\n", diagnosis.sentence.c_str());
    if (!diagnosis.isSolved()) return 1;
    remember(pathOf(source->path).parent_path(), id);
    std::printf("Why: %s/answer/README.md\n", (*found)->folder.c_str());
    return 0;
}

}  // namespace relief::samples

#include "grader/grade.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

#include "common/pattern.h"
#include "grader/commands.h"
#include "live/toolchain.h"
#include "relief/file.h"
#include "relief/path.h"
#include "relief/pipeline/workers.h"

namespace relief::samples {

namespace {

namespace fs = std::filesystem;
using namespace relief::samples::grader;

constexpr std::uintmax_t kMostText = 1 << 20;  // bytes of a file

// Files of C++ in a folder and those in it. What is a link is no file: it could lead to another learner's.
Expected<std::vector<Graded>> filesIn(const std::string& folder)
{
    std::vector<Graded> all;
    std::error_code error;
    const fs::path root = pathOf(folder);
    for (auto it = fs::recursive_directory_iterator(root, error); !error && it != fs::recursive_directory_iterator();
         it.increment(error)) {
        std::error_code ignored;
        if (it->path().extension() != ".cpp" || !fs::is_regular_file(it->symlink_status(ignored))) continue;
        Graded one;
        const fs::path relative = it->path().lexically_relative(root);
        one.file = utf8Of(relative);
        static const Pattern named("(.+)_\\d\\.\\d\\d[a-z](_.*)?");
        const std::string stem = utf8Of(relative.stem());
        const bool isAlone = relative.begin() == --relative.end();
        const auto name = named.match(stem);
        one.learner = !isAlone ? utf8Of(*relative.begin()) : name ? (*name)[1] : stem;
        all.push_back(std::move(one));
    }
    if (error) return fail(folder + ": cannot read the folder (" + error.message() + "); name one with files in it");
    if (all.empty()) return fail(folder + ": has no file that ends with .cpp; name the folder that holds the files");
    std::sort(all.begin(), all.end(), [](const Graded& a, const Graded& b) { return a.file < b.file; });
    return all;
}

std::string gapText(const std::string& text)
{
    std::string gap;
    for (const Span& span : gapsOf(text)) gap += text.substr(span.begin, span.end - span.begin);
    gap = Pattern("//[^\n]*").replace(gap, "");
    gap.erase(
        std::remove_if(gap.begin(), gap.end(), [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }),
        gap.end());
    return gap;
}

struct Class
{
    std::string folder;
    Limits limits;
    std::vector<Exercise> exercises;
    std::map<std::string, Catalogue> catalogues;  // by id
};

void refuse(Graded& one, const std::string& verdict, const std::string& sentence)
{
    one.verdict = verdict;
    one.sentence = sentence;
}

// Each in a process of its own: this may run beside others.
void gradeOne(const Class& its, Graded& one)
{
    const std::string path = its.folder + "/" + one.file;
    std::error_code error;
    if (fs::file_size(pathOf(path), error) > kMostText) return refuse(one, "refused", "the file is larger than 1 MB");
    const Expected<std::string> text = readText(path);
    if (!text) return refuse(one, "refused", text.error().message);
    const Expected<const Exercise*> exercise = findExercise(its.exercises, exerciseIdOf(path, *text));
    if (!exercise) return refuse(one, "refused", "does not say which exercise it is");
    one.id = (*exercise)->id;
    one.title = (*exercise)->title;
    one.gap = gapText(*text);
    const Submission submission = run(path, its.limits);
    one.seconds = submission.seconds;
    if (!submission.picture) {
        const bool hasSaid = submission.outcome == Submission::Outcome::notCompiled ||
                             submission.outcome == Submission::Outcome::refused ||
                             submission.outcome == Submission::Outcome::crashed;
        return refuse(one, wordOf(submission.outcome), hasSaid ? submission.said : "");
    }
    one.diagnosis = diagnose(**exercise, its.catalogues.at(one.id), *submission.picture);
    one.picture = codesOf(*submission.picture);
    one.verdict = wordOf(one.diagnosis->kind);
    one.sentence = one.diagnosis->sentence;
    one.isSolved = one.diagnosis->isSolved();
}

// Names learners who have the same text in the gap, but for spaces and comments.
void nameTwins(std::vector<Graded>& all)
{
    for (Graded& a : all) {
        for (const Graded& b : all) {
            if (a.learner == b.learner || a.id != b.id || a.gap != b.gap || a.gap.size() < kLeastShared) continue;
            if (a.twins.empty() || a.twins.back() != b.learner) a.twins.push_back(b.learner);
        }
    }
}

void print(const std::vector<Graded>& all, const std::string& output)
{
    std::size_t solved = 0, width = 8;
    for (const Graded& one : all) width = std::min<std::size_t>(24, std::max(width, one.learner.size()));
    for (const Graded& one : all) {
        solved += one.isSolved;
        std::string twins;
        for (const std::string& twin : one.twins)
            twins += (twins.empty() ? " [the same text as " : ", ") + printable(twin);
        std::printf("%-*s  %-5s  %-15s  %s%s\n", static_cast<int>(width), printable(one.learner).c_str(),
                    one.id.empty() ? "-" : one.id.c_str(), one.verdict.c_str(), printable(one.sentence).c_str(),
                    twins.empty() ? "" : (twins + "]").c_str());
    }
    std::printf("\n%zu of %zu solved. %s/index.html shows every picture.\n", solved, all.size(), output.c_str());
}

Expected<Class> prepare(const GradeOptions& options)
{
    Class its{options.folder, {options.seconds, options.megabytes, !options.withoutSandbox}, {}, {}};
    if (its.limits.isSandboxed) {
        if (const Expected<void> checked = checkSandbox(); !checked) {
            return fail("grade " + options.folder + ": " + checked.error().message);
        }
    }
    if (const auto toolchain = live::findToolchain(); !toolchain) return tl::unexpected(toolchain.error());
    Expected<std::vector<Exercise>> exercises = allExercises();
    if (!exercises) return tl::unexpected(exercises.error());
    its.exercises = std::move(*exercises);
    for (const Exercise& e : its.exercises) {
        Expected<Catalogue> catalogue = readCatalogue(e);
        if (!catalogue) return tl::unexpected(catalogue.error());
        its.catalogues.emplace(e.id, std::move(*catalogue));
    }
    return its;
}

}  // namespace

std::string grader::printable(const std::string& text)
{
    std::string line;
    for (const char c : text.substr(0, 400)) {
        const auto code = static_cast<unsigned char>(c);
        line += code < 0x20 || code == 0x7f ? ' ' : c;
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

Expected<int> grade(const GradeOptions& options)
{
    Expected<std::vector<Graded>> all = filesIn(options.folder);
    if (!all) return tl::unexpected(all.error());
    const Expected<Class> its = prepare(options);
    if (!its) return tl::unexpected(its.error());
    Workers(options.threads).run(static_cast<int>(all->size()), [&](int task, int) {
        gradeOne(*its, (*all)[static_cast<std::size_t>(task)]);
    });
    nameTwins(*all);
    fs::path folder = pathOf(options.folder);
    if (!folder.has_filename()) folder = folder.parent_path();
    const std::string output = options.output.empty() ? utf8Of(folder) + "-grades" : options.output;
    if (const Expected<void> written = writeGrades(output, *all, its->exercises); !written) {
        return tl::unexpected(written.error());
    }
    print(*all, output);
    return std::all_of(all->begin(), all->end(), [](const Graded& one) { return one.isSolved; }) ? 0 : 1;
}

}  // namespace relief::samples

// The report of exercises: wrong answers at random, and what is said of them. A diagnosis is right where the picture is
// that of the named mistake, bit for bit, or else where that mistake changes the very place that was mutated; "unknown"
// is right where no known mistake changes that place.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "command_line.h"
#include "cost.h"
#include "grader/diagnosis.h"
#include "grader/mutate.h"
#include "grader/submission.h"
#include "live/compile.h"
#include "relief/pipeline/workers.h"
#include "report.h"

namespace {

using namespace relief;
using namespace relief::samples;
using namespace relief::samples::grader;

constexpr unsigned kSeed = 20;

struct Trial
{
    const Exercise* exercise;
    Mutation mutation;
    std::string result;  // "no picture", "the same", or how the diagnosis is judged: "right, bit for bit" ...
    double drawn = 0.0, diagnosed = 0.0;  // milliseconds
    Diagnosis diagnosis;
};

// Mutations of all exercises but the open ones, which have no single goal; each exercise as often as any other.
std::vector<Trial> trialsOf(const std::vector<Exercise>& all, std::size_t most)
{
    std::mt19937 random(kSeed);
    std::vector<std::vector<Trial>> each;
    for (const Exercise& e : all) {
        if (e.isOpen()) continue;
        std::vector<Trial>& its = each.emplace_back();
        for (const Mutation& m : mutationsOf(e.answer)) its.push_back({&e, m, {}, {}});
        // std::shuffle may do otherwise elsewhere.
        for (std::size_t i = its.size(); i > 1; --i) std::swap(its[i - 1], its[random() % i]);
    }
    std::vector<Trial> trials;
    for (std::size_t round = 0; trials.size() < most; ++round) {
        bool any = false;
        for (const std::vector<Trial>& its : each) {
            if (round < its.size()) trials.push_back(its[round]);
            any = any || round < its.size();
        }
        if (!any) break;
    }
    return trials;
}

bool touches(const Exercise& exercise, const Mistake& mistake, const Span& place)
{
    for (const Replacement& change : mistake.changes) {
        const std::optional<Span> its = changedSpan(exercise, change);
        if (its && its->begin <= place.end && place.begin <= its->end) return true;
    }
    return false;
}

// One change cannot be two mistakes: a pair that is only near is wrong.
std::string judged(const Trial& trial)
{
    const Exercise& e = *trial.exercise;
    const Diagnosis& d = trial.diagnosis;
    const auto touching = [&](const std::string& name) {
        return std::any_of(e.mistakes.begin(), e.mistakes.end(), [&](const Mistake& m) {
            return (name.empty() || m.name == name) && touches(e, m, trial.mutation.span);
        });
    };
    if (d.isSolved()) return "the same";
    if (d.kind == Diagnosis::Kind::exact || d.kind == Diagnosis::Kind::start) return "right, bit for bit";
    if (d.kind == Diagnosis::Kind::near) return touching(d.entry) ? "right, near" : "wrong";
    if (touching(d.entry)) return "missed";
    return touching("") ? "unknown, another change there" : "unknown, no mistake there";
}

void runOne(Trial& trial, const std::map<std::string, Catalogue>& catalogues, const std::string& folder, int number)
{
    const std::string path = folder + "/" + std::to_string(number) + ".cpp";
    std::ofstream(path, std::ios::binary) << trial.mutation.applied(trial.exercise->answer);
    using Clock = std::chrono::steady_clock;
    const auto since = [](Clock::time_point begin) {
        return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    };
    Clock::time_point begin = Clock::now();
    const Submission submission = run(path, {.seconds = 5.0});
    trial.drawn = since(begin);
    trial.result = "no picture";
    if (!submission.picture) return;
    begin = Clock::now();
    trial.diagnosis = diagnose(*trial.exercise, catalogues.at(trial.exercise->id), *submission.picture);
    trial.diagnosed = since(begin);
    trial.result = judged(trial);
}

bool isWrongAnswer(const Trial& trial)
{
    return trial.result != "no picture" && trial.result != "the same" && !trial.result.empty();
}

// A text as a cell of the table.
std::string cell(std::string text)
{
    for (std::size_t at = 0; (at = text.find_first_of("|\n", at)) != std::string::npos; at += 2) {
        text.replace(at, 1, text[at] == '|' ? "\\|" : "  ");
    }
    return text.empty() ? "" : "`" + text + "`";
}

std::string rowOf(const Trial& t)
{
    const Span& span = t.mutation.span;
    const std::string from = t.exercise->answer.substr(span.begin, span.end - span.begin);
    char apart[64];
    std::snprintf(apart, sizeof apart, "%.2f | %.2f", t.diagnosis.nearest, t.diagnosis.next);
    return "| " + t.exercise->id + " | " + t.mutation.kind + " | " + cell(from) + " | " + cell(t.mutation.to) + " | " +
           t.result + " | " + t.diagnosis.entry + " | " + apart + " |\n";
}

// The share of each result, with those that are right first.
std::string countsOf(const std::vector<Trial>& trials)
{
    std::map<std::string, std::size_t> counts;
    for (const Trial& t : trials) ++counts[t.result];
    const std::size_t whole = trials.size() - counts["no picture"] - counts["the same"];
    std::string text = std::to_string(trials.size()) + " changes were tried. " + std::to_string(counts["no picture"]) +
                       " do not compile or never end, and " + std::to_string(counts["the same"]) +
                       " give the right picture. The others are wrong answers.\n\n| of " + std::to_string(whole) +
                       " wrong answers | | |\n|---|---|---|\n";
    const auto row = [&](const std::string& meaning, std::size_t count) {
        char line[64];
        std::snprintf(line, sizeof line, " | %zu | %.1f %% |\n", count,
                      100.0 * static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, whole)));
        text += "| " + meaning + line;
    };
    row("right: named, bit for bit", counts["right, bit for bit"]);
    row("right: named by the nearest picture, and that mistake changes the same place", counts["right, near"]);
    row("right: unknown, and no known mistake changes that place", counts["unknown, no mistake there"]);
    row("right: unknown, and the nearest picture is not of a mistake at that place",
        counts["unknown, another change there"]);
    row("missed: unknown, although the nearest picture is of a mistake at that place", counts["missed"]);
    row("wrong: another mistake was named", counts["wrong"]);
    row("**right, together**", whole - counts["missed"] - counts["wrong"]);
    return text;
}

// What an answer takes, where it is a wrong one.
std::string timesOf(const std::vector<Trial>& trials)
{
    std::vector<double> drawn, diagnosed;
    for (const Trial& t : trials) {
        if (!isWrongAnswer(t)) continue;
        drawn.push_back(t.drawn);
        diagnosed.push_back(t.diagnosed);
    }
    const auto row = [](const std::string& what, std::vector<double>& times) {
        std::sort(times.begin(), times.end());
        char line[64];
        std::snprintf(line, sizeof line, " | %.1f | %.1f |\n", times[times.size() / 2], times.back());
        return "| " + what + line;
    };
    if (drawn.empty()) return "";
    return "\n| milliseconds for an answer, several at once | median | longest |\n|---|---|---|\n" +
           row("compiled and drawn, in a process of its own", drawn) + row("diagnosed", diagnosed);
}

std::string pageOf(const std::vector<Trial>& trials, const ReportOptions& options)
{
    std::string rows;
    for (const Trial& t : trials) {
        if (isWrongAnswer(t)) rows += rowOf(t);
    }
    char bounds[256];
    std::snprintf(
        bounds, sizeof bounds,
        "\nA mistake is named by its nearest picture if that is at most %.1f codes of 255 away on average, and the "
        "next one at least %.1f times as far.",
        kNear, kMargin);
    return reportHead("Exercises: what is said of wrong answers", options) +
           "\nA program that does not know the catalogue makes one small change at random to the answer of an "
           "exercise: "
           "another sign, number, name, swizzle or function, or a line less. Each such answer is compiled, drawn and "
           "diagnosed as `./relief check-exercise` does it.\n\n" +
           countsOf(trials) + timesOf(trials) + bounds +
           " What is unknown is shown the nearest picture as well, with the words that it says little.\n\n## All of "
           "them\n\n"
           "The last two columns: how far the nearest known picture is away, in codes of 255 on average, and the next "
           "one. "
           "Both are 0 where the picture is known bit for bit.\n\n"
           "| exercise | change | from | to | judged | nearest known | its distance | the next |\n"
           "|---|---|---|---|---|---|---|---|\n" +
           rows;
}

Expected<void> report(const ReportOptions& options)
{
    const auto wanted = static_cast<std::size_t>(options.rounds);
    const Expected<std::vector<Exercise>> all = allExercises();
    if (!all) return tl::unexpected(all.error());
    std::map<std::string, Catalogue> catalogues;
    for (const Exercise& e : *all) {
        Expected<Catalogue> catalogue = readCatalogue(e);
        if (!catalogue) return tl::unexpected(catalogue.error());
        catalogues.emplace(e.id, std::move(*catalogue));
    }
    const Expected<live::PrivateFolder> folder = live::PrivateFolder::create();
    if (!folder) return tl::unexpected(folder.error());
    std::vector<Trial> trials = trialsOf(*all, 4 * wanted);
    Workers workers(0);
    std::size_t done = 0, wrongAnswers = 0;
    constexpr std::size_t kAtOnce = 16;
    while (done < trials.size() && wrongAnswers < wanted) {
        const std::size_t count = std::min(kAtOnce, trials.size() - done);
        workers.run(static_cast<int>(count), [&](int task, int) {
            const std::size_t i = done + static_cast<std::size_t>(task);
            runOne(trials[i], catalogues, folder->path, static_cast<int>(i));
        });
        for (std::size_t i = done; i < done + count && wrongAnswers < wanted; ++i)
            wrongAnswers += isWrongAnswer(trials[i]);
        done += count;
        showProgress("wrong answers: " + std::to_string(wrongAnswers) + " of " + std::to_string(wanted));
    }
    showProgress("");
    // The first ones in the order of their numbers, so that threads make no difference.
    std::size_t kept = 0;
    for (wrongAnswers = 0; kept < done && wrongAnswers < wanted; ++kept) wrongAnswers += isWrongAnswer(trials[kept]);
    trials.resize(kept);
    return writeReport(options, "exercises.md", pageOf(trials, options));
}

}  // namespace

int main(int argc, char** argv)
{
    return runProgram(argc, argv, {.reportName = "exercises", .report = report});
}

// What an exercise is read from, the texts that are made of it, and what is wrong with one that is not.
#include "grader/exercise.h"
#include "contents.h"

#include <algorithm>
#include <filesystem>

#include <doctest/doctest.h>

#include "live_command.h"

namespace {

using namespace relief;
using namespace relief::samples::grader;

constexpr const char* kAnswer =
    "// head\nnamespace relief::samples {\n    // your turn: a sum\n    sum = a + b * c;\n    // end of your turn\n}\n";

std::string page(const std::string& mistakes)
{
    return "# 1.08a Along v\n\nStage 1.08 · derive\n\nAdd it up.\n\nAll of it.\n\n## Hints\n\n1. Plus.\n\n## Start\n\n"
           "```cpp\n    sum = 0;\n```\n\n## Mistakes\n\n" +
           mistakes;
}

const std::string kMistakes =
    "- `minus` Your sum is a difference. See 1.07.\n  - `a + b` -> `a - b`\n"
    "- `no-c` The factor c is missing.\n  - ` * c` -> ``\n"
    "- `a-twice` You have a twice: b is missing. See 1.08 and 1.09.\n  - `+ b` -> `+ a`\n"
    "- `half` It is half of it.\n  - `= a` -> `= 0.5f * a`\n"
    "- `c-for-a` You have c for a.\n  - `a + b * c` -> `c + b * c`\n";

// The exercise of these texts, or what is wrong.
Expected<Exercise> read(const TemporaryFolder& folder, const std::string& text, const std::string& answer = kAnswer,
                        const std::string& stem = "1.08a_along_v")
{
    std::filesystem::create_directories(folder / stem / "answer");
    folder.write(stem + "/exercise.md", text);
    folder.write(stem + "/answer/answer.cpp", answer);
    return readExercise((folder / stem).string());
}

}  // namespace

TEST_CASE("exercise: a page and an answer are read as they are written")
{
    const TemporaryFolder folder;
    const Expected<Exercise> e = read(folder, page(kMistakes));
    REQUIRE_MESSAGE(e.has_value(), e.error().message);
    CHECK(e->id == "1.08a");
    CHECK(e->title == "Along v");
    CHECK(e->stage == "1.08");
    CHECK(e->kind == "derive");
    CHECK(e->task == "Add it up.\n\nAll of it.");
    CHECK(e->hints == std::vector<std::string>{"Plus."});
    CHECK(e->starts == std::vector<std::string>{"    sum = 0;\n"});
    REQUIRE(e->mistakes.size() == 5);
    CHECK(e->mistakes[0].sentence == "Your sum is a difference");
    CHECK(e->mistakes[0].see == "See 1.07.");
    CHECK(e->mistakes[1].see.empty());
    CHECK(e->mistakes[2].sentence == "You have a twice: b is missing");
    CHECK(e->mistakes[2].see == "See 1.08 and 1.09.");
}

TEST_CASE("exercise: variants are the answer with one mistake in it, or with two that change different places")
{
    const TemporaryFolder folder;
    const Expected<Exercise> e = read(folder, page(kMistakes));
    REQUIRE(e.has_value());
    const Expected<std::vector<Variant>> variants = variantsOf(*e);
    REQUIRE(variants.has_value());
    const auto textOf = [&](const std::string& name) {
        const auto found =
            std::find_if(variants->begin(), variants->end(), [&](const Variant& v) { return v.name == name; });
        return found != variants->end() ? found->text : "";
    };
    CHECK(textOf("answer") == kAnswer);
    CHECK(contains(textOf("start"), "    // your turn: a sum\n    sum = 0;\n    // end of your turn\n"));
    CHECK(contains(textOf("minus"), "sum = a - b * c;"));
    CHECK(contains(textOf("no-c"), "sum = a + b;"));
    CHECK(contains(textOf("minus+no-c"), "sum = a - b;"));
    CHECK(contains(textOf("no-c+half"), "sum = 0.5f * a + b;"));
    CHECK(textOf("minus+a-twice").empty());  // both change the plus
    CHECK(textOf("minus+c-for-a").empty());
    CHECK(variants->size() == 2 + 5 + 4);
    const std::optional<Span> span = changedSpan(*e, e->mistakes[0].changes[0]);
    REQUIRE(span.has_value());
    CHECK(e->answer.substr(span->begin, span->end - span->begin) == "+");
}

TEST_CASE("exercise: a learner's file has task, commands, gap and hints, and says which exercise it is")
{
    const TemporaryFolder folder;
    const Expected<Exercise> e = read(folder, page(kMistakes));
    REQUIRE(e.has_value());
    const std::string text = learnersText(*e, "exercises/1.08a_along_v.cpp");
    CHECK(text.starts_with("// Exercise 1.08a Along v (derive)\n//\n// Add it up.\n//\n// All of it.\n//\n"));
    CHECK(contains(text, "./relief check-exercise exercises/1.08a_along_v.cpp"));
    CHECK(contains(text, "    sum = 0;\n"));
    CHECK(!contains(text, "a + b"));
    CHECK(!contains(text, "// head"));
    CHECK(text.ends_with("// Hint 1: Plus.\n"));
    CHECK(exerciseIdOf("x.cpp", text) == "1.08a");
    CHECK(exerciseIdOf("a/1.08a_mine.cpp", "// ...") == "1.08a");
    CHECK(exerciseIdOf("a/mine.cpp", "// ...").empty());
}

TEST_CASE("exercise: a page that is none says what is wrong, in one line that names it")
{
    const TemporaryFolder folder;
    const auto problem = [&](const std::string& text, const std::string& answer = kAnswer,
                             const std::string& stem = "1.08a_along_v") {
        const Expected<Exercise> e = read(folder, text, answer, stem);
        if (!e) return e.error().message;
        const Expected<std::vector<Variant>> variants = variantsOf(*e);
        return variants ? std::string() : variants.error().message;
    };
    const std::string good = page(kMistakes);
    CHECK(problem(good).empty());
    CHECK(contains(problem("nothing\n"), "/exercise.md: its first line"));
    CHECK(contains(problem(good, "no marks"), "has no lines"));
    CHECK(contains(problem(good, kAnswer, "2.01a_other"), "not named after its id"));
    CHECK(contains(problem(page("- `minus` Only one.\n  - `a + b` -> `a - b`\n")), "five mistakes"));
    CHECK(contains(problem(page("- minus\n")), "write - `name`"));
    CHECK(
        contains(problem(page(kMistakes + "- `new` It is new.\n  - `q` -> `r`\n")), "mistake new: `q` does not stand"));
    CHECK(contains(problem(page(kMistakes + "- `new` It is new.\n  - ` ` -> `r`\n")), "exactly once"));
    CHECK(contains(problem(good + "\n## Other\n\nwords\n"), "section 'Other'"));
}

TEST_CASE("exercise: all that there are can be read, and their stages, hints and explanations are there")
{
    const Expected<std::vector<Exercise>> all = allExercises();
    REQUIRE_MESSAGE(all.has_value(), all.error().message);
    for (const Exercise& e : *all) {
        CAPTURE(e.id);
        CHECK(e.answer.starts_with("// " + e.id + " " + e.title + ":"));
        CHECK(std::filesystem::exists(e.folder + "/answer/README.md"));
        CHECK(std::filesystem::exists(e.folder + "/goal.png"));
        CHECK_MESSAGE(contents(e.folder + "/start.txt") == learnersText(e, "exercises/" + e.stem + ".cpp"),
                      "run update_exercises");
        CHECK(e.id.starts_with(e.stage));
        CHECK(std::count(e.answer.begin(), e.answer.end(), '\n') <= 120);
        const Expected<std::vector<Variant>> variants = variantsOf(e);
        CHECK_MESSAGE(variants.has_value(), variants.error().message);
        CHECK(findExercise(*all, e.id).value() == &e);
    }
    CHECK(contains(findExercise(*all, "9.99a").error().message, "`relief exercise` lists them all"));
    CHECK(contains(findExercise(*all, "1.08").error().message, "did you mean 1.08a"));
}

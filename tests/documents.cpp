// The documents and the tree: every stage has its page and its golden, every page its stage, every relative link leads
// somewhere, and the folders of the engine depend downwards only.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "common/pattern.h"
#include "common/stage.h"
#include "contents.h"
#include "relief/texture/image.h"
#include "stages/page_diff.h"

namespace {

namespace fs = std::filesystem;
using relief::samples::allStages;
using relief::samples::Match;
using relief::samples::Pattern;
using relief::samples::Stage;

const fs::path kSource = RELIEF_SOURCE_FOLDER;

// Files of the project with this ending; not what was built.
std::vector<fs::path> filesEndingIn(const fs::path& folder, const std::string& ending)
{
    std::vector<fs::path> found;
    for (auto it = fs::recursive_directory_iterator(folder); it != fs::recursive_directory_iterator(); ++it) {
        const std::string name = it->path().filename().string();
        if (it->is_directory() && (name == "build" || name == "gallery" || name.starts_with("."))) {
            it.disable_recursion_pending();
        }
        if (it->is_regular_file() && name.ends_with(ending)) found.push_back(it->path());
    }
    return found;
}

}  // namespace

TEST_CASE("documents: every stage has a page of its stem, with its picture, and a golden")
{
    CHECK(allStages().size() >= 14);
    for (const Stage& stage : allStages()) {
        CAPTURE(stage.stem);
        const fs::path page = kSource / "docs" / stage.folder / (stage.stem + ".md");
        REQUIRE(fs::exists(page));
        const std::string text = contents(page);
        CHECK(text.find("# " + stage.name()) != std::string::npos);
        CHECK(text.find(stage.folder + "/" + stage.stem + ".png") != std::string::npos);
        CHECK(fs::exists(kSource / "tests/golden" / stage.folder / (stage.stem + ".png")));
    }
}

TEST_CASE("documents: every page, golden and stage source belongs to a registered stage")
{
    std::set<std::string> known;
    for (const Stage& stage : allStages()) known.insert(stage.folder + "/" + stage.stem);
    std::set<std::string> folders;
    for (const Stage& stage : allStages()) folders.insert(stage.folder);
    for (const std::string& folder : folders) {
        for (const auto& [place, ending] :
             std::map<std::string, std::string>{{"docs", ".md"}, {"tests/golden", ".png"}, {"samples", ".cpp"}}) {
            for (const fs::path& path : filesEndingIn(kSource / place / folder, ending)) {
                CAPTURE(path);
                CHECK(known.count(folder + "/" + path.stem().string()) == 1);
            }
        }
    }
}

TEST_CASE(
    "documents: a stage is at most 120 lines (170 where it holds several variants), and differs from the one before it "
    "by "
    "little")
{
    for (const Stage& stage : allStages()) {
        CAPTURE(stage.stem);
        const std::string text = contents(kSource / "samples" / stage.folder / (stage.stem + ".cpp"));
        const bool hasVariants = text.find("\ntemplate <") != std::string::npos;
        CHECK(std::count(text.begin(), text.end(), '\n') <= (hasVariants ? 170 : 120));
        CHECK(text.starts_with("// " + stage.name()));
        CHECK(text.find("\n// New: ") != std::string::npos);
        CHECK(text.find("\n// Was: ") != std::string::npos);
    }
}

TEST_CASE("documents: the pages show the difference to the stage before as it is")
{
    const auto source = [](const Stage& s) { return contents(kSource / "samples" / s.folder / (s.stem + ".cpp")); };
    int checked = 0;
    for (std::size_t i = 1; i < allStages().size(); ++i) {
        const Stage& before = allStages()[i - 1];
        const Stage& stage = allStages()[i];
        CAPTURE(stage.stem);
        const bool begins = before.folder != stage.folder;
        const std::string news =
            begins ? pages::withoutMarks(source(stage)) : pages::marked(source(before), source(stage));
        CHECK_MESSAGE(pages::sameMarks(source(stage), news), "run build/release/tests/update_pages");
        const std::string page = contents(kSource / "docs" / stage.folder / (stage.stem + ".md"));
        const auto updated = pages::withDifference(page, pages::difference(source(before), source(stage)));
        CHECK((updated.has_value() || before.folder != stage.folder || stage.folder == "basics"));
        if (!updated) continue;
        CHECK_MESSAGE(*updated == page, "run build/release/tests/update_pages");
        ++checked;
    }
    CHECK(checked >= 26);
}

TEST_CASE("documents: neighbours can be told apart, or the page shows the difference beside them")
{
    const auto picture = [](const Stage& s) {
        return relief::readImage((kSource / "tests/golden" / s.folder / (s.stem + ".png")).string());
    };
    for (std::size_t i = 1; i < allStages().size(); ++i) {
        const Stage &before = allStages()[i - 1], &stage = allStages()[i];
        if (before.folder != stage.folder) continue;
        CAPTURE(stage.id);
        const relief::Expected<relief::ImageFile> first = picture(before), second = picture(stage);
        REQUIRE(first.has_value());
        REQUIRE(second.has_value());
        const auto &a = std::get<relief::Image8>(*first), &b = std::get<relief::Image8>(*second);
        REQUIRE(a.pixels.size() == b.pixels.size());
        int drawn = 0, different = 0;  // pixels: not the background's in both; by 8 codes or more
        for (std::size_t at = 0; at < a.pixels.size(); at += 4) {
            int largest = 0;
            bool isBackground = true;
            for (std::size_t c = 0; c < 3; ++c) {
                largest = std::max(largest, std::abs(a.pixels[at + c] - b.pixels[at + c]));
                isBackground = isBackground && a.pixels[at + c] == a.pixels[c] && b.pixels[at + c] == a.pixels[c];
            }
            drawn += !isBackground;
            different += largest >= 8;
        }
        const double percent = 100.0 * different / drawn;
        CAPTURE(percent);
        const std::string page = contents(kSource / "docs" / stage.folder / (stage.stem + ".md"));
        const bool isEqualByDesign = stage.id == "3.03";
        CHECK((percent >= 10.0 || isEqualByDesign || page.find("](../pictures/") != std::string::npos));
    }
}

TEST_CASE("documents: a difference is the changed lines and two around them")
{
    const std::string before = "// head\na\nb\nc\nd\ne\nStage x()\n", after = "// other\na\nb\nC\nd\ne\nf\nStage y()\n";
    CHECK(pages::difference(before, after) == " a\n b\n-c\n+C\n d\n e\n+f\n");
    CHECK(pages::difference(before, before).empty());
}

TEST_CASE("documents: lines that are new in a stage's programs are marked")
{
    const std::string before = "namespace {\na\nb\nc\nd\n}  // namespace\nStage x()\n";
    const std::string after = "namespace {\na\nB;\nb\n};\nc\n   // new\nd\n}  // namespace\nStage y()\n";
    const std::string news = pages::marked(before, after);
    CHECK(news == "namespace {\na\nB;  // new\nb\n};\nc\n\nd\n}  // namespace\nStage y()\n");
    CHECK(pages::marked(before, news) == news);
    CHECK(pages::sameMarks(news, "namespace {\na\nB;     // new\nb\n};\nc\n\nd\n}  // namespace\nStage y()\n"));
    CHECK(!pages::sameMarks(news, after));
    CHECK(pages::marked(before, "namespace {\nA\nB\nC\n") == "namespace {\nA\nB\nC\n");
    CHECK(pages::difference(before, news) == pages::difference(before, pages::withoutMarks(news)));
}

TEST_CASE("documents: every relative link resolves")
{
    const Pattern link(R"(\]\(([^)\s]+)\)|(?:src|href)=\"([^\"]+)\")");
    int checked = 0;
    for (const fs::path& page : filesEndingIn(kSource, ".md")) {
        const std::string text = contents(page);
        for (const Match& m : link.find(text)) {
            std::string target = m.has(1) ? m[1] : m[2];
            if (target.starts_with("http") || target.starts_with("#") || target.starts_with("mailto:")) continue;
            target = target.substr(0, target.find('#'));
            CAPTURE(page);
            CAPTURE(target);
            CHECK(fs::exists(page.parent_path() / target));
            ++checked;
        }
    }
    CHECK(checked > 30);
}

TEST_CASE("documents: the lines that porting.md shows of a file stand in that file")
{
    const std::string page = contents(kSource / "docs/porting.md");
    const Pattern block("[Ii]n `([^`]+)`:\n\n```cpp\n([^`]*)```");
    int checked = 0;
    for (const Match& m : block.find(page)) {
        const fs::path file = kSource / m[1];
        CAPTURE(file);
        REQUIRE(fs::exists(file));
        const std::string text = pages::withoutMarks(contents(file));
        std::stringstream lines(m[2]);
        for (std::string line; std::getline(lines, line);) {
            CAPTURE(line);
            CHECK(text.find(line + "\n") != std::string::npos);
            ++checked;
        }
    }
    CHECK(checked >= 30);
}

TEST_CASE("documents: the engine's folders include downwards only")
{
    const std::map<std::string, std::set<std::string>> below = {
        {"lanes", {}},
        {"hlsl", {"lanes"}},
        {"texture", {"lanes", "hlsl"}},
        {"mesh", {"lanes"}},
        {"scene", {"lanes", "hlsl", "texture", "mesh"}},
        {"shading", {"lanes", "hlsl", "texture", "mesh"}},
        {"pipeline", {"lanes", "hlsl", "texture", "mesh"}},
        {"trace", {"lanes", "hlsl", "texture", "mesh", "pipeline"}},
        {"check", {"lanes", "hlsl", "texture", "mesh", "pipeline", "trace"}},
    };
    const Pattern include(R"re(#include "relief/([a-z_]+)/)re");
    int checked = 0;
    for (const auto& [folder, allowed] : below) {
        for (const std::string ending : {".h", ".cpp"}) {
            for (const fs::path& path : filesEndingIn(kSource / "engine/relief" / folder, ending)) {
                const std::string text = contents(path);
                for (const Match& m : include.find(text)) {
                    const std::string used = m[1];
                    CAPTURE(path);
                    CAPTURE(used);
                    CHECK((used == folder || allowed.count(used) == 1));
                    ++checked;
                }
            }
        }
    }
    CHECK(checked > 50);
}

TEST_CASE("documents: the engine's map names every file of it")
{
    const std::string map = contents(kSource / "engine/README.md");
    for (const fs::path& path : filesEndingIn(kSource / "engine/relief", ".h")) {
        CAPTURE(path);
        CHECK(map.find("`" + path.filename().string() + "`") != std::string::npos);
    }
    for (const fs::path& path : filesEndingIn(kSource / "engine/relief", ".cpp")) {
        CAPTURE(path);
        CHECK((fs::exists(fs::path(path).replace_extension(".h")) ||
               map.find("`" + path.filename().string() + "`") != std::string::npos));
    }
}

TEST_CASE("documents: test names have no character that splits or joins CMake's lists")
{
    // doctest_discover_tests would lose or merge tests, in silence.
    const Pattern name(R"re(TEST_CASE\("([^"]*)"\))re");
    int checked = 0;
    for (const fs::path& path : filesEndingIn(kSource / "tests", ".cpp")) {
        const std::string text = contents(path);
        for (const Match& m : name.find(text)) {
            CAPTURE(m[1]);
            CHECK(m[1].find_first_of(";[]") == std::string::npos);
            ++checked;
        }
    }
    CHECK(checked > 300);
}

TEST_CASE("documents: nothing in the engine prints, exits or throws")
{
    const Pattern forbidden(R"(\b(printf|std::cout|std::cerr|exit\(|abort\(|throw )\b)");
    for (const std::string ending : {".h", ".cpp"}) {
        for (const fs::path& path : filesEndingIn(kSource / "engine/relief", ending)) {
            const std::string text = contents(path);
            std::string code = Pattern("//[^\n]*").replace(text, "");
            code = Pattern("snprintf").replace(code, "");
            // What stands in a test program's main() prints.
            for (const char* adapter : {"test_program.h", "main.h"}) {
                if (path.filename() == adapter) code = Pattern("fprintf").replace(code, "");
            }
            CAPTURE(path);
            CHECK(forbidden.find(code).empty());
        }
    }
}

TEST_CASE("documents: the table of machines has every row that there is, as it last came out")
{
    const std::string page = contents(kSource / "docs/machines.md"), script = contents(kSource / "tests/machines/run");
    const std::string results = contents(kSource / "tests/machines/results.txt");
    const Pattern row("\n([a-z0-9+-]+) +\\| [^\n]*\\|[^\n]*\\|");
    int rows = 0;
    for (const Match& m : row.find(script)) {
        ++rows;
        const std::string name = m[1];
        CAPTURE(name);
        CHECK(page.find("`" + name + "`") != std::string::npos);
        CHECK(("\n" + results).find("\n" + name + " ") != std::string::npos);
    }
    CHECK(rows >= 12);
    std::istringstream lines(results);
    for (std::string line; std::getline(lines, line);) {
        CAPTURE(line);
        CHECK(page.find("\n    " + line + "\n") != std::string::npos);
        CHECK((line.find(" green: 76 of 76 hashes") != std::string::npos ||
               line.find(" skipped: ") != std::string::npos || line.ends_with(" not run")));
    }
}

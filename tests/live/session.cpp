// A stage whose picture follows its file: what a person does to the file, and what must come of it.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>

#include "live/new_stage.h"
#include "live/session.h"
#include "relief/check/hash.h"
#include "relief/file.h"
#include "temporary_folder.h"

namespace {

using namespace std::chrono_literals;
using namespace relief;
using namespace relief::samples;
using namespace relief::samples::live;

Maker& theMaker()
{
    static const std::unique_ptr<Maker> maker = std::move(*Maker::start());
    return *maker;
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

// A file of one's own, and its session.
struct Edited
{
    TemporaryFolder folder;
    std::string path, text;
    std::unique_ptr<Session> session;

    explicit Edited(Look look = {.width = 64, .height = 36, .camera = {}, .settings = {}, .files = {}, .threads = 2},
                    const std::string& from = "")
    {
        path = (folder / "my_shader.cpp").string();
        REQUIRE(writeNewStage(path, from));
        text = *readText(path);
        Expected<std::unique_ptr<Session>> opened = Session::open(*findSource(path), look, theMaker());
        REQUIRE_MESSAGE(opened, (opened ? "" : opened.error().message));
        session = std::move(*opened);
    }
    void save(const std::string& now) const { std::ofstream(path, std::ios::binary) << now; }

    template <class Condition>
    bool until(const Condition& condition, std::chrono::milliseconds patience = 20s) const
    {
        const auto end = Watch::Clock::now() + patience;
        while (!condition() && Watch::Clock::now() < end) session->update(50ms);
        return condition();
    }
    bool awaitVersion(int version) const
    {
        return until([&] { return session->picture().version >= version && session->idle(); });
    }
    bool awaitProblem() const
    {
        return until([&] { return session->problem() != nullptr && session->idle(); });
    }
    std::uint32_t middle() const { return session->picture().pixels[18 * 64 + 32]; }

    // Just before the fragment program's result.
    std::string withLine(const std::string& line) const
    {
        return replaced(text, "        return float4(albedo", "        " + line + "\n        return float4(albedo");
    }
    int numberOf(const std::string& line) const
    {
        std::istringstream stream(withLine(line));
        int number = 0;
        for (std::string row; std::getline(stream, row);) {
            ++number;
            if (row.find(line) != std::string::npos) return number;
        }
        return 0;
    }
};

}  // namespace

TEST_CASE("live: a save changes the picture, an error leaves it, a fix brings the next")
{
    Edited edited;
    REQUIRE(edited.awaitVersion(1));
    REQUIRE(edited.session->problem() == nullptr);
    CHECK(edited.session->stage()->title == "My shader");
    const std::uint32_t before = edited.middle();

    edited.save(edited.withLine("retrun 5;"));
    REQUIRE(edited.awaitProblem());
    const Diagnostic first = edited.session->problem()->diagnostics.front();
    CHECK(first.line == edited.numberOf("retrun 5;"));
    CHECK(first.source.find("retrun 5;") != std::string::npos);
    CHECK(edited.session->problem()->text().find("^") != std::string::npos);
    CHECK(edited.middle() == before);

    edited.save(edited.withLine("return float4(1, 0, 0, 1);"));
    REQUIRE(edited.awaitVersion(3));
    CHECK(edited.session->problem() == nullptr);
    CHECK(edited.middle() == 0xff0000ffu);

    edited.save(replaced(edited.text, "    SV_POSITION position;\n", ""));
    REQUIRE(edited.awaitProblem());
    CHECK(edited.session->problem()->diagnostics.front().line > 0);
    edited.save(replaced(edited.text, "float4 operator()(Interpolators i) const {\n        const float3 albedo",
                         "float3 operator()(Interpolators i) const {\n        const float3 albedo"));
    CHECK(edited.until([&] {
        return edited.session->problem()->diagnostics.front().message ==
               "the fragment program must take the Interpolators that the vertex program returns, and return float4, "
               "or "
               "a struct of SV_Target<0> ... SV_Target<3>, SV_Depth, SV_Coverage";
    }));
}

TEST_CASE("live: camera, properties and size stay over a save, and of two saves within 50 ms the second is shown")
{
    Look look{.width = 64, .height = 36, .camera = {}, .settings = {"tint=0,1,0,1"}, .files = {}, .threads = 1};
    look.camera = Camera{.position = {0.0f, 0.0f, -2.0f}};
    Edited edited(look);
    REQUIRE(edited.awaitVersion(1));
    CHECK((edited.middle() & 0xff00ffu) == 0);
    edited.save(edited.withLine("return float4(1, 0, 0, 1) * tint;"));
    edited.session->update(20ms);
    edited.save(edited.withLine("return float4(1, 1, 1, 1) * tint;"));
    REQUIRE(edited.until([&] { return edited.middle() == 0xff00ff00u; }));
    CHECK(edited.session->picture().drawn.camera.position.z == -2.0f);
    CHECK(edited.session->look().settings == std::vector<std::string>{"tint=0,1,0,1"});

    // A property that is gone does not stand in the way.
    std::string without = replaced(edited.text, "float3 albedo = tex2D(mainTex, i.uv * tiling).xyz() * tint.xyz()",
                                   "float3 albedo = tex2D(mainTex, i.uv * tiling).xyz()");
    edited.save(replaced(without, "float4 tint = rgba(\"tint\"", "float4 tone = rgba(\"tone\""));
    const int version = edited.session->picture().version;
    REQUIRE(edited.awaitVersion(version + 1));
    CHECK(edited.session->problem() == nullptr);
}

TEST_CASE("live: a setting that the stage does not have is one line")
{
    Look look{.width = 64, .height = 36, .camera = {}, .settings = {"depth=1"}, .files = {}};
    Edited edited(look);
    REQUIRE(edited.awaitProblem());
    CHECK(edited.session->problem()->isRefusal);
    CHECK(edited.session->problem()->diagnostics.front().message.find("depth=1") != std::string::npos);
    look.settings = {"tiling=2"};
    edited.session->look(look);
    CHECK(edited.until([&] { return edited.session->picture().version > 0; }));
}

TEST_CASE("live: a view of the frame is shown, views are listed, and one that is gone gives way to the picture")
{
    Look look{.width = 64, .height = 36, .camera = {}, .settings = {}, .files = {}, .threads = 1, .show = "nothing"};
    Edited edited(look);
    REQUIRE(edited.awaitProblem());
    CHECK(edited.session->problem()->isRefusal);
    CHECK(edited.session->problem()->diagnostics.front().message.find("no view 'nothing'") != std::string::npos);
    look.show = "uv";
    edited.session->look(look);
    REQUIRE(edited.awaitVersion(1));
    CHECK((edited.middle() >> 16 & 0xffu) == 0);  // no blue
    const std::vector<ViewName>& views = edited.session->stage()->views;
    CHECK(std::find(views.begin(), views.end(), ViewName{"depth", "0 near, 1 far"}) != views.end());
    look.show = "TEXCOORD9";
    edited.session->look(look);
    edited.save(edited.withLine("return float4(1, 0, 0, 1);"));
    REQUIRE(edited.awaitVersion(2));
    CHECK(edited.middle() == 0xff0000ffu);
}

TEST_CASE("live: a shader that crashes or never ends is named by its line, and the version before comes back")
{
    struct Case
    {
        const char* line;
        const char* words;
    };
    const Case cases[] = {
        {"*static_cast<volatile int*>(nullptr) = 1;", "memory"},
        {"volatile int zero = 0; zero = 7 / zero;", "divides"},
        {"std::abort();", "gives up"},
        {"for (volatile int k = 0;; k = k + 1) {}", "does not come to an end"},
    };
    Edited edited;
    REQUIRE(edited.awaitVersion(1));
    const std::uint32_t before = edited.middle();
    for (const Case& c : cases) {
        const std::string line = c.line;
        CAPTURE(line);
        edited.save(edited.withLine(line));
        REQUIRE(edited.until([&] { return edited.session->problem() != nullptr && !edited.session->compiling(); }));
        REQUIRE(edited.awaitProblem());
        CHECK(edited.session->problem()->text().find(c.words) != std::string::npos);
        CHECK(edited.session->problem()->diagnostics.front().line == edited.numberOf(c.line));
        CHECK(edited.middle() == before);

        edited.save(edited.text + "// " + c.line + "\n");
        REQUIRE(edited.until([&] { return edited.session->problem() == nullptr && edited.session->idle(); }));
        CHECK(edited.middle() == before);
    }

    SUBCASE("only for one setting: the picture before it is drawn again")
    {
        edited.save(edited.withLine("if (tiling[0] > 8.0f) std::abort();"));
        const int version = edited.session->picture().version;
        REQUIRE(edited.awaitVersion(version + 1));
        Look look = edited.session->look();
        look.settings = {"tiling=9"};
        edited.session->look(look);
        REQUIRE(edited.awaitProblem());
        look.settings = {"tiling=1"};
        edited.session->look(look);
        REQUIRE(edited.until([&] { return edited.session->idle(); }));
        CHECK(edited.middle() == before);
    }
    SUBCASE("a stack without end, on a thread that has no room to tell")
    {
        std::string text = replaced(edited.text, "struct MyFragmentProgram :",
                                    "int deeper(volatile int* at)\n{\n    volatile int here[64] = {*at};\n"
                                    "    return deeper(here) + here[1];\n}\n\nstruct MyFragmentProgram :");
        edited.save(replaced(text, "        return float4(albedo",
                             "        volatile int at = 0;\n        if (deeper(&at) == 1) return 0.0f;\n"
                             "        return float4(albedo"));
        REQUIRE(edited.awaitProblem());
        CHECK(edited.session->problem()->diagnostics.front().line > 0);
        CHECK(edited.middle() == before);
    }
}

// The hash of each stage as tests/golden has it.
TEST_CASE("live: a stage that was reloaded has the hash of the one in the book")
{
    std::ifstream file(RELIEF_GOLDEN_FOLDER "/hashes.txt");
    std::string hash, id, stem;
    const bool all = std::getenv("RELIEF_FULL_TRIALS") != nullptr;
    int checked = 0;
    while (file >> hash >> id >> stem) {
        if (!all && id != "1.12" && id != "1.25") continue;
        CAPTURE(id);
        Edited edited({.width = 480, .height = 270, .camera = {}, .settings = {}, .files = {}, .hash = true}, id);
        REQUIRE(edited.awaitVersion(1));
        CHECK(hexadecimal(edited.session->picture().drawn.hash) == hash);
        edited.save(edited.text + "// again\n");
        REQUIRE(edited.awaitVersion(2));
        CHECK(hexadecimal(edited.session->picture().drawn.hash) == hash);
        ++checked;
    }
    CHECK(checked >= 2);
}

TEST_CASE("live: reloads take no memory")
{
    const auto kilobytes = [] {
        std::ifstream status("/proc/self/status");
        long size = 0;
        for (std::string row; std::getline(status, row);) {
            if (row.starts_with("VmRSS:")) size = std::atol(row.c_str() + 6);
        }
        return size;
    };
    Edited edited;
    REQUIRE(edited.awaitVersion(1));
    const int reloads = std::getenv("RELIEF_FULL_TRIALS") != nullptr ? 500 : 6;
    const long before = kilobytes();
    for (int i = 0; i < reloads; ++i) {
        edited.save(edited.text + "// " + std::to_string(i) + "\n");
        REQUIRE(edited.awaitVersion(i + 2));
    }
    const long grown = kilobytes() - before;
    MESSAGE(reloads, " reloads: ", grown, " KB more");
    CHECK(grown < (reloads > 100 ? 100 * 1024 : 10 * 1024));
}

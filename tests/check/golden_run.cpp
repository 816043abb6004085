// The workflow of a program's golden tests: names, unused goldens, --update, records.
#include "relief/check/golden_run.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "relief/check/tell_pixel.h"
#include "relief/mesh/primitives.h"
#include "relief/relief.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace relief;

// CI set to a value, or not set at all, until the test ends.
class EnvironmentCi
{
public:
    explicit EnvironmentCi(const char* value)
    {
        if (const char* const old = std::getenv("CI")) before = old;
        value != nullptr ? setenv("CI", value, 1) : unsetenv("CI");
    }
    ~EnvironmentCi() { before ? setenv("CI", before->c_str(), 1) : unsetenv("CI"); }
    EnvironmentCi(const EnvironmentCi&) = delete;
    EnvironmentCi& operator=(const EnvironmentCi&) = delete;

private:
    std::optional<std::string> before;
};

Framebuffer filled(std::uint32_t color)
{
    Framebuffer target = *Framebuffer::create(8, 6);
    for (std::uint32_t& pixel : target.color8()) pixel = color;
    return target;
}

GoldenRun runIn(const TemporaryFolder& folder, bool update = false)
{
    return GoldenRun({.goldens = folder / "goldens", .failures = folder / "failures", .update = update});
}

bool has(const Expected<void>& result, const std::string& words)
{
    if (result) return false;
    CAPTURE(result.error().message);
    CHECK(result.error().message.find(words) != std::string::npos);
    return true;
}

}  // namespace

TEST_CASE("golden run: names of tests become names of files")
{
    CHECK(goldenNameOf("shadows: soft edges / lamp") == "shadows__soft_edges_/_lamp");
    CHECK(goldenNameOf("Suite.Test/3") == "Suite.Test/3");
    CHECK(goldenNameOf("äα") == "äα");
    CHECK(goldenNameOf("../../etc/x") == "_./_./etc/x");
    CHECK(goldenNameOf("/root") == "_root");
    CHECK(goldenNameOf("a//b/") == "a/_b/_");
    CHECK(goldenNameOf(".hidden\n") == "_hidden_");
    CHECK(goldenNameOf("") == "_");
}

TEST_CASE("golden run: a missing golden fails and leaves a candidate, --update takes it and fails, then it passes")
{
    const TemporaryFolder folder;
    const Framebuffer target = filled(0xff102030u);
    CHECK(has(runIn(folder).check("äα", target), "this picture is a candidate"));
    CHECK(fs::exists(folder / "failures/äα.actual.png"));
    CHECK_FALSE(fs::exists(folder / "goldens"));
    GoldenRun update = runIn(folder, true);
    CHECK(has(update.check("äα", target), "updated: "));
    REQUIRE(update.updated().size() == 1);
    CHECK(update.updated()[0].ends_with("goldens/äα.png"));
    GoldenRun run = runIn(folder, true);
    CHECK(run.check("äα", target));
    CHECK(run.updated().empty());
    CHECK(run.end(true));
    CHECK_FALSE(fs::exists(folder / "failures/äα.actual.png"));  // of the run before
    const Expected<std::vector<GoldenRecord>> records = readRecords(folder / "failures");
    REQUIRE(records);
    REQUIRE(records->size() == 1);
    CHECK(records->front().outcome == GoldenRecord::Outcome::same);
}

TEST_CASE("golden run: --update leaves goldens alone that are met, and writes what is different")
{
    const TemporaryFolder folder;
    GoldenRun first = runIn(folder, true);
    CHECK_FALSE(first.check("a", filled(1)));
    CHECK_FALSE(first.check("b", filled(2)));
    const fs::file_time_type longAgo = fs::file_time_type::clock::now() - std::chrono::hours(100);
    fs::last_write_time(folder / "goldens/a.png", longAgo);
    GoldenRun second = runIn(folder, true);
    CHECK(second.check("a", filled(1)));
    CHECK(has(second.check("b", filled(3)), "48 pixels differ"));
    CHECK(second.updated().size() == 1);
    CHECK(fs::last_write_time(folder / "goldens/a.png") == longAgo);
    CHECK(runIn(folder).check("b", filled(3)));
}

TEST_CASE("golden run: a golden that no test uses fails a whole run, unless its test failed before")
{
    const TemporaryFolder folder;
    GoldenRun first = runIn(folder, true);
    for (const char* name : {"used", "forgotten", "crashed/part one", "crashed too"})
        CHECK_FALSE(first.check(name, filled(7)));
    GoldenRun part = runIn(folder);
    CHECK(part.check("used", filled(7)));
    CHECK(part.end(false));
    GoldenRun whole = runIn(folder);
    CHECK(whole.check("used", filled(7)));
    whole.failed("crashed");
    whole.failed("crashed too");
    const Expected<void> end = whole.end(true);
    CHECK(has(end, "forgotten.png: no test uses this golden"));
    CHECK(end.error().message.find("crashed") == std::string::npos);
    const Expected<std::vector<GoldenRecord>> records = readRecords(folder / "failures");
    REQUIRE(records);
    REQUIRE(records->size() == 4);
    CHECK((*records)[2].name == "forgotten");
    CHECK((*records)[2].outcome == GoldenRecord::Outcome::unused);
    fs::remove(folder / "goldens/forgotten.png");
    GoldenRun clean = runIn(folder);
    CHECK(clean.check("used", filled(7)));
    clean.failed("crashed");
    clean.failed("crashed too");
    CHECK(clean.end(true));
    CHECK_FALSE(fs::exists(folder / "failures/forgotten.json"));
}

TEST_CASE("golden run: one name for two pictures is an error, for the same picture twice it is not")
{
    const TemporaryFolder folder;
    CHECK_FALSE(runIn(folder, true).check("a b", filled(7)));
    GoldenRun run = runIn(folder);
    CHECK(run.check("a b", filled(7)));
    CHECK(run.check("a b", filled(7)));
    CHECK(has(run.check("a_b", filled(8)), "two different pictures"));
}

TEST_CASE("golden run: --update is a word of its own, and refused wherever CI is set")
{
    const auto taken = [](std::vector<std::string> words) {
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        int argc = static_cast<int>(words.size());
        const Expected<bool> update = takeUpdateFlag(argc, argv.data());
        CHECK(argv[static_cast<std::size_t>(argc)] == nullptr);
        return !update ? -argc : *update ? 10 + argc : argc;
    };
    {
        const EnvironmentCi none(nullptr);
        CHECK(taken({"tests"}) == 1);
        CHECK(taken({"tests", "--update", "-s"}) == 12);
        CHECK(taken({"tests", "--update=1", "-s", "update"}) == 4);
        CHECK(taken({"--update"}) == 1);  // the program's name
    }
    for (const char* value : {"true", "false", "0", ""}) {
        const EnvironmentCi set(value);
        CHECK(taken({"tests"}) == 1);
        CHECK(taken({"tests", "--update"}) == -1);
        CHECK(mayUpdate().error().message.find("CI") != std::string::npos);
    }
}

TEST_CASE("golden run: floats are held to all of their bits, alpha too, and halves")
{
    const TemporaryFolder folder;
    for (const Format format : {Format::rgba32f, Format::rgba16f}) {
        const std::string name = format == Format::rgba32f ? "floats" : "halves";
        Framebuffer target = *Framebuffer::create(5, 3, format);
        Frame frame(target);
        frame.clear({0.1f, -2.5f, 1000.0f, 1.0f});
        frame.run();
        CHECK_FALSE(runIn(folder, true).check(name, target));
        CHECK(runIn(folder).check(name, target));
        CHECK(fs::exists(folder / ("goldens/" + name + ".pfm")));
        CHECK_FALSE(fs::exists(folder / ("goldens/" + name + ".alpha.pfm")));
        target.words(0)[0] ^= 1u;
        CHECK(has(runIn(folder).check(name, target), "1 pixel differs"));
        target.words(0)[0] ^= 1u;

        frame.clear({0.1f, -2.5f, 1000.0f, 0.25f});
        frame.run();
        CHECK(has(runIn(folder).check(name, target), name + ".alpha: there is no golden"));
        CHECK_FALSE(runIn(folder, true).check(name, target));
        GoldenRun run = runIn(folder);
        CHECK(run.check(name, target));
        frame.clear({0.1f, -2.5f, 1000.0f, 1.0f});
        frame.run();
        CHECK(has(runIn(folder).check(name, target), name + ".alpha: 15 pixels differ"));
    }
    Framebuffer depth = *Framebuffer::create(4, 4, {{Format::depth32f, Store::keep}});
    CHECK_FALSE(runIn(folder, true).check("depth", depth));
    CHECK(runIn(folder).check("depth", depth));
    depth.depth()[5] = 0.5f;
    CHECK(has(runIn(folder).check("depth", depth), "(1, 1)  is 0.5 0.5 0.5   1"));
    depth.depth()[5] = std::numeric_limits<float>::quiet_NaN();
    CHECK(has(runIn(folder, true).check("depth", depth), "NaN"));
    CHECK_FALSE(runIn(folder).check("depth", depth));
}

TEST_CASE("golden run: 16 bits are refused, and a run without a folder of goldens")
{
    const TemporaryFolder folder;
    const Image16 picture{1, 1, {1, 2, 3, 4}};
    CHECK(has(runIn(folder, true).check("sixteen", ImageFile(picture)), "16 bits"));
    CHECK(has(GoldenRun(GoldenOptions{}).check("a", filled(1)), "GoldenOptions::goldens"));
}

TEST_CASE("golden run: a failure names both pictures, ten pixels, and how the first one came about")
{
    struct VertexData
    {
        POSITION position;
    };
    struct Interpolators
    {
        SV_POSITION position;
    };
    struct Flat
    {
        Interpolators operator()(VertexData v) const { return {v.position}; }
    };
    struct Constant
    {
        float4 color;
        float4 operator()(Interpolators) const { return color; }
    };
    const TemporaryFolder folder;
    Mesh triangle;
    triangle.name = "corner";
    triangle.positions = {{-1, -1, 0.5f}, {-1, 1, 0.5f}, {1, 1, 0.5f}};
    triangle.indices = {0, 1, 2};
    Framebuffer target = *Framebuffer::create(16, 16, Format::rgba8);
    const auto draw = [&](Frame& frame, float red) {
        frame.clear({0, 0, 0, 1});
        frame.draw(triangle, Flat{}, Constant{float4(red, 0.25f, 0.0f, 1.0f)});
        frame.run();
    };
    Frame first(target), second(target);
    draw(first, 0.5f);
    CHECK_FALSE(runIn(folder, true).check("triangle", target));
    draw(second, 0.75f);
    const Expected<void> result =
        runIn(folder).check("triangle", target, {}, [&](int x, int y) { return tellPixel(second, x, y); });
    CHECK(has(result, "triangle: 120 pixels differ"));
    CHECK(has(result, "goldens/triangle.png"));
    CHECK(has(result, "failures/triangle.actual.png"));
    CHECK(has(result, "failures/triangle.difference.png"));
    CHECK(has(result, "  (0, 0)  is 191  64   0 255  should be 128  64   0 255"));
    CHECK(
        has(result,
            "pixel (0, 0), 1 triangle:\n  draw 0 (corner), triangle 0: is drawn, its program gave (0.75, 0.25, 0, 1)"));
    CHECK(tellPixel(second, 15, 15) == "pixel (15, 15): no triangle covers it");
    std::size_t pixels = 0;
    for (std::size_t at = result.error().message.find("  is "); at != std::string::npos;
         at = result.error().message.find("  is ", at + 1))
        ++pixels;
    CHECK(pixels == 10);

    const Expected<std::vector<GoldenRecord>> records = readRecords(folder / "failures");
    REQUIRE(records);
    const GoldenRecord& record = records->front();
    CHECK(record.differing == 120);
    CHECK(record.largest == 63);
    CHECK(record.actual == (folder / "failures/triangle.actual.png").string());
    CHECK(record.message == result.error().message);
}

TEST_CASE("golden run: what is no record is said to be none")
{
    const TemporaryFolder folder;
    folder.write("a.json", "{\"name\":3,\"outcome\":\"fine\"}");
    CHECK(readRecords(folder.path).error().message.find("a.json: is no record") != std::string::npos);
    folder.write("a.json", "[]");
    CHECK_FALSE(readRecords(folder.path));
    folder.write("a.json", "{");
    CHECK_FALSE(readRecords(folder.path));
    CHECK_FALSE(readRecords(folder / "nowhere"));
}

// Traces of pixels: that they end at the picture's pixel, in every stage, and what they say.
//
// RELIEF_FULL_TRIALS=1: all stages, 150 pixels each.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "common/pattern.h"
#include "common/render.h"
#include "live/load.h"
#include "relief/check/hash.h"
#include "relief/trace/pixel_trace.h"
#include "relief/trace/variable.h"
#include "trace/instrument.h"

#include "live_command.h"
#include "relief/file.h"

using namespace relief;
using namespace relief::samples;

namespace {

struct Picture
{
    Framebuffer target;
    Frame frame;
    PreparedStage stage;

    Picture(const Stage& its, int width, int height, int samples, FrameOptions how = {.threads = 2})
        : target(*Framebuffer::create(width, height, Format::rgba8Srgb, Store::discard, samples)),
          frame(target, how),
          stage(*PreparedStage::prepare(its))
    {
        stage.record(frame, width, height);
    }
};

const Stage* tracedStage(const std::string& name)
{
    const live::StageSource source = *live::findSource(name);
    Expected<live::StageCompile> compile =
        live::StageCompile::start(source, samples::trace::instrumented(*readText(source.path), source.stem), true);
    REQUIRE_MESSAGE(compile.has_value(), compile.error().message);
    const Expected<const Stage*> stage = compile->finish();
    REQUIRE_MESSAGE(stage.has_value(), stage.error().message);
    return *stage;
}

std::uint64_t hashOfStage(const Stage& its)
{
    Framebuffer target = *Framebuffer::create(480, 270, Format::rgba32f, Store::keep);
    Frame frame(target);
    const PreparedStage stage = *PreparedStage::prepare(its);
    stage.record(frame, 480, 270);
    frame.run();
    return hashOf(target);
}

}  // namespace

TEST_CASE("trace: an instrumented stage has the book's hash, and a trace ends at the picture's pixel")
{
    std::ifstream file(RELIEF_GOLDEN_FOLDER "/hashes.txt");
    std::string hash, id, stem;
    const bool all = std::getenv("RELIEF_FULL_TRIALS") != nullptr;
    std::mt19937 random(1);
    int stages = 0, pixels = 0, covered = 0, told = 0, textures = 0;
    while (file >> hash >> id >> stem) {
        const bool isChosen =
            id == "0.03" || id == "1.25" || id == "4.05" || id == "5.14" || id == "5.18" || id == "5.20";
        if (!all && !isChosen) continue;
        CAPTURE(id);
        ++stages;
        const Stage& stage = *tracedStage(id);
        CHECK(hexadecimal(hashOfStage(stage)) == hash);
        for (const int samples : {1, 4}) {
            Picture picture(stage, 320, 180, samples), followed(stage, 320, 180, samples);
            picture.frame.run();
            for (int i = 0; i < (all ? 75 : 40); ++i) {
                const int x = static_cast<int>(random() % 320), y = static_cast<int>(random() % 180);
                CAPTURE(x);
                CAPTURE(y);
                const Expected<relief::trace::PixelTrace> trace = relief::trace::tracePixel(followed.frame, x, y);
                REQUIRE_MESSAGE(trace.has_value(), trace.error().message);
                const std::uint32_t pixel = picture.target.color8()[static_cast<std::size_t>(y * 320 + x)];
                REQUIRE(trace->storedWords.at(0) == pixel);
                ++pixels;
                for (const auto& draw : trace->draws) {
                    for (const auto& primitive : draw.primitives) {
                        for (const auto& piece : primitive.pieces) {
                            covered += piece.fragment.has_value();
                            told += piece.fragment && !piece.fragment->events.empty();
                            if (piece.fragment) textures += static_cast<int>(piece.fragment->textures.size());
                        }
                    }
                }
            }
        }
    }
    MESSAGE(stages, " stages, ", pixels, " pixels, ", covered, " triangles over them, ", told, " programs told, ",
            textures, " texture samples put together again");
    CHECK(stages >= 5);
    CHECK(told > pixels / 3);
    CHECK(textures > pixels / 2);
}

TEST_CASE("trace: a line's value over the picture is what the traces of its pixels say")
{
    const Stage& stage = *tracedStage("1.25");
    Picture followed(stage, 96, 54, 1);
    std::mt19937 random(7);
    const auto check = [&](const std::string& view, int line, const std::string& name) {
        CAPTURE(view);
        Picture picture(stage, 96, 54, 1);
        const Expected<Inspection> seen = relief::trace::inspectVariable(picture.frame, view);
        REQUIRE_MESSAGE(seen.has_value(), seen.error().message);
        int compared = 0;
        for (int i = 0; i < 40; ++i) {
            const int x = static_cast<int>(random() % 96), y = static_cast<int>(random() % 54);
            const auto pixel = static_cast<std::size_t>(y * 96 + x);
            const auto trace = relief::trace::tracePixel(followed.frame, x, y);
            REQUIRE(trace.has_value());
            const relief::trace::QuadValue* last = nullptr;
            for (const auto& draw : trace->draws) {
                for (const auto& primitive : draw.primitives) {
                    for (const auto& piece : primitive.pieces) {
                        // A quad's program also runs for those of its pixels that are not drawn.
                        using Verdict = relief::trace::SampleOutcome::Verdict;
                        if (!piece.fragment || piece.fragment->samples[0].verdict != Verdict::drawn) continue;
                        for (const auto& event : piece.fragment->events) {
                            if (event.site.line == line && event.site.name + event.field == name) last = &event.value;
                        }
                    }
                }
            }
            CHECK((last != nullptr) == (seen->drawn[pixel] != 0));
            if (last == nullptr) continue;
            for (int c = 0; c < last->rows; ++c)
                CHECK(seen->values[pixel][c] == last->number((y & 1) * 2 + (x & 1), c));
            ++compared;
        }
        CHECK(compared > 10);
    };
    check("albedo@82", 82, "albedo");
    check("i.uv@77", 77, "i.uv");

    Picture picture(stage, 96, 54, 1);
    const auto shown = [&](const std::string& view) { return *relief::trace::inspectVariable(picture.frame, view); };
    CHECK(shown("i.normal@73:length").lowest == doctest::Approx(1.0f).epsilon(1e-5));
    CHECK(shown("i.normal@73:length").highest == doctest::Approx(1.0f).epsilon(1e-5));
    CHECK(shown("i.normal@73:unit").lowest == -1.0f);
    CHECK(shown("viewDir@79:sign").showAs == ShowAs::scale);
    CHECK(shown("viewDir@79:z").highest < 0.0f);
    const auto refusal = [&](const std::string& view) {
        return relief::trace::inspectVariable(picture.frame, view).error().message;
    };
    CHECK(refusal("albedo@83").find("albedo@81, albedo@82") != std::string::npos);
    CHECK(refusal("albedo@x").find("write NAME@LINE") != std::string::npos);
    CHECK(refusal("albedo@82:no").find(":length") != std::string::npos);
    CHECK_FALSE(relief::trace::firstNotFinite(picture.frame).has_value());
}

// --- what the instrumenter understands ---

TEST_CASE("trace: what a statement gives a value is told, and nothing else")
{
    // In the body of a function; the names that are told, in order.
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"const float3 n = normalize(v);", "n"},
        {"float2 dx = ddx(uv), dy = ddy(uv);", "dx dy"},
        {"float3 a(1.0f), b{2.0f};", "a b"},
        {"float3 color;", ""},
        {"i.normal = f(a, b = 2);", "i.normal"},
        {"a[2].x += 1.0f;", "a[2].x"},
        {"*p = 1.0f;", ""},
        {"++count; --i.left; k++;", "count i.left k"},
        {"Triplanar<float2> uv = f<float3, 2>(x);", "uv"},
        {"const Triplanar<float3> bumps = {g(a < b, c > d), h(x)};", "bumps"},
        {"const auto& [x, y] = f();", "x y"},
        {"f(a, b); g<int>(c);", ""},
        {"if (a == b) x = 1; else y = 2;", "x y"},
        {"for (int k = 0; k < 3; ++k) sum += k;", "sum"},
        {"while (a <= b) { a *= 2.0f; }", "a"},
        {"static const float table[] = {1, 2};", ""},
        {"constexpr float pi = 3.0f;", ""},
        {"using V = float3; struct Local { int a = 1; };", ""},
        {"whileAny(m, [&] { h = select(m, h - s, h); });", "h"},
        {"const auto at = [&](const float2& uv) { Float z = 1.0f; return z; };", "z at"},
        {"switch (k) { case 1: x = 1; break; default: y = 2; }", "x y"},
        {"x = s ? \"a = b;\"[0] : '='; // y = 3;", "x"},
        {"/* a = 1; */ b = 2;", "b"},
    };
    const Pattern seen(R"re(see\(::relief::trace::Site\{"f",(\d+),"F","([^"]*)"\})re");
    for (const auto& [given, names] : cases) {
        const std::string statement = given;
        CAPTURE(statement);
        const std::string text = samples::trace::instrumented("void F()\n{\n" + statement + "\n}\n", "f");
        CAPTURE(text);
        std::string found;
        for (const Match& m : seen.find(text)) {
            found += (found.empty() ? "" : " ") + m[2];
            CHECK(m[1] == "3");
        }
        CHECK(found == names);
        CHECK(std::count(text.begin(), text.end(), '\n') == 4);
    }
}

TEST_CASE("trace: structs, parameters, textures and returned values in an instrumented source")
{
    const std::string source =
        "struct Light { float3 color, dir; Float power = 1.0f; static int count; float f() const; };\n"
        "struct P {\n"
        "    float4 operator()(Interpolators i, const float3& n, Float& out) const { return tex2D(map, i.uv) * 2; }\n"
        "    constexpr float c() const { float x = 1; return x; }\n"
        "};\n";
    const std::string text = samples::trace::instrumented(source, "f");
    const auto has = [&](const char* part) { return text.find(part) != std::string::npos; };
    CHECK(has("fields(\"color\", its.color); fields(\"dir\", its.dir); fields(\"power\", its.power); }"));
    CHECK(has("Call relief_call(::relief::trace::Site{\"f\",3,\"P\",\"P\"});"));
    CHECK(has("{\"f\",3,\"P\",\"i\"},i);"));
    CHECK(has("{\"f\",3,\"P\",\"n\"},n);"));
    CHECK_FALSE(has("\"out\""));
    CHECK(has("::relief::trace::tex2D(::relief::trace::Site{\"f\",3,\"P\",\"tex2D\"}, map, i.uv)"));
    CHECK(has("return ::relief::trace::returned("));
    CHECK(has("constexpr float c() const { float x = 1; return x; }"));
    CHECK_FALSE(has("const P& its"));
}

// --- the command ---

TEST_CASE("trace: the page of the book says what the command prints")
{
    const TemporaryFolder folder;
    const Outcome outcome = runCommand(folder, "trace 1.25 --pixel 480,300");
    REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
    std::ifstream page(std::filesystem::path(RELIEF_GOLDEN_FOLDER).parent_path().parent_path() / "docs" /
                       "life_of_a_pixel.md");
    int quoted = 0;
    bool isTrace = false;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```")) {
            isTrace = line == "```trace";
        } else if (isTrace) {
            ++quoted;
            CHECK_MESSAGE(outcome.out.find(line + "\n") != std::string::npos, line);
        }
    }
    CHECK(quoted > 25);
    CHECK(outcome.out.find("  stored: #bb9975, alpha ff (rgba8 sRGB)\n") != std::string::npos);
    CHECK(runCommand(folder, "trace 1.25 --pixel 480,300 --threads 1 --tile 16").out.substr(0, 40) ==
          outcome.out.substr(0, 40));
}

TEST_CASE("trace: JSON, a page, and a shader of one's own")
{
    const TemporaryFolder folder;
    REQUIRE(runCommand(folder, "new my_shader.cpp").code == 0);
    const std::string what = "trace my_shader.cpp --pixel 31,17 --size 64x36 --samples 4";
    const Outcome json = runCommand(folder, what + " --json");
    REQUIRE_MESSAGE(json.code == 0, json.err);
    const nlohmann::json all = nlohmann::json::parse(json.out);
    CHECK(all["pixel"] == nlohmann::json::array({31, 17}));
    CHECK(all["samples"] == 4);
    REQUIRE(runCommand(folder, "render my_shader.cpp --size 64x36 --samples 4 -o picture.png").code == 0);
    const ImageFile file = *readImage((folder / "picture.png").string());
    const auto& picture = std::get<ImageOf<std::uint8_t>>(file);
    for (std::size_t c = 0; c < 4; ++c) CHECK(all["stored"][c] == picture.pixels[(17 * 64 + 31) * 4 + c]);

    const Outcome page = runCommand(folder, what + " --html pixel.html");
    REQUIRE_MESSAGE(page.code == 0, page.err);
    const std::string html = contents(folder / "pixel.html");
    CHECK(html.find("data:image/png;base64,") != std::string::npos);
    CHECK(html.find("http") == std::string::npos);
    CHECK(html.find("my_shader") != std::string::npos);
    CHECK(runCommand(folder, what + " --against my_shader.cpp").out == "the traces are the same\n");
    CHECK(runCommand(folder, what + " --against 1.09").out.find("My shader") != std::string::npos);
}

TEST_CASE("trace: the first value that differs in another stage, and since the last commit")
{
    const TemporaryFolder folder;
    CHECK(runCommand(folder, "trace 4.04 --pixel 215,125 --size 480x270 --against 4.05").out.find("\nWorldNormal\n") !=
          std::string::npos);
    REQUIRE(runCommand(folder, "new my_shader.cpp").code == 0);
    const std::string git = "git -C '" + folder.path.string() + "' -c user.name=Test -c user.email=test@localhost ";
    const std::string what = "trace my_shader.cpp --pixel 31,17 --size 64x36 --against committed";
    CHECK(runCommand(folder, what).code == 2);
    REQUIRE(std::system((git + "init -q && " + git + "add . && " + git + "commit -q -m one").c_str()) == 0);
    CHECK(runCommand(folder, what).out == "the traces are the same\n");

    std::string text = contents(folder / "my_shader.cpp");
    const std::string before = "const Float lambert = ";
    REQUIRE(text.find(before) != std::string::npos);
    const auto lineNumber = 1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(before)), '\n');
    text.insert(text.find(before) + before.size(), "2.0f * ");
    std::ofstream(folder / "my_shader.cpp") << "// a line that changes no value\n" << text;
    const Outcome changed = runCommand(folder, what);
    CHECK(changed.out.find(" " + std::to_string(lineNumber + 1) + "  lambert: ") != std::string::npos);
    CHECK(changed.out.find("committed: " + std::to_string(lineNumber) + "  lambert: ") != std::string::npos);
}

TEST_CASE("trace: pixels from standard input, each answered by a line")
{
    const TemporaryFolder folder;
    std::ofstream(folder / "pixels.txt") << "20,10\n21,10\n64,0\nhere\n20,10\n";
    const Outcome all = runCommand(folder, "trace 1.12 --size 64x36 --pixel -", "relief_view", "pixels.txt");
    REQUIRE_MESSAGE(all.code == 0, all.err);
    std::istringstream lines(all.out);
    std::vector<nlohmann::json> answers;
    for (std::string line; std::getline(lines, line);) answers.push_back(nlohmann::json::parse(line));
    REQUIRE(answers.size() == 5);
    for (const int x : {20, 21}) {
        const Outcome one = runCommand(folder, "trace 1.12 --size 64x36 --json --pixel " + std::to_string(x) + ",10");
        const nlohmann::json alone = nlohmann::json::parse(one.out);
        nlohmann::json& answer = answers[static_cast<std::size_t>(x - 20)];
        CHECK(answer["stored"] == alone["stored"]);
        CHECK(answer["draws"] == alone["draws"]);
    }
    CHECK(answers[2]["error"].get<std::string>().find("there is no pixel 64,0") != std::string::npos);
    CHECK(answers[3]["error"].get<std::string>().find("write X,Y") != std::string::npos);
    CHECK(answers[4]["draws"] == answers[0]["draws"]);
}

TEST_CASE("trace: where a NaN comes from, and a vertex")
{
    const TemporaryFolder folder;
    REQUIRE(runCommand(folder, "new my_shader.cpp").code == 0);
    CHECK(runCommand(folder, "trace my_shader.cpp --first-nan --size 64x36").out ==
          "every value of every line is finite, in all pixels of 64x36\n");

    std::string text = contents(folder / "my_shader.cpp");
    const std::string before = "        const Float lambert";
    const std::size_t at = text.find(before);
    REQUIRE(at != std::string::npos);
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
    text.insert(at, "        const Float root = sqrt(i.uv.x - 0.5f);\n");
    std::ofstream(folder / "my_shader.cpp") << text;
    const Outcome nan = runCommand(folder, "trace my_shader.cpp --first-nan --size 64x36");
    REQUIRE_MESSAGE(nan.code == 0, nan.err);
    CHECK(nan.out.find("my_shader.cpp:" + std::to_string(line) + ": root is NaN") != std::string::npos);
    const std::string pixel = nan.out.substr(6, nan.out.find(',', nan.out.find(',') + 1) - 6);
    const Outcome told = runCommand(folder, "trace my_shader.cpp --size 64x36 --pixel " + pixel);
    CHECK(told.out.find("root: NaN   <- not finite") != std::string::npos);

    const Outcome vertex = runCommand(folder, "trace my_shader.cpp --vertex 7");
    CHECK(vertex.out.find("vertex 7 of draw 0") != std::string::npos);
    CHECK(vertex.out.find("| i.uv = v.uv;") != std::string::npos);
    CHECK(vertex.out.find("SV_POSITION: ") != std::string::npos);
    CHECK(
        runCommand(folder, "render my_shader.cpp --show lambert@" + std::to_string(line + 1) + " --size 64x36").code ==
        0);
}

TEST_CASE("trace: bad input is one line and exit code 2")
{
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& arguments, const std::string& words) {
        CAPTURE(arguments);
        const Outcome outcome = runCommand(folder, "trace " + arguments);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        CHECK_MESSAGE(outcome.err.find(words) != std::string::npos, outcome.err);
    };
    refused("1.09 --pixel 5", "--pixel 5: write X,Y");
    refused("1.09 --pixel 5,x", "--pixel 5,x: write X,Y");
    refused("1.09 --pixel 64,0 --size 64x36", "there is no pixel 64,0; the picture is 64x36");
    refused("1.09 --pixel -1,0 --size 64x36", "there is no pixel -1,0");
    refused("9.99 --pixel 1,1", "9.99");
    refused("1.09 --pixel 1,1 --size 0x5", "--size 0x5");
    refused("1.09 --pixel 1,1 --set no=1 --size 64x36", "no property 'no'");
    refused("1.09 --vertex 4000000", "draw 0 has the vertices 0 to 3, and not 4000000");
    refused("1.09 --vertex 0 --draw 9", "there is no draw 9 among 1");
    refused("1.09 --vertex 0 --first-nan", "--help");
    refused("1.09", "--help");
    refused("1.09 --pixel 1,1 --size 64x36 --html missing/folder/page.html", "missing/folder");
}

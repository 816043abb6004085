// The program as a user meets it: what it prints, and that bad input gives one line on stderr, exit code 2 and no file.
// What takes minutes to build or to run is in long/.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "common/stage.h"
#include "gltf_file.h"
#include "relief/texture/cube_map.h"
#include "relief/texture/image.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}

// A PNG's first bytes: signature and header chunk with this size (and a checksum that no reader gets to).
std::string pngHeader(std::uint32_t width, std::uint32_t height)
{
    std::string bytes = "\x89PNG\r\n\x1a\n";
    const auto big = [&bytes](std::uint32_t n) {
        for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(n >> shift & 255));
    };
    big(13);
    bytes += "IHDR";
    big(width);
    big(height);
    bytes += std::string("\x08\x06\x00\x00\x00", 5);
    big(0);
    return bytes;
}

}  // namespace

TEST_CASE("command line: help at every level, and the list of stages")
{
    const TemporaryFolder folder;
    CHECK(run(folder, "").out.find("gallery") != std::string::npos);
    CHECK(run(folder, "--help").code == 0);
    for (const std::string command :
         {"list", "render", "gallery", "view", "hash", "explain", "bench", "report", "import-environment", "check"}) {
        const Outcome help = run(folder, command + " --help");
        CAPTURE(command);
        CHECK(help.code == 0);
        CHECK(help.out.find("Usage") != std::string::npos);
    }
    // The program with the pictures knows the other commands too, and how to get at them.
    const std::string wrongProgram =
        "cd '" + folder.path.string() + "' && '" RELIEF_PROGRAMS "/relief' bench 2>err.txt";
    CHECK(WEXITSTATUS(std::system(wrongProgram.c_str())) == 2);
    CHECK(contents(folder.path / "err.txt").find("`./relief bench` builds and runs the one") != std::string::npos);
    const nlohmann::json list = nlohmann::json::parse(run(folder, "list --json").out);
    REQUIRE(list.size() == relief::samples::allStages().size());
    for (const auto& stage : list) {
        for (const char* key : {"id", "stem", "title", "tutorial", "section", "properties"}) CHECK(stage.contains(key));
        for (const auto& property : stage["properties"]) {
            const bool isChoice = property["kind"] == "choice";
            CHECK(property.contains("choices") == isChoice);
        }
    }
}

TEST_CASE("command line: render writes the picture of the size asked for")
{
    const TemporaryFolder folder;
    CHECK(run(folder, "render 1.9 --size 123x45 -o p.png --set bumpScale=2 --set tint=1,0.5,0.5 --threads 2").code ==
          0);
    const auto image = relief::readImage(folder.path / "p.png");
    REQUIRE(image);
    CHECK(std::get<relief::Image8>(*image).width == 123);
    CHECK(std::get<relief::Image8>(*image).height == 45);
    CHECK(run(folder, "render rotated_tangent --size 16x16").code == 0);
    CHECK(fs::exists(folder.path / "06_rotated_tangent.png"));
}

TEST_CASE("command line: render --scene draws a glTF file, and refuses bad ones and options of stages")
{
    const TemporaryFolder folder;
    GltfFile file = GltfFile::square();
    folder.write("a.glb", file.glb());
    folder.write("a.bin", file.bytes);
    folder.write("b.gltf", file.gltf("a.bin"));
    file.primitive()["mode"] = 1;
    folder.write("lines.glb", file.glb());
    folder.write("cut.glb", GltfFile::square().glb().substr(0, 500));
    const Outcome drawn = run(folder, "render --scene a.glb --size 64x36 --samples 4");
    CHECK(drawn.code == 0);
    CHECK(drawn.out == "a.png\n");
    CHECK(run(folder, "render --scene b.gltf --size 64x36 --samples 4 --threads 3 -o b.png").code == 0);
    const auto a = relief::readImage((folder / "a.png").string()), b = relief::readImage((folder / "b.png").string());
    REQUIRE((a && b));
    const auto& pixels = std::get<relief::Image8>(*a).pixels;
    CHECK(pixels == std::get<relief::Image8>(*b).pixels);
    CHECK(pixels[0] != pixels[(18 * 64 + 32) * 4]);
    CHECK(run(folder, "render --scene a.glb --size 64x36 --camera 0,0,9 -o c.png").code == 0);
    CHECK(contents(folder / "c.png") != contents(folder / "a.png"));
    checkRefused(folder, "render --scene lines.glb", {"lines.glb: ", "no triangles"});
    checkRefused(folder, "render --scene cut.glb", {"cut.glb: is truncated"});
    checkRefused(folder, "render --scene none.glb", {"none.glb"});
    checkRefused(folder, "render --scene a.glb --set bumpScale=1", {"--set: render --scene does not take it"});
    checkRefused(folder, "render --scene a.glb --watch", {"--watch"});
    checkRefused(folder, "render 1.06 --scene a.glb", {"render: name a stage, or a scene"});
    checkRefused(folder, "render --scene a.glb --size 0x0", {"--size"});
    checkRefused(folder, "render --scene a.glb --camera 1", {"--camera"});
}

TEST_CASE("command line: render --show draws a view, lists those of the stage, and refuses others")
{
    const TemporaryFolder folder;
    const Outcome list = run(folder, "render 1.12 --show list");
    CHECK(list.code == 0);
    CHECK(list.out.find("TEXCOORD1  float3, from NORMAL\n") != std::string::npos);
    CHECK(fs::is_empty(folder.path));
    checkRefused(folder, "render 1.12 --show depht", {"--show depht", "depth, normal, uv, TEXCOORD0"});
    CHECK(run(folder, "render 1.12 --size 64x36 -o plain.png").code == 0);
    CHECK(run(folder, "render 1.12 --size 64x36 -o color.png --show color").code == 0);
    CHECK(run(folder, "render 1.12 --size 64x36 -o depth.png --show depth").code == 0);
    CHECK(contents(folder.path / "plain.png") == contents(folder.path / "color.png"));
    CHECK(contents(folder.path / "plain.png") != contents(folder.path / "depth.png"));
}

TEST_CASE("command line: unknown stage, property, value and option")
{
    const TemporaryFolder folder;
    checkRefused(folder, "render 9.99", {"9.99", "relief list"});
    checkRefused(folder, "render rotated", {"did you mean 1.06"});
    checkRefused(folder, "render 1.06 --set bumpyness=1", {"bumpyness", "bumpScale"});
    checkRefused(folder, "render 1.06 --set bumpScale", {"name=value"});
    checkRefused(folder, "render 1.06 --set bumpScale=high", {"high", "not a number"});
    checkRefused(folder, "render 1.06 --set bumpScale=nan", {"not a number"});
    checkRefused(folder, "render 1.06 --set bumpScale=1,2", {"not a number"});
    checkRefused(folder, "render 1.06 --set bumpScale=99", {"99", "-32 to 32"});
    checkRefused(folder, "render 1.06 --set tint=1,2,x", {"tint"});
    checkRefused(folder, "render 1.06 --colour red", {"--colour"});
    checkRefused(folder, "render", {"stage"});
    checkRefused(folder, "paint 1.06", {"paint"});
    checkRefused(folder, "report", {"name"});
    checkRefused(folder, "report speed", {"speed", "there is triplanar"});
    checkRefused(folder, "render 1.06 --threads -1", {"threads"});
}

TEST_CASE("command line: sizes")
{
    const TemporaryFolder folder;
    for (const std::string size :
         {"0x0", "1000000x1000000", "10", "10x", "x10", "-5x10", "10x10x10", "axb", "99999999999x1"}) {
        checkRefused(folder, "render 1.06 --size " + size, {size, "WIDTHxHEIGHT"});
    }
    checkRefused(folder, "hash 1.06 --size 0x0", {"0x0"});
    checkRefused(folder, "explain 1.06 --size 0x0", {"0x0"});
}

TEST_CASE("command line: pictures that are none")
{
    const TemporaryFolder folder;
    write(folder.path / "empty.png", "");
    write(folder.path / "text.png", "this is no picture\n");
    write(folder.path / "huge.png", pngHeader(60000, 60000));
    const std::string whole = contents(fs::path(RELIEF_SOURCE_FOLDER) / "assets/marble-heights.png");
    write(folder.path / "truncated.png", whole.substr(0, whole.size() / 2));
    checkRefused(folder, "render 1.09 --height empty.png", {"empty.png"});
    checkRefused(folder, "render 1.09 --height text.png", {"text.png"});
    checkRefused(folder, "render 1.09 --height huge.png", {"huge.png", "60000x60000"});
    checkRefused(folder, "render 1.09 --height truncated.png", {"truncated.png"});
    checkRefused(folder, "render 1.09 --height missing.png", {"missing.png"});
    checkRefused(folder, "render 1.09 --height .", {"."});
    checkRefused(folder, "render 1.01 --height text.png", {"reads no height"});
    checkRefused(folder, "render 0.01 --mesh x.obj", {"x.obj"});
}

TEST_CASE("command line: meshes that are none")
{
    const TemporaryFolder folder;
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    write(folder.path / "range.obj", corners + "f 1 2 4\n");
    write(folder.path / "relative.obj", corners + "f -1 -2 -4\n");
    write(folder.path / "zero.obj", corners + "f 0 1 2\n");
    write(folder.path / "nofaces.obj", corners);
    write(folder.path / "nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write(folder.path / "empty.obj", "");
    for (const std::string name : {"range", "relative", "zero", "nofaces", "nan", "empty", "missing"}) {
        checkRefused(folder, "render 1.01 --mesh " + name + ".obj", {name + ".obj"});
    }
}

TEST_CASE("command line: a mesh of any size is drawn as large as the samples' own")
{
    const TemporaryFolder folder;
    const auto hashOf = [&folder](const std::string& size) {
        std::string cube;
        for (int i = 0; i < 8; ++i) {
            cube += "v";
            for (const int bit : {1, 2, 4}) cube += ((i & bit) != 0 ? " " : " -") + size;
            cube += "\n";
        }
        cube += "f 3 4 2 1\nf 5 6 8 7\nf 1 2 6 5\nf 4 3 7 8\nf 2 4 8 6\nf 3 1 5 7\n";
        write(folder.path / "cube.obj", cube);
        return run(folder, "hash 1.21 --size 64x36 --mesh cube.obj").out;
    };
    const std::string usual = hashOf("1");
    CHECK(usual.size() > 16);
    for (const std::string size : {"1e20", "1e-25", "1e-37"}) CHECK(hashOf(size) == usual);
    CHECK(hashOf("2.5e38").size() > 16);
}

TEST_CASE("command line: folders that cannot be written to")
{
    const TemporaryFolder folder;
    checkRefused(folder, "render 1.01 --size 8x8 -o nowhere/p.png", {"nowhere"});
    if (geteuid() == 0) {
        MESSAGE("runs as root, for whom no folder is read-only: /proc stands in");
        checkRefused(folder, "render 1.01 --size 8x8 -o /proc/p.png", {"/proc"});
        checkRefused(folder, "gallery --out /proc/gallery", {"/proc/gallery"});
        return;
    }
    fs::create_directory(folder.path / "locked");
    fs::permissions(folder.path / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    checkRefused(folder, "render 1.01 --size 8x8 -o locked/p.png", {"locked"});
    checkRefused(folder, "gallery --out locked/gallery", {"locked"});
    fs::permissions(folder.path / "locked", fs::perms::owner_all);
}

TEST_CASE("command line: a missing asset is named with the path that was tried")
{
    const TemporaryFolder folder;
    checkRefused(folder, "render 1.09", {"/no/such/folder/marble-heights.png"}, "RELIEF_ASSETS=/no/such/folder");
}

TEST_CASE("command line: real files of Debian's glmark2-data")
{
    const fs::path data = "/usr/share/glmark2";
    if (!fs::exists(data)) {
        MESSAGE("glmark2-data is not installed: skipped");
        return;
    }
    const TemporaryFolder folder;
    CHECK(run(folder, "render 1.09 --size 64x36 -o a.png --height /usr/share/glmark2/textures/asteroid-height-map.png")
              .code == 0);
    CHECK(run(folder, "render 1.01 --size 64x36 -o b.png --mesh /usr/share/glmark2/models/bunny.obj").code == 0);
    CHECK(fs::file_size(folder.path / "a.png") > 1000);
    CHECK(fs::file_size(folder.path / "b.png") > 1000);
    for (const std::string normal : {"asteroid-normal-map-tangent.png", "terrain-grasslight-512-nm.jpg"}) {
        const std::string files = " --size 64x36 --albedo none --detail none --detail-normal none --normal " +
                                  (data / "textures" / normal).string();
        const std::string onSphere = run(folder, "hash 1.21" + files).out;
        const std::string onBunny = run(folder, "hash 1.21 --mesh " + (data / "models/bunny.obj").string() + files).out;
        CHECK(onSphere.size() > 16);
        CHECK(onBunny.size() > 16);
        CHECK(run(folder, "hash 1.21" + files + " --set bumpScale=0").out != onSphere);
    }
}

TEST_CASE("command line: explain counts, hash does not depend on threads or tiles")
{
    const TemporaryFolder folder;
    const nlohmann::json counts = nlohmann::json::parse(run(folder, "explain 1.01 --json --size 96x54").out)["counts"];
    CHECK(counts["triangles submitted"] == 2);
    CHECK(counts["rasterised"] == 2);
    CHECK(counts["pixels shaded"].get<int>() > 500);
    CHECK(counts["components used"].get<int>() > 0);
    CHECK(counts["no derivatives taken"].get<int>() > 0);  // nothing but constant textures
    CHECK(counts["no derivatives taken"] == counts["texture fetches, trilinear"]);
    const std::string one = run(folder, "hash 1.09 --size 96x54 --threads 1 --tile 32").out;
    CHECK(one.size() > 16);
    CHECK(run(folder, "hash 1.09 --size 96x54 --threads 3 --tile 128").out == one);

    const std::string four = run(folder, "hash 1.22 --size 96x54 --samples 4 --threads 1 --tile 16").out;
    CHECK(four != run(folder, "hash 1.22 --size 96x54").out);
    CHECK(run(folder, "hash 1.22 --size 96x54 --samples 4 --threads 3").out == four);
    checkRefused(folder, "hash 1.22 --samples 3", {"--samples", "3"});
}

TEST_CASE("command line: bumps of no height are the flat quad, and both ways to build a normal are one, bit for bit")
{
    const TemporaryFolder folder;
    const auto hash = [&](const std::string& arguments) {
        return run(folder, "hash " + arguments + " --size 192x108").out.substr(0, 16);
    };
    const std::string flat = hash("1.01");
    CHECK(flat.size() == 16);
    for (const std::string stage : {"1.06", "1.07", "1.08", "1.09", "1.12"})
        CHECK(hash(stage + " --set bumpScale=0") == flat);
    CHECK(hash("1.12 --normal none") == flat);
    CHECK(hash("1.09") != flat);
    CHECK(hash("1.09 --set crossProduct=1") == hash("1.09"));
}

TEST_CASE("command line: signature prints the two tables of the tutorial")
{
    const TemporaryFolder folder;
    const std::string head =
        "// Output signature:\n"
        "//\n"
        "// Name                 Index   Mask Register SysValue  Format   Used\n"
        "// -------------------- ----- ------ -------- -------- ------- ------\n"
        "// SV_POSITION              0   xyzw        0      POS   float   xyzw\n"
        "// TEXCOORD                 0   xyzw        1     NONE   float   xyzw\n"
        "// TEXCOORD                 1   xyz         2     NONE   float   xyz\n";
    const std::string perVertex = head +
                                  "// TEXCOORD                 2   xyz         3     NONE   float   xyz\n"
                                  "// TEXCOORD                 3   xyz         4     NONE   float   xyz\n"
                                  "// TEXCOORD                 4   xyz         5     NONE   float   xyz\n";
    const std::string perFragment = head +
                                    "// TEXCOORD                 2   xyzw        3     NONE   float   xyzw\n"
                                    "// TEXCOORD                 4   xyz         4     NONE   float   xyz\n";
    for (const std::string stage : {"1.24", "1.25"}) {
        CHECK(run(folder, "signature " + stage + " --binormal vertex").out == perVertex);
        CHECK(run(folder, "signature " + stage + " --binormal fragment").out == perFragment);
        const bool fragment = relief::samples::kBinormalPerFragment;
        CHECK(run(folder, "signature " + stage).out == (fragment ? perFragment : perVertex));
    }
    CHECK(run(folder, "signature 0.01").out.find("SV_POSITION") != std::string::npos);
    checkRefused(folder, "signature 1.09 --binormal vertex", {"--binormal", "1.09", "leave it out"});
    checkRefused(folder, "signature 1.24 --binormal pixel", {"--binormal"});
}

TEST_CASE("command line: import options change the normal map, and wrong ones are named")
{
    const TemporaryFolder folder;
    const auto hash = [&](const std::string& options) { return run(folder, "hash 1.11 --size 160x90 " + options).out; };
    const std::string usual = hash("");
    CHECK(usual.size() > 16);
    CHECK(hash("--import storage=dxt5nm --import filter=smooth --import bumpiness=0.05") == usual);
    std::set<std::string> different = {usual};
    for (const std::string option : {"storage=rgb", "storage=dxt5", "filter=sobel", "bumpiness=0.02", "heights=no"})
        CHECK(different.insert(hash("--import " + option)).second);
    checkRefused(folder, "render 1.11 --import storage=bc7", {"--import storage=bc7", "rgb, dxt5nm, dxt5"});
    checkRefused(folder, "render 1.11 --import bumpiness=-1", {"bumpiness=-1", "0 to 16"});
    checkRefused(folder, "render 1.11 --import bumpiness=nan", {"bumpiness=nan", "0 to 16"});
    checkRefused(folder, "render 1.11 --import sharpness=1", {"sharpness", "storage="});
    checkRefused(folder, "render 1.11 --import storage", {"storage"});
}

TEST_CASE("command line: tangents as lines over any stage")
{
    const TemporaryFolder folder;
    for (const std::string stage : {"0.03", "1.06", "1.21", "1.25"}) {
        const std::string plain = run(folder, "hash " + stage + " --size 160x90").out;
        const std::string lines = run(folder, "hash " + stage + " --size 160x90 --show-tangents").out;
        CHECK(plain.size() > 16);
        CHECK(lines.size() == plain.size());
        CHECK(lines != plain);
    }
    checkRefused(folder, "render 1.21 --show-tangents --tangent-scale -1", {"--tangent-scale"});
}

TEST_CASE("command line: explain counts the mip levels of files and of a texture that the stage made")
{
    const TemporaryFolder folder;
    const auto built = [&](const std::string& arguments) {
        const Outcome json = run(folder, "explain " + arguments + " --json");
        return nlohmann::json::parse(json.out)["counts"]["mip levels built"].get<int>();
    };
    CHECK(built("1.01 --size 96x54") == 0);  // it has no texture
    CHECK(built("1.09 --size 96x54") > 1);
    const int baked = built("1.23 --size 96x54");
    CHECK(baked > 1);
    // Alone in the picture: of the chain that a map of 256 x 256 texels has.
    CHECK(baked <= 9);
    CHECK(run(folder, "explain 1.23 --size 96x54").out.find("of 9\n") != std::string::npos);
}

TEST_CASE("command line: explain names the pass that is left out because its light does not reach")
{
    const TemporaryFolder folder;
    const std::string near = run(folder, "explain 0.07 --size 160x90").out;
    CHECK(near.find("pass left out: the lamp does not reach the sphere") != std::string::npos);
    CHECK(near.find("passes (draws)") != std::string::npos);
    const Outcome json = run(folder, "explain 0.07 --size 160x90 --json");
    const auto parsed = nlohmann::json::parse(json.out);
    // Three objects with a base pass and two lights each, less what is left out.
    CHECK(parsed["counts"]["passes left out"].get<std::size_t>() == parsed["notes"].size());
    CHECK(parsed["counts"]["passes (draws)"].get<int>() == 9 - static_cast<int>(parsed["notes"].size()));
}

TEST_CASE("command line: explain tells what the passes before the picture drew, and left out")
{
    const TemporaryFolder folder;
    const auto explained = [&](const std::string& arguments) {
        return nlohmann::json::parse(run(folder, "explain " + arguments + " --json").out)["passes"];
    };
    CHECK(explained("1.01 --size 96x54").empty());

    // A depth alone: three draws whose program no target asks for.
    const nlohmann::json depth = explained("5.03 --size 96x54 --set mapSize=64");
    REQUIRE(depth.size() == 1);
    CHECK(depth[0]["width"] == 64);
    CHECK(depth[0]["counts"]["draws"] == 3);
    CHECK(depth[0]["counts"]["pixels shaded"].get<int>() > 1000);
    CHECK(depth[0]["counts"]["without their program"] == depth[0]["counts"]["pixels shaded"]);
    CHECK(depth[0]["targets"].size() == 1);
    CHECK(depth[0]["targets"][0] ==
          nlohmann::json{{"name", "depth"}, {"format", "depth32f"}, {"kept", true}, {"read", true}});
    for (const nlohmann::json& draw : depth[0]["draws"]) {
        CHECK(draw["program"] == false);
        CHECK(draw["writes"] == std::vector<std::string>{"depth"});
        CHECK_FALSE(draw.contains("stencil"));
    }
    const std::string text = run(folder, "explain 5.03 --size 96x54").out;
    CHECK(text.find("before the picture, a pass of 256x256\n") != std::string::npos);
    CHECK(text.find("    draw 1, cube: writes depth; its program is not run\n") != std::string::npos);
    CHECK(text.find("    target depth, depth32f: a texture afterwards\n") != std::string::npos);

    // The floor marks its pixels; two mirrored solids are tested there, and each draw has its own counts.
    const nlohmann::json mirror = explained("5.19 --size 96x54");
    REQUIRE(mirror.size() == 1);
    const nlohmann::json& draws = mirror[0]["draws"];
    REQUIRE(draws.size() == 6);
    CHECK(draws[0]["writes"] == std::vector<std::string>{"stencil"});
    CHECK(draws[0]["program"] == false);
    CHECK(draws[0]["stencil"]["failed"] == 0);
    CHECK(draws[0]["stencil"]["passed"] == mirror[0]["counts"]["without their program"]);
    std::uint64_t passed = 0, failed = 0;
    for (const nlohmann::json& draw : draws) {
        if (!draw.contains("stencil")) continue;
        passed += draw["stencil"]["passed"].get<std::uint64_t>();
        failed += draw["stencil"]["failed"].get<std::uint64_t>();
    }
    CHECK(mirror[0]["counts"]["stencil tests passed"] == passed);
    CHECK(mirror[0]["counts"]["stencil tests failed"] == failed);
    CHECK(draws[1]["writes"] == std::vector<std::string>{"colour", "depth"});
    CHECK(draws[1].contains("stencil"));
    CHECK_FALSE(draws[3].contains("stencil"));
    CHECK(mirror[0]["targets"][2]["kept"] == false);

    // Four colours in one draw, all of which are read; of the second pass the depth is not.
    const nlohmann::json deferred = explained("5.20 --size 96x54");
    REQUIRE(deferred.size() == 2);
    CHECK(deferred[0]["draws"][0]["writes"] ==
          std::vector<std::string>{"colour 0", "colour 1", "colour 2", "colour 3", "depth"});
    for (const nlohmann::json& target : deferred[0]["targets"]) CHECK(target["read"] == true);
    CHECK(deferred[1]["targets"][1]["read"] == false);
    CHECK(run(folder, "explain 5.20 --size 96x54").out.find("target depth, depth32f: kept, but nobody reads it\n") !=
          std::string::npos);
}

TEST_CASE("command line: none in place of a picture leaves it out")
{
    const TemporaryFolder folder;
    const std::string with = run(folder, "hash 1.13 --size 160x90").out;
    CHECK(run(folder, "hash 1.13 --size 160x90 --albedo none").out != with);
    checkRefused(folder, "render 1.01 --detail-normal x.png", {"--detail-normal", "reads no detail-normal"});
}

// With sanitizers or without optimisation the next one takes minutes.
TEST_CASE("command line: a part of the gallery that there is not is refused")
{
    const TemporaryFolder folder;
    for (const std::string shard : {"0/3", "4/3", "2", "2/", "/3", "2/3x", "-1/3"}) {
        checkRefused(folder, "gallery --out g --shard " + shard, {"--shard " + shard, "such as 2/8"});
        CHECK_FALSE(fs::exists(folder.path / "g"));
    }
}

TEST_CASE("command line: bench --stage measures stages in turn, or draws and says how many pixels it shaded")
{
    const TemporaryFolder folder;
    const Outcome table = run(folder, "bench --stage 1.01 --stage 1.06 --size 96x54 --rounds 2");
    CHECK(table.code == 0);
    std::stringstream lines(table.out);
    std::string line, word;
    CHECK((std::getline(lines, line) && line.find("96x54, threads: 1") != std::string::npos));
    CHECK((std::getline(lines, line) && line.find("ratio to 1.01") != std::string::npos));
    for (const std::string stage : {"1.01", "1.06"}) {
        REQUIRE(std::getline(lines, line));
        CHECK(line.starts_with(stage));
        CHECK(line.find("...") != std::string::npos);
    }
    CHECK_FALSE(std::getline(lines, line));

    const auto counts = nlohmann::json::parse(run(folder, "explain 1.06 --json --size 96x54").out)["counts"];
    CHECK(run(folder, "bench --stage 1.06 --size 96x54 --frames 2").out ==
          std::to_string(counts["pixels shaded"].get<int>()) + "\n");

    checkRefused(folder, "bench --stage 9.99", {"9.99", "relief list"});
    checkRefused(folder, "bench --stage 1.06 --frames 0", {"--frames"});
    checkRefused(folder, "bench --stage 1.06 --frames many", {"--frames"});
    checkRefused(folder, "bench --stage 1.06 --rounds 0", {"--rounds"});
    checkRefused(folder, "bench --stage 1.06 --set depth=1", {"depth", "bumpScale"});
    checkRefused(folder, "bench --stage 1.06 --benchmark_filter=x", {"benchmark_filter"});
    checkRefused(folder, "bench --stage 1.06 --frames 1 --instructions", {"--instructions"});
    checkRefused(folder, "bench --stage 1.06 --instructions", {"--counted-program"});
    checkRefused(folder, "bench --stage 1.06 --instructions --counted-program nothing", {"nothing", "counted"});
    checkRefused(folder, "bench --size 96x54", {"--size", "--stage"});
}

TEST_CASE("command line: bench --instructions divides what valgrind counts in one frame by the pixels")
{
    const TemporaryFolder folder;
    const auto valgrind = [&](const std::string& script) {
        write(folder.path / "valgrind", "#!/bin/sh\n" + script);
        fs::permissions(folder.path / "valgrind", fs::perms::owner_all);
    };
    const std::string bench = "bench --stage 1.06 --size 96x54 --rounds 1 --instructions --counted-program ./valgrind";
    const std::string path = "PATH='" + folder.path.string() + "':\"$PATH\"";
    // In place of valgrind: 1250 instructions for 100 pixels.
    valgrind(R"script([ "$1" = --version ] && exit 0
for word; do case "$word" in --callgrind-out-file=*) echo "totals: 1250" >"${word#*=}.1" ;; esac; done
echo 100
)script");
    const Outcome counted = run(folder, bench, path);
    CAPTURE(counted.err);
    CHECK(counted.code == 0);
    CHECK(counted.out.find("instructions/fragment") != std::string::npos);
    CHECK(counted.out.find(" 12.5 ") != std::string::npos);

    valgrind("[ \"$1\" = --version ]\n");
    checkRefused(folder, bench, {"not counted", "valgrind -q --tool=callgrind", "--stage '1.06'"}, path);
    valgrind("exit 1\n");
    checkRefused(folder, bench, {"install valgrind"}, path);
}

TEST_CASE("command line: a camera of the user's")
{
    const TemporaryFolder folder;
    const auto hash = [&](const std::string& camera) { return run(folder, "hash 1.21 --size 96x54" + camera).out; };
    CHECK(hash(" --camera 1,2,-3").size() > 16);
    CHECK(hash(" --camera 1,2,-3") != hash(" --camera 3,2,-1"));
    CHECK(hash(" --camera 1,2,-3") != hash(""));
    CHECK(hash(" --camera 1,2,-3,0,0,0") == hash(" --camera 1,2,-3"));
    CHECK(hash(" --camera 1,2,-3,0,0,0,40,0.05,100") == hash(" --camera 1,2,-3"));
    CHECK(hash(" --camera 1,2,-3,0,0.1,0") != hash(" --camera 1,2,-3"));
    CHECK(hash(" --camera 1,2,-3,0,0,0,50") != hash(" --camera 1,2,-3"));
    for (const std::string camera :
         {"1,2", "1,2,", "1,2,3,4", "1,2,3,", "1,2,3,0,0,0,0", "1,2,3,0,0,0,40,1", "1,2,3,1,0,3",
          "1,2,3,0,0,0,40,1,2,3", "1,x,3", "0,0,0", "0,1,0", "nan,1,1", "1,1,1000"})
        checkRefused(folder, "render 1.21 --camera " + camera, {"--camera", "X,Y,Z"});
}

#if defined(RELIEF_SWITCHES)
TEST_CASE("command line: what RELIEF_GENERIC cannot put back is refused")
{
    const TemporaryFolder folder;
    checkRefused(folder, "hash 0.01 --size 16x16", {"RELIEF_GENERIC: nothing named clip ", "clipping"},
                 "RELIEF_GENERIC=clip");
    CHECK(run(folder, "hash 0.01 --size 16x16", "RELIEF_GENERIC='clipping tiles'").code == 0);
}
#endif

TEST_CASE(
    "command line: import-environment writes the levels of a picture into one file, and refuses what it cannot use")
{
    const TemporaryFolder folder;
    // Longitude and latitude, one colour.
    std::vector<float> rgb;
    for (int i = 0; i < 32 * 16; ++i) rgb.insert(rgb.end(), {1.0f, 0.5f, 4.0f});
    REQUIRE(relief::writePfm(folder / "sky.pfm", 32, 16, rgb));
    const Outcome outcome = run(folder, "import-environment sky.pfm --size 16 --samples 20 --threads 2");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out == "sky-prefiltered.hdr\n");
    CHECK(outcome.err.empty());
    CHECK(run(folder, "import-environment sky.pfm --size 16 --samples 20 -o sky2.pfm --threads 1").code == 0);
    for (const char* name : {"sky-prefiltered.hdr", "sky2.pfm"}) {
        const auto picture = relief::readImage(folder / name);
        REQUIRE(picture);
        const auto map = relief::CubeMap::fromPicture(*picture, relief::ColorSpace::linear);
        REQUIRE(map);
        CHECK(map->levelCount() == 3);  // 16, 8, 4
        for (int k = 0; k < 3; ++k) CHECK(map->texel(k, 5, 3, 0) == glm::vec4(1.0f, 0.5f, 4.0f, 1.0f));
    }

    checkRefused(folder, "import-environment", {"file"});
    checkRefused(folder, "import-environment nothing.hdr", {"nothing.hdr", "cannot open"});
    checkRefused(folder, "import-environment sky2.pfm", {"sky2.pfm", "prefiltered already"});
    checkRefused(folder, "import-environment sky.pfm -o sky.png", {"sky.png", ".hdr or .pfm"});
    checkRefused(folder, "import-environment sky.pfm -o none/sky.hdr", {"none/sky.hdr", "folder"});
    checkRefused(folder, "import-environment sky.pfm --size 7", {"--size"});
    checkRefused(folder, "import-environment sky.pfm --samples 0", {"--samples"});
    REQUIRE(relief::writePfm(folder / "wrong.pfm", 16, 32, rgb));
    checkRefused(folder, "import-environment wrong.pfm", {"wrong.pfm", "16x32", "cross", "2:1"});
}

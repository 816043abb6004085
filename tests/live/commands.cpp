// The commands that take a file: what they print, and that bad input is one line and exit code 2.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include <doctest/doctest.h>
#include <sys/wait.h>

#include "gltf_file.h"
#include "live_command.h"
#include "relief/texture/image.h"

namespace {

void checkRefused(const TemporaryFolder& folder, const std::string& arguments, const std::string& words)
{
    CAPTURE(arguments);
    const Outcome outcome = runCommand(folder, arguments);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK_MESSAGE(outcome.err.find(words) != std::string::npos, outcome.err);
}

}  // namespace

TEST_CASE("live: a new stage in a file is drawn, hashed, explained and measured")
{
    const TemporaryFolder folder;
    REQUIRE(runCommand(folder, "new my_shader.cpp").code == 0);
    const Outcome hash = runCommand(folder, "hash my_shader.cpp --size 64x36");
    CHECK_MESSAGE(hash.code == 0, hash.err);
    CHECK(hash.out.find("my_shader") == 18);
    CHECK(runCommand(folder, "hash my_shader.cpp --size 64x36").out == hash.out);
    CHECK(runCommand(folder, "hash my_shader --size 64x36", "live_stage/my_shader").out ==
          hash.out);  // relief_add_stage
    const Outcome render = runCommand(folder, "render my_shader.cpp --size 64x36 -o picture.png --set tiling=2");
    CHECK_MESSAGE(render.code == 0, render.err);
    CHECK(relief::readImage((folder / "picture.png").string()));
    CHECK(runCommand(folder, "explain my_shader.cpp --size 64x36").out.find("my_shader My shader at 64x36") == 0);
    CHECK(runCommand(folder, "signature my_shader.cpp").out.find("SV_POSITION") != std::string::npos);

    REQUIRE(runCommand(folder, "new copy.cpp --from my_shader.cpp").code == 0);
    CHECK(runCommand(folder, "hash copy.cpp --size 64x36").out.substr(0, 16) == hash.out.substr(0, 16));
    REQUIRE(runCommand(folder, "new copy112.cpp --from 1.12").code == 0);
    CHECK(runCommand(folder, "hash copy112.cpp --size 64x36").out.substr(0, 16) ==
          runCommand(folder, "hash 1.12 --size 64x36", "relief").out.substr(0, 16));
}

TEST_CASE("live: render --watch writes a picture at every save")
{
    using namespace std::chrono_literals;
    const TemporaryFolder folder;
    REQUIRE(runCommand(folder, "new my_shader.cpp").code == 0);
    const std::string text = contents(folder / "my_shader.cpp");
    const std::string command = "cd '" + folder.path.string() +
                                "' && exec '" RELIEF_PROGRAMS
                                "/relief_view' render my_shader.cpp --watch --size 64x36 -o p.png >out.txt 2>err.txt "
                                "</dev/null & echo $!";
    std::filesystem::remove(folder / "out.txt");
    FILE* const shell = ::popen(command.c_str(), "r");
    REQUIRE(shell != nullptr);
    int process = 0;
    REQUIRE(std::fscanf(shell, "%d", &process) == 1);
    const auto await = [&](int lines) {
        for (int i = 0; i < 300; ++i) {
            const std::string out = contents(folder / "out.txt");
            if (std::count(out.begin(), out.end(), '\n') >= lines) return true;
            std::this_thread::sleep_for(100ms);
        }
        return false;
    };
    REQUIRE(await(1));
    const std::string first = contents(folder / "p.png");
    folder.write("my_shader.cpp", text + "}");
    for (int i = 0; i < 100 && contents(folder / "err.txt").empty(); ++i) std::this_thread::sleep_for(100ms);
    std::string red = text;
    red.replace(red.find("return float4(albedo"), 20, "return float4(1, 0, 0, 1);  // ");
    folder.write("my_shader.cpp", red);
    CHECK(await(2));
    CHECK(contents(folder / "p.png") != first);
    CHECK(contents(folder / "err.txt").find("'}'") != std::string::npos);
    ::kill(process, SIGTERM);
    ::pclose(shell);
}

TEST_CASE("live: the window opens, shows frames and closes under SDL's dummy driver")
{
    ::setenv("SDL_VIDEODRIVER", "dummy", 1);
    const TemporaryFolder folder;
    const Outcome outcome = runCommand(folder, "view 1.09 --size 64x36 --frames 3");
    if (outcome.err.find("has no window") != std::string::npos) {
        CHECK(outcome.code == 2);
        MESSAGE("built without SDL2 or Dear ImGui");
    } else {
        CHECK_MESSAGE(outcome.code == 0, outcome.err);
    }
    checkRefused(folder, "view 9.99", "9.99");
    if (outcome.code != 0) return;
    checkRefused(folder, "view 1.09 --set nope=1", "nope");
    checkRefused(folder, "view 1.09 --albedo none.png", "none.png");
    checkRefused(folder, "view 1.09 --scale 9", "--scale");

    folder.write("a.glb", GltfFile::square().glb());
    folder.write("cut.glb", GltfFile::square().glb().substr(0, 500));
    const Outcome scene = runCommand(folder, "view a.glb --size 64x36 --frames 3");
    CHECK_MESSAGE(scene.code == 0, scene.err);
    checkRefused(folder, "view cut.glb", "cut.glb: is truncated");
    checkRefused(folder, "view none.glb", "none.glb");
}

TEST_CASE("live: bad input is one line")
{
    const TemporaryFolder folder;
    folder.write("there.cpp", "text");
    checkRefused(folder, "new there.cpp", "there already");
    CHECK(contents(folder / "there.cpp") == "text");
    checkRefused(folder, "new shader.txt", ".cpp");
    checkRefused(folder, "new no/folder/s.cpp", "cannot be written");
    checkRefused(folder, "new s.cpp --from 9.99", "9.99");
    checkRefused(folder, "new s.cpp --from there.cpp", "Stage NAME()");
    for (const char* command : {"render", "hash", "explain", "signature", "view", "render --watch", "bench --live"}) {
        checkRefused(folder, std::string(command) + " missing.cpp", "no such file");
    }
    checkRefused(folder, "bench --live 9.99", "9.99");
    checkRefused(folder, "bench --live 1.12 --saves 0", "--saves");
    checkRefused(folder, "bench --saves 3", "--live");
    checkRefused(folder, "bench --live 1.12 --stage 1.12", "--stage");
    checkRefused(folder, "bench --live 1.12 --rounds 2", "--rounds");
    checkRefused(folder, "render --watch 1.12 --compiler msvc", "msvc");
    checkRefused(folder, "render --watch 1.12 --size 0x0", "--size");

    const Outcome outcome = runCommand(folder, "hash there.cpp");
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("Stage NAME()") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "s.cpp"));
}

// The copied command: the program, run with it, writes the same bytes as the window.
#include <sys/wait.h>

#include "hands.h"
#include "live/new_stage.h"
#include "picture_command.h"
#include "prepare.h"
#include "view/orbit.h"

using namespace relief;
using namespace relief::samples;

namespace {

// The command in a folder where `relief` is this program.
int run(const TemporaryFolder& folder, const std::string& command, const std::string& program)
{
    const std::string shell = "cd '" + folder.path.string() + "' && ln -sf '" RELIEF_PROGRAMS "/" + program +
                              "' relief && " + command + " >out.txt 2>&1 </dev/null";
    const int status = std::system(shell.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void checkSameBytes(const Hands& hands, const TemporaryFolder& folder, const std::string& program)
{
    const std::string command = hands.viewer().command("of the command.png");
    CAPTURE(command);
    REQUIRE(writePixels((folder / "of the window.png").string(), hands.viewer().picture()));
    REQUIRE_MESSAGE(run(folder, command, program) == 0, contents(folder / "out.txt"));
    CHECK(contents(folder / "of the command.png") == contents(folder / "of the window.png"));
}

}  // namespace

TEST_CASE("view: the copied command renders the very picture: a stage of the book")
{
    const TemporaryFolder folder;
    const Hands hands("1.12", "160x90", {"smoothness=0.3"});
    Viewer& viewer = hands.viewer();
    CHECK(hands.value("smoothness") == 0.3f);  // the command line's
    viewer.set(hands.property("bumpScale"), glm::vec4(1.0f / 3.0f));
    viewer.set(hands.property("mainTex_ST"), {-1.1f, 2.3f, 1e-5f, 0.7f});
    viewer.setCamera(moved(orbited(zoomed(viewer.camera(), 0.9f), -33.3f, 7.7f), 0.05f, 0.02f));
    hands.settle();
    checkSameBytes(hands, folder, "stages/relief_bumpiness_12_bump_scale");
    live::Look look = viewer.look();
    look.showTangents = true;
    look.tangentScale = 0.07f;
    look.files.textures[TextureSlot::albedo] = kNone;
    look.camera->fieldOfView = 33.0f;
    look.show = "depth";
    viewer.change(look);
    hands.settle();
    checkSameBytes(hands, folder, "stages/relief_bumpiness_12_bump_scale");
    look.show = "blocks";
    look.tileSize = 32;
    look.samples = 4;
    viewer.change(look);
    hands.settle();
    checkSameBytes(hands, folder, "stages/relief_bumpiness_12_bump_scale");
}

TEST_CASE("view: the copied command renders the very picture: a file whose name a shell would split")
{
    const TemporaryFolder folder;
    const std::string path = (folder / "it's my shader.cpp").string();
    REQUIRE(live::writeNewStage(path, ""));
    const Hands hands(path);
    hands.viewer().set(hands.property("tiling"), glm::vec4(2.5f));
    hands.settle();
    checkSameBytes(hands, folder, "relief_view");
}

TEST_CASE("view: a camera's text is the same camera again, to the last bit")
{
    const Camera usual{.position = {1.0f, 1.0f, -2.0f}};
    CHECK(cameraText(usual) == "1,1,-2");
    Camera camera = orbited(usual, 12.3f, 4.5f);
    for (int i = 0; i < 50; ++i) {
        camera = moved(orbited(zoomed(camera, 1.01f), 7.7f, i % 2 == 0 ? 3.3f : -2.9f), 0.011f, -0.007f);
        if (i == 20) camera.fieldOfView = 33.3f;
        if (i == 30) camera.nearPlane = 0.1f;
        const Expected<Camera> again = parseCamera(cameraText(camera));
        REQUIRE(again);
        CHECK(again->position == camera.position);
        CHECK(again->target == camera.target);
        CHECK(again->fieldOfView == camera.fieldOfView);
        CHECK(again->nearPlane == camera.nearPlane);
        CHECK(again->farPlane == camera.farPlane);
    }
}

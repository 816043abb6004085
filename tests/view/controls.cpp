// Every control, by events.
#include "hands.h"
#include "live/new_stage.h"

using namespace relief;
using namespace relief::samples;

namespace {

struct Own
{
    TemporaryFolder folder;
    std::string path;
    explicit Own(const std::string& from = "")
    {
        path = (folder / "my_shader.cpp").string();
        REQUIRE(live::writeNewStage(path, from));
    }
};

}  // namespace

TEST_CASE("view: sliders, colours, and their resets")
{
    const Own own;
    const Hands hands(own.path);
    const Pixels before = hands.viewer().picture();
    hands.click("property.tiling", 0.6f);
    CHECK(hands.value("tiling") > 1.0f);
    CHECK(hands.viewer().picture().colors != before.colors);
    hands.click("reset.tiling");
    CHECK(hands.value("tiling") == hands.property("tiling").value.x);
    CHECK(hands.viewer().picture().colors == before.colors);
    CHECK_FALSE(hands.has("reset.tiling"));

    const Hands::Place swatch = hands.place("property.tint");
    hands.clickAt(swatch.left + 8.0f, swatch.top + 8.0f);
    hands.clickAt(swatch.left + 90.0f, swatch.bottom + 90.0f);  // in the picker
    CHECK(hands.viewer().isChanged(hands.property("tint")));
    hands.key(SDLK_ESCAPE);
    CHECK(hands.interface().running);
    hands.click("property.lightYaw", 0.9f);
    CHECK(hands.viewer().isChanged(hands.property("lightYaw")));
    hands.click("reset all");
    CHECK_FALSE(hands.viewer().isChanged(hands.property("tint")));
    CHECK_FALSE(hands.viewer().isChanged(hands.property("lightYaw")));

    SDL_SetModState(KMOD_CTRL);
    hands.key(SDLK_LCTRL, KMOD_CTRL, false);
    hands.click("property.tiling");  // with control: type the number
    hands.key(SDLK_LCTRL);
    hands.type("3.25");
    hands.key(SDLK_RETURN);
    CHECK(hands.value("tiling") == 3.25f);
}

TEST_CASE("view: vectors, ticks and choices")
{
    {
        const Hands hands("4.11");
        hands.choose("property.weights", "choice.3");
        CHECK(hands.value("weights") == 3.0f);
        hands.click("property.asColors", 0.5f);
        CHECK(hands.value("asColors") == 1.0f);
        hands.click("property.asColors", 0.5f);
        CHECK(hands.value("asColors") == 0.0f);
    }
    const Hands hands("1.24");
    hands.drag("property.mainTex_ST.1", 60.0f, 0.0f);
    CHECK(hands.viewer().value(hands.property("mainTex_ST")).y > 1.0f);
    CHECK(hands.viewer().value(hands.property("mainTex_ST")).x == 1.0f);
    hands.choose("property.binormalPerFragment", "choice.1");
    CHECK(hands.value("binormalPerFragment") == 1.0f);
}

TEST_CASE("view: camera, light, size, threads, tiles, lines, text")
{
    const Own own;
    const Hands hands(own.path);
    Viewer& viewer = hands.viewer();
    const Camera before = viewer.camera();
    hands.drag("picture", 40.0f, 10.0f);
    CHECK(viewer.camera().position != before.position);
    CHECK(viewer.camera().target == before.target);
    hands.drag("picture", 40.0f, 10.0f, SDL_BUTTON_RIGHT);
    CHECK(viewer.camera().target != before.target);
    hands.click("camera.reset");
    CHECK(viewer.camera().position == before.position);
    hands.move(700.0f, 400.0f);
    hands.wheel(1);
    CHECK(std::abs(viewer.camera().position.z) < std::abs(before.position.z));
    hands.key(SDLK_r, KMOD_LSHIFT);
    CHECK(viewer.camera().position == before.position);
    hands.drag("camera.position", 30.0f, 0.0f);
    CHECK(viewer.camera().position.y != before.position.y);
    hands.drag("camera.target", 30.0f, 0.0f);
    CHECK(viewer.camera().target != before.target);
    hands.click("camera.field", 0.8f);
    CHECK(viewer.camera().fieldOfView > 80.0f);
    hands.key(SDLK_r);
    CHECK(viewer.camera().fieldOfView == before.fieldOfView);

    const float yaw = hands.value("lightYaw");
    hands.key(SDLK_LSHIFT, KMOD_LSHIFT, false);
    hands.drag("picture", 40.0f, 0.0f);
    hands.key(SDLK_LSHIFT);
    CHECK(hands.value("lightYaw") == doctest::Approx(yaw + 16.0f));
    CHECK(viewer.camera().position == before.position);

    hands.click("picture.threads", 0.99f);
    CHECK(viewer.look().threads >= 4);
    hands.choose("picture.tile", "tile.128");
    CHECK(viewer.look().tileSize == 128);
    const std::vector<std::uint32_t> jagged = viewer.picture().colors;
    hands.choose("picture.samples", "samples.8");
    CHECK(viewer.look().samples == 8);
    const std::vector<std::uint32_t> plain = viewer.picture().colors;
    CHECK(plain != jagged);
    hands.click("picture.tangents", 0.1f);
    CHECK(viewer.look().showTangents);
    CHECK(viewer.picture().colors != plain);
    for (const char* slider : {"tangents.length", "tangents.distance"}) {
        CAPTURE(slider);
        const std::vector<std::uint32_t> lines = viewer.picture().colors;
        hands.click(slider, 0.8f);
        CHECK(viewer.picture().colors != lines);
    }
    CHECK(viewer.look().tangentScale == doctest::Approx(0.8f).epsilon(0.05));
    CHECK(viewer.look().tangentOffset == doctest::Approx(0.16f).epsilon(0.05));
    hands.click("picture.tangents", 0.1f);

    hands.click("picture.size", 0.2f);
    hands.type("128");
    hands.key(SDLK_RETURN);
    CHECK(viewer.picture().width == 128);
    hands.choose("picture.fit", "fit.1");
    CHECK(viewer.picture().width == 960);
    CHECK(viewer.picture().height == 540);
    hands.choose("picture.fit", "fit.2");
    CHECK(viewer.picture().width == 960);
    CHECK(viewer.picture().height > 600);
    hands.choose("picture.text", "text.2\xc3\x97");
    CHECK(hands.application->window.scale() == 2.0f);
    CHECK(hands.place("panel").bottom - hands.place("panel").top > 40.0f);
    for (const char* name : {"panel", "show", "beside", "keep", "copy", "save", "record", "help"}) {
        CAPTURE(name);
        CHECK(hands.place(name).right <= 1280.0f);  // it takes two lines, then
    }
}

TEST_CASE("view: what lies behind the picture")
{
    const Own own;
    const Hands hands(own.path, "480x270");
    const std::vector<std::uint32_t> picture = hands.viewer().picture().colors;
    REQUIRE(hands.viewer().views().size() > 2);
    hands.choose("show", "show.depth");
    CHECK(hands.viewer().look().show == "depth");
    CHECK(hands.viewer().picture().colors != picture);
    CHECK(hands.viewer().command("p.png").find("--show depth") != std::string::npos);
    hands.choose("show", "show.color");
    CHECK(hands.viewer().look().show.empty());
    CHECK(hands.viewer().picture().colors == picture);
}

TEST_CASE("view: stages: search, step, page")
{
    const Hands hands("1.11");
    CHECK(hands.has("page"));
    hands.click("next");
    CHECK(hands.viewer().session().source().id == "1.12");
    hands.click("before");
    hands.key(SDLK_LEFT);
    CHECK(hands.viewer().session().source().id == "1.10");
    hands.key(SDLK_RIGHT);
    CHECK(hands.viewer().session().source().id == "1.11");
    hands.click("tab.stages");
    hands.click("search");
    hands.type("whiteout r");  // letters that are keys, too
    CHECK(hands.has("stage.1.18"));
    CHECK_FALSE(hands.has("stage.0.01"));
    hands.click("stage.1.18");
    REQUIRE(hands.until([&] { return hands.viewer().stage() != nullptr; }));
    CHECK(hands.viewer().session().source().id == "1.18");
    hands.click("tab.stage");
    hands.key(SDLK_f, KMOD_LCTRL);
    CHECK(hands.has("search"));
    hands.key(SDLK_ESCAPE);
    hands.key(SDLK_TAB);
    CHECK_FALSE(hands.has("search"));
    hands.click("panel");
    CHECK(hands.has("tab.stage"));
}

TEST_CASE("view: pictures beside pictures")
{
    const Hands hands("1.12", "480x270");
    Viewer& viewer = hands.viewer();
    hands.choose("beside", "beside.golden");
    REQUIRE(viewer.canCompare());
    CHECK(viewer.difference().pixels == 0);
    hands.click("keep");
    hands.click("property.bumpScale", 0.9f);
    CHECK(viewer.difference().largest > 0);
    hands.click("compare.difference", 0.1f);
    CHECK(viewer.showsDifference());
    CHECK(viewer.shown().colors == viewer.difference().picture.colors);
    hands.click("compare.divider", 0.1f);
    CHECK_FALSE(viewer.showsDifference());
    hands.click("compare.difference", 0.1f);
    const std::vector<std::uint32_t> eight = viewer.shown().colors;
    hands.choose("enlargement", "enlargement.32");
    CHECK(viewer.enlargement() == 32);
    CHECK(viewer.shown().colors != eight);
    hands.key(SDLK_F3);
    CHECK_FALSE(viewer.showsDifference());
    hands.choose("beside", "beside.snapshot.0");
    REQUIRE(viewer.canCompare());
    CHECK(viewer.difference().pixels > 0);
    CHECK(viewer.shown().at(0, 100) == viewer.besidePicture().at(0, 100));
    const Camera camera = viewer.camera();
    hands.drag("picture", 100.0f, 0.0f);  // the divider is in its middle
    CHECK(viewer.camera().position == camera.position);
    CHECK(viewer.divider() > 0.6f);
    CHECK(viewer.shown().at(280, 150) == viewer.besidePicture().at(280, 150));

    hands.key(SDLK_F2);
    CHECK(viewer.besideKind() == Viewer::Beside::nothing);
    hands.key(SDLK_F2);
    REQUIRE(hands.until([&] { return viewer.canCompare(); }));
    CHECK(viewer.besideName() == "1.11");
    hands.settle();
    CHECK(viewer.difference().pixels > 0);
    hands.click("picture.threads", 0.5f);  // the other one follows size and camera
    hands.drag("picture", 0.0f, 20.0f, SDL_BUTTON_RIGHT);
    hands.settle();
    CHECK(viewer.canCompare());
    hands.choose("beside", "beside.nothing");
    CHECK(viewer.shown().colors == viewer.picture().colors);
}

TEST_CASE("view: a kept picture of another size offers its size")
{
    const Own own;
    const Hands hands(own.path);
    hands.key(SDLK_k);
    hands.choose("picture.fit", "fit.1");
    hands.choose("beside", "beside.snapshot.0");
    CHECK_FALSE(hands.viewer().canCompare());
    hands.click("take size");
    CHECK(hands.viewer().canCompare());
    CHECK(hands.viewer().picture().width == 96);
}

TEST_CASE("view: the magnifier, and a pixel that is kept over a save")
{
    const Own own;
    const Hands hands(own.path);
    const Hands::Place p = hands.place("picture");
    const float x = p.left + 0.25f * (p.right - p.left), y = p.top + 0.5f * (p.bottom - p.top);
    hands.move(x, y);
    const std::vector<std::uint32_t> before = hands.application->window.contents().colors;
    hands.key(SDLK_m, 0, false);
    CHECK(hands.application->window.contents().colors != before);
    const Camera camera = hands.viewer().camera();
    hands.wheel(1);
    CHECK(hands.viewer().camera().position == camera.position);  // the wheel is the magnifier's
    hands.hold(true, x, y);
    hands.hold(false, x, y);
    hands.key(SDLK_m);
    REQUIRE(hands.viewer().kept);
    CHECK(hands.viewer().kept->x == 24);
    CHECK(hands.viewer().kept->y == 27);
    CHECK(hands.has("kept"));

    hands.click("property.tiling", 0.7f);
    hands.drag("picture", 30.0f, 0.0f);
    const float tiling = hands.value("tiling");
    const glm::vec3 position = hands.viewer().camera().position;
    std::ofstream(own.path, std::ios::app) << "// again\n";
    REQUIRE(hands.until([&] { return hands.viewer().session().picture().version == 2; }));
    hands.settle();
    CHECK(hands.viewer().kept->x == 24);
    CHECK(hands.value("tiling") == tiling);
    CHECK(hands.viewer().camera().position == position);
    hands.click("kept.release");
    CHECK_FALSE(hands.viewer().kept);
}

// In place of the program that opens pages: one that writes down what it is given.
class PageOpener
{
public:
    PageOpener() : path(::getenv("PATH"))
    {
        const std::filesystem::path program = folder / "xdg-open";
        std::ofstream(program) << "#!/bin/sh\nprintf '%s' \"$1\" >'" << (folder / "opened").string() << "'\n";
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        ::setenv("PATH", (folder.path.string() + ":" + path).c_str(), 1);
    }
    ~PageOpener() { ::setenv("PATH", path.c_str(), 1); }

    std::string opened() const { return contents(folder / "opened"); }

private:
    const TemporaryFolder folder;
    const std::string path;
};

TEST_CASE("view: a stage's page is opened")
{
    const PageOpener pages;
    const Hands hands("1.12");
    hands.click("page");
    CHECK(pages.opened().starts_with("file:///"));
    CHECK(pages.opened().ends_with("/docs/bumpiness/12_bump_scale.md"));
}

TEST_CASE("view: the life of a kept pixel is told line by line, and on a page")
{
    const PageOpener pages;
    const Own own;
    const Hands hands(own.path);
    const Hands::Place p = hands.place("picture");
    const float x = (p.left + p.right) / 2.0f, y = (p.top + p.bottom) / 2.0f;
    hands.key(SDLK_m, 0, false);
    hands.move(x, y);
    hands.hold(true, x, y);
    hands.hold(false, x, y);
    hands.key(SDLK_m);
    REQUIRE(hands.viewer().kept);
    hands.click("kept.life");
    REQUIRE(hands.until([&] { return hands.has("step.on"); }));
    CHECK(hands.has("step.0"));
    const Viewer::Point first = *hands.viewer().kept;

    // Forwards, backwards, to the end: what is shown is the list's row, which the tests of the trace hold to the bits.
    hands.click("step.on");
    hands.key(SDLK_F10);
    hands.key(SDLK_F10, KMOD_LSHIFT);
    hands.click("step.last");
    CHECK_FALSE(hands.interface().shown().name.empty());
    hands.click("step.first");
    const PixelStep begin = hands.interface().shown();
    CHECK(begin.line > 0);
    CHECK_FALSE(begin.code.empty());
    hands.click("step.on");
    CHECK(hands.interface().shown().line >= begin.line);
    hands.click("step.back");
    CHECK(hands.interface().shown().name == begin.name);

    // A neighbour, by button and by key: the same process tells it.
    hands.click("pixel.right");
    hands.key(SDLK_DOWN, KMOD_LSHIFT);
    CHECK(hands.viewer().kept->x == first.x + 1);
    CHECK(hands.viewer().kept->y == first.y + 1);
    REQUIRE(hands.until([&] { return hands.has("pixel.summary"); }));

    // A value in every pixel, beside the picture.
    while (hands.interface().shown().name != "lambert") {
        REQUIRE(hands.has("step.on"));
        hands.click("step.on");
    }
    hands.click("step.everywhere");
    REQUIRE(hands.until([&] { return hands.viewer().besideKind() == Viewer::Beside::snapshot; }));
    CHECK(hands.viewer().besideName().starts_with("lambert@"));
    CHECK(hands.viewer().besidePicture().sameSize(hands.viewer().picture()));

    hands.click("pixel.page");
    REQUIRE(hands.until([&] { return pages.opened().ends_with(".html"); }));
    const std::string path = pages.opened().substr(std::string("file://").size());
    const std::string page = contents(path);
    const Viewer::Point kept = *hands.viewer().kept;
    CHECK(contains(page, "The life of pixel " + std::to_string(kept.x) + "," + std::to_string(kept.y)));
    CHECK(contains(page, "const Float lambert = saturate("));
    std::filesystem::remove(path);
}

TEST_CASE("view: copy, save, record")
{
    const Own own;
    const Hands hands(own.path);
    hands.click("copy");
    CHECK(hands.interface().copied == hands.viewer().command("my_shader.png"));
    CHECK(hands.interface().copied.starts_with("./relief render "));
    hands.key(SDLK_c, KMOD_LCTRL);

    hands.click("save");
    hands.type((own.folder / "no/p.png").string());  // the name that stands there is selected
    hands.key(SDLK_RETURN);
    CHECK(hands.has("save.file"));  // it says why not, and asks again
    hands.click("save.cancel");
    CHECK_FALSE(hands.has("save.file"));
    hands.key(SDLK_s, KMOD_LCTRL);
    hands.type((own.folder / "p.png").string());
    hands.click("save.save");
    CHECK(readPixels((own.folder / "p.png").string())->colors == hands.viewer().picture().colors);

    const glm::vec3 position = hands.viewer().camera().position;
    hands.click("record");
    hands.click("turn.folder");
    hands.type((own.folder / "turn").string());
    hands.click("turn.frames", 0.001f);
    hands.click("turn.begin");
    REQUIRE(hands.until([&] { return !hands.has("turn.stop") && !hands.has("turn.begin"); }));
    hands.settle();
    CHECK(hands.viewer().camera().position == position);
    const Expected<Pixels> first = readPixels((own.folder / "turn/my_shader_000.png").string());
    const Expected<Pixels> second = readPixels((own.folder / "turn/my_shader_001.png").string());
    REQUIRE(first);
    REQUIRE(second);
    CHECK(first->colors != second->colors);
    CHECK_FALSE(std::filesystem::exists(own.folder / "turn/my_shader_002.png"));

    // Stopped on the way.
    hands.click("record");
    hands.click("turn.folder");
    hands.type((own.folder / "part").string());
    hands.click("turn.frames", 0.6f);
    hands.push(SDL_MOUSEMOTION, "turn.begin");
    hands.push(SDL_MOUSEBUTTONDOWN, "turn.begin");
    hands.push(SDL_MOUSEBUTTONUP, "turn.begin");
    hands.push(SDL_MOUSEMOTION, "turn.stop");
    hands.push(SDL_MOUSEBUTTONDOWN, "turn.stop");
    hands.push(SDL_MOUSEBUTTONUP, "turn.stop");
    REQUIRE(hands.until([&] { return !hands.has("turn.stop"); }));
    hands.settle();
    CHECK(hands.viewer().camera().position == position);
    CHECK(std::filesystem::exists(own.folder / "part/my_shader_000.png"));
    CHECK_FALSE(std::filesystem::exists(own.folder / "part/my_shader_050.png"));

    hands.click("record");
    hands.click("turn.cancel");
    CHECK_FALSE(hands.has("turn.begin"));
    hands.click("record");
    hands.key(SDLK_ESCAPE);
    CHECK_FALSE(hands.has("turn.begin"));
    CHECK(hands.interface().running);
}

TEST_CASE("view: dropped files ask what they are")
{
    const Own own;
    const Hands hands(own.path);
    Viewer& viewer = hands.viewer();
    const std::vector<std::uint32_t> before = viewer.picture().colors;
    Pixels red{2, 2, std::vector<std::uint32_t>(4, 0xff0000ffu)};
    const std::string picture = (own.folder / "red.png").string();
    REQUIRE(writePixels(picture, red));
    hands.drop(picture);
    hands.click("drop.albedo");
    CHECK(viewer.look().files.textures[TextureSlot::albedo] == picture);
    CHECK(viewer.picture().colors != before);
    hands.drop(picture);
    hands.click("drop.cancel");
    CHECK_FALSE(hands.has("drop.cancel"));

    own.folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    hands.drop((own.folder / "t.obj").string());
    CHECK_FALSE(hands.has("drop.albedo"));
    hands.click("drop.mesh");
    CHECK(viewer.look().files.mesh == (own.folder / "t.obj").string());

    // What cannot be read is one line, and nothing changes.
    const std::vector<std::uint32_t> good = viewer.picture().colors;
    own.folder.write("bad.png", "no picture");
    hands.drop((own.folder / "bad.png").string());
    hands.click("drop.albedo");
    REQUIRE(hands.until([&] { return !viewer.refusal.empty(); }));
    hands.settle();
    CHECK(viewer.refusal.find("bad.png") != std::string::npos);
    CHECK(viewer.look().files.textures[TextureSlot::albedo] == picture);
    CHECK(viewer.picture().colors == good);
    hands.click("refusal.close");
    CHECK(viewer.refusal.empty());

    hands.click("section.Inputs");
    hands.click("reset.albedo");
    CHECK(viewer.look().files.textures[TextureSlot::albedo].empty());
    hands.choose("input.mesh", "input.cube");
    CHECK(viewer.look().files.mesh == "cube");
}

TEST_CASE("view: the doctor examines a map, and the cured one takes its place")
{
    const TemporaryFolder folder;
    const std::string file = (folder / "bumps.png").string();
    Pixels sound{64, 64, {}}, wrong = sound;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            // Of one surface: v goes up, and y goes down.
            const float wave = std::sin(static_cast<float>(x + 2 * y) * 0.09817477f);
            const float u = 0.4f * std::sin(static_cast<float>(3 * x) * 0.09817477f + 1.0f) + 0.15f * wave,
                        down = 0.3f * wave;
            const float length = std::sqrt(u * u + down * down + 1.0f);
            const auto code = [&](float value) {
                return static_cast<std::uint32_t>((value / length * 0.5f + 0.5f) * 255.0f + 0.5f);
            };
            const std::uint32_t rest = code(u) | code(1.0f) << 16 | 0xff000000u;
            sound.colors.push_back(rest | code(-down) << 8);
            wrong.colors.push_back(rest | code(down) << 8);
        }
    }
    REQUIRE(writePixels(file, wrong));

    const Hands hands(file);
    Viewer& viewer = hands.viewer();
    REQUIRE(hands.until([&] { return !hands.interface().diagnosis().empty(); }));
    hands.settle();
    CHECK_MESSAGE(hands.interface().diagnosis().find("fault: green is upside down") != std::string::npos,
                  hands.interface().diagnosis());
    const Hands::Place shown = hands.place("doctor.evidence");
    CHECK(shown.right - shown.left == doctest::Approx(4.0f * (shown.bottom - shown.top)).epsilon(0.02));
    CHECK(viewer.stage()->title == "Bump scale");
    CHECK(viewer.look().files.textures[TextureSlot::normal] == file);
    const std::vector<std::uint32_t> before = viewer.picture().colors;

    hands.click("doctor.cure");
    REQUIRE(hands.until([&] { return viewer.look().files.textures[TextureSlot::normal] != file; }));
    REQUIRE(hands.until([&] { return viewer.picture().colors != before; }));
    hands.settle();
    CHECK_FALSE(hands.has("doctor.close"));
    const Expected<Pixels> cured = readPixels(viewer.look().files.textures[TextureSlot::normal]);
    REQUIRE(cured);
    CHECK(differenceOf(*cured, sound, 1).largest <= 1);

    for (const char* section : {"section.Picture", "section.Camera", "section.Properties", "section.Inputs"})
        hands.click(section);
    hands.choose("input.normal", "input.doctor");
    hands.until([&] { return hands.interface().diagnosis().find("no fault was found") != std::string::npos; });
    CHECK_MESSAGE(hands.interface().diagnosis().find("no fault was found") != std::string::npos,
                  hands.interface().diagnosis());
    hands.settle();
    CHECK_FALSE(hands.has("doctor.cure"));
    hands.click("doctor.close");
    CHECK_FALSE(hands.has("doctor.close"));
    std::filesystem::remove(viewer.look().files.textures[TextureSlot::normal]);
}

TEST_CASE("view: keys")
{
    const Own own;
    const Hands hands(own.path);
    hands.key(SDLK_F1);
    CHECK(hands.has("help.close"));
    hands.key(SDLK_F1);
    CHECK_FALSE(hands.has("help.close"));
    hands.click("help");
    hands.click("help.close");
    CHECK_FALSE(hands.has("help.close"));
    SDL_Window* const window = SDL_GetWindowFromID(1);
    REQUIRE(window != nullptr);
    hands.key(SDLK_F11);
    CHECK((SDL_GetWindowFlags(window) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0);
    hands.key(SDLK_F11);
    CHECK((SDL_GetWindowFlags(window) & SDL_WINDOW_FULLSCREEN_DESKTOP) == 0);
    hands.key(SDLK_q);
    CHECK_FALSE(hands.interface().running);
}

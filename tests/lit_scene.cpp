// Scenes of files, lit: fronts and backs, mirrored nodes, alpha, uv sets; and one picture that has the same bits
// everywhere.
#include "common/lit_scene.h"
#include "common/read_environment.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/render.h"
#include "contents.h"
#include "gltf_file.h"
#include "numbers.h"
#include "relief/check/hash.h"
#include "relief/pipeline/frame.h"
#include "relief/pipeline/save.h"
#include "relief/scene/gltf.h"
#include "temporary_folder.h"

using namespace relief;
using nlohmann::json;
using relief::samples::LitScene;

namespace {

constexpr int kSide = 33;

LitScene sceneOf(const GltfFile& file)
{
    const TemporaryFolder folder;
    Expected<SceneFile> scene = readGltf(folder.write("scene.glb", file.glb()).string());
    REQUIRE_MESSAGE(scene.has_value(), scene.error().message);
    return LitScene(std::move(*scene));
}

// The scene from straight ahead: a square of 2 x 2 fills most of the picture. Linear colours, row 0 on top.
std::vector<glm::vec4> drawn(const LitScene& scene, int threads = 1,
                             const samples::Surroundings& light = samples::usualSurroundings())
{
    Expected<Framebuffer> target = Framebuffer::create(kSide, kSide, Format::rgba32f);
    REQUIRE(target.has_value());
    Frame frame(*target, {.threads = threads});
    REQUIRE(scene.record(frame, kSide, kSide, light).has_value());
    frame.run();
    return {target->color32f().begin(), target->color32f().end()};
}
std::vector<glm::vec4> drawnFrom(const GltfFile& file, float z)
{
    LitScene scene = sceneOf(file);
    scene.lookFrom({.position = {0, 0, z}});
    return drawn(scene);
}

glm::vec4 at(const std::vector<glm::vec4>& picture, int x, int y)
{
    return picture[static_cast<std::size_t>(y * kSide + x)];
}
glm::vec4 middle(const std::vector<glm::vec4>& picture)
{
    return at(picture, kSide / 2, kSide / 2);
}

// A picture of two texels above two others.
std::string png2x2(const std::vector<std::uint8_t>& rgba)
{
    const TemporaryFolder folder;
    REQUIRE(writePng((folder / "a.png").string(), 2, 2, rgba).has_value());
    return contents(folder / "a.png");
}

GltfFile squareWithPicture(const std::vector<std::uint8_t>& rgba)
{
    GltfFile file = GltfFile::square();
    file.json["images"] = {{{"bufferView", file.view(png2x2(rgba))}}};
    file.json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9728}}};
    file.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    return file;
}

const std::vector<std::uint8_t> kCorners = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
const glm::vec4 kRed(1, 0, 0, 1), kGreen(0, 1, 0, 1), kBlue(0, 0, 1, 1), kWhite(1);

json unlit()
{
    return {{"extensions", {{"KHR_materials_unlit", json::object()}}}};
}

}  // namespace

TEST_CASE("lit scene: a picture stands upright, and an unlit colour is as it is")
{
    GltfFile file = squareWithPicture(kCorners);
    json material = unlit();
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    file.setMaterial(material);
    const std::vector<glm::vec4> picture = drawnFrom(file, 3.0f);
    CHECK(at(picture, 10, 10) == kRed);
    CHECK(at(picture, 22, 10) == kGreen);
    CHECK(at(picture, 10, 22) == kBlue);
    CHECK(at(picture, 22, 22) == kWhite);
    CHECK(at(picture, 0, 0) == samples::kBackground);
}

TEST_CASE("lit scene: a node that mirrors keeps its fronts, and mirrors the picture")
{
    GltfFile file = squareWithPicture(kCorners);
    json material = unlit();
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    file.setMaterial(material);
    file.json["nodes"][0]["scale"] = {-1, 1, 1};
    const std::vector<glm::vec4> picture = drawnFrom(file, 3.0f);
    CHECK(at(picture, 10, 10) == kGreen);
    CHECK(at(picture, 22, 22) == kBlue);
}

TEST_CASE("lit scene: backs are culled, unless the material has two sides, and are lit by their own normal")
{
    GltfFile file = GltfFile::square();
    file.setMaterial({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    CHECK(middle(drawnFrom(file, -3.0f)) == samples::kBackground);
    file.json["materials"][0]["doubleSided"] = true;
    const glm::vec4 back = middle(drawnFrom(file, -3.0f)), front = middle(drawnFrom(file, 3.0f));
    file.json["materials"][0]["doubleSided"] = false;
    CHECK(middle(drawnFrom(file, 3.0f)) == front);
    // What shows from behind is a square that is turned round.
    file.json["nodes"][0]["rotation"] = {0, 1, 0, 0};
    const glm::vec4 turned = middle(drawnFrom(file, -3.0f));
    for (int i = 0; i < 3; ++i) CHECK(back[i] == doctest::Approx(turned[i]).epsilon(1e-5));
    CHECK(back.x < front.x);  // the sun is in front
}

TEST_CASE("lit scene: a normal map's green is up, on mirrored nodes too")
{
    // Normals that lean up, (0, 0.6, 0.8), against a square that leans back by as much.
    GltfFile file = squareWithPicture({128, 204, 230, 255, 128, 204, 230, 255, 128, 204, 230, 255, 128, 204, 230, 255});
    file.setMaterial({{"normalTexture", {{"index", 0}}}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    const glm::vec4 up = middle(drawnFrom(file, 3.0f));
    file.json["nodes"][0]["scale"] = {-1, 1, 1};
    const glm::vec4 mirrored = middle(drawnFrom(file, 3.0f));
    file.json["nodes"][0]["scale"] = {1, -1, 1};
    const glm::vec4 upsideDown = middle(drawnFrom(file, 3.0f));
    GltfFile tilted = GltfFile::square();
    tilted.primitive()["attributes"]["NORMAL"] =
        tilted.accessor<float>("VEC3", {0, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f});
    tilted.setMaterial({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    const glm::vec4 expected = middle(drawnFrom(tilted, 3.0f));
    for (int i = 0; i < 3; ++i) {
        CHECK(up[i] == doctest::Approx(expected[i]).epsilon(0.01));
        CHECK(mirrored[i] == doctest::Approx(expected[i]).epsilon(0.01));
    }
    CHECK(upsideDown.x < up.x - 0.05f);  // leans down, away from sun and sky
    file.json["nodes"][0].erase("scale");
    file.json["materials"][0]["normalTexture"]["scale"] = 0;
    tilted.primitive()["attributes"]["NORMAL"] = tilted.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    CHECK(middle(drawnFrom(file, 3.0f)) == middle(drawnFrom(tilted, 3.0f)));
}

TEST_CASE("lit scene: masked, blended and vertex colours")
{
    GltfFile file = squareWithPicture({255, 0, 0, 255, 255, 0, 0, 127, 255, 0, 0, 128, 255, 0, 0, 0});
    json material = unlit();
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    material["alphaMode"] = "MASK";
    file.setMaterial(material);
    std::vector<glm::vec4> picture = drawnFrom(file, 3.0f);
    CHECK(at(picture, 10, 10) == kRed);
    CHECK(at(picture, 22, 10) == samples::kBackground);
    CHECK(at(picture, 10, 22) == kRed);
    file.json["materials"][0]["alphaMode"] = "OPAQUE";
    CHECK(at(drawnFrom(file, 3.0f), 22, 10) == kRed);
    file.json["materials"][0]["alphaMode"] = "BLEND";
    picture = drawnFrom(file, 3.0f);
    CHECK(at(picture, 22, 22) == samples::kBackground);
    CHECK(at(picture, 22, 10).x == doctest::Approx(127.0f / 255.0f + samples::kBackground.x * 128.0f / 255.0f));

    GltfFile colored = GltfFile::square();
    colored.setMaterial(unlit());
    colored.primitive()["attributes"]["COLOR_0"] =
        colored.accessor<float>("VEC3", {0, 0.5f, 1, 0, 0.5f, 1, 0, 0.5f, 1, 0, 0.5f, 1});
    CHECK(middle(drawnFrom(colored, 3.0f)) == glm::vec4(0, 0.5f, 1, 1));
}

TEST_CASE("lit scene: what is blended is drawn from the farthest to the nearest")
{
    GltfFile file = GltfFile::square();
    json near = unlit();
    near["alphaMode"] = "BLEND";
    json far = near;
    near["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0, 0, 0.5};
    far["pbrMetallicRoughness"]["baseColorFactor"] = {0, 1, 0, 1};
    json second = file.json["meshes"][0];
    second["primitives"][0]["material"] = 1;
    file.setMaterial(near);
    file.json["materials"].push_back(far);
    file.json["meshes"].push_back(second);
    file.json["nodes"] = {{{"mesh", 0}, {"translation", {0, 0, 0.25}}}, {{"mesh", 1}}};
    CHECK(glm::vec3(middle(drawnFrom(file, 3.0f))) == glm::vec3(0.5f, 0.5f, 0));
}

TEST_CASE("lit scene: a rough white square in the open, in numbers")
{
    // Metal or not, emission is added; occlusion takes light of the sky and none of the sun.
    GltfFile file = squareWithPicture({0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255});
    file.setMaterial({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    const glm::vec4 plain = middle(drawnFrom(file, 3.0f));
    file.json["materials"][0]["emissiveFactor"] = {0.25, 0, 0};
    CHECK(middle(drawnFrom(file, 3.0f)).x == doctest::Approx(plain.x + 0.25f));
    file.json["materials"][0].erase("emissiveFactor");
    file.json["materials"][0]["occlusionTexture"] = {{"index", 0}, {"strength", 0.5}};  // red is 0: half of the sky
    const glm::vec4 half = middle(drawnFrom(file, 3.0f));
    file.json["materials"][0]["occlusionTexture"]["strength"] = 1;
    const glm::vec4 none = middle(drawnFrom(file, 3.0f));
    CHECK(half.y == doctest::Approx((plain.y + none.y) / 2));
    CHECK(none.y > 0.2f);
    CHECK(none.y < plain.y - 0.1f);
}

TEST_CASE("lit scene: the file's camera, and one that sees all of it")
{
    GltfFile file = GltfFile::square();
    file.setMaterial(unlit());
    file.json["nodes"][0]["scale"] = {100, 100, 100};
    std::vector<glm::vec4> picture = drawn(sceneOf(file));
    CHECK(middle(picture) == kWhite);
    for (int i = 0; i < kSide; ++i) {
        for (const glm::vec4& edge :
             {at(picture, i, 0), at(picture, i, kSide - 1), at(picture, 0, i), at(picture, kSide - 1, i)}) {
            CHECK(edge == samples::kBackground);
        }
    }
    // 90 degrees from 200 away: half of the picture's width and height.
    file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.5707963267948966}, {"znear", 1}}}}};
    file.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 200}}});
    picture = drawn(sceneOf(file));
    for (int x = 0; x < kSide; ++x) {
        CHECK((at(picture, x, kSide / 2) == kWhite) == (x >= kSide / 4 && x <= kSide - 1 - kSide / 4));
    }
}

TEST_CASE("lit scene: the same bits for any number of lanes and threads")
{
    GltfFile file = squareWithPicture({128, 128, 255, 255, 200, 128, 230, 255, 128, 200, 230, 255, 90, 90, 220, 128});
    file.setMaterial({{"normalTexture", {{"index", 0}, {"scale", 0.75}}},
                      {"pbrMetallicRoughness",
                       {{"baseColorTexture", {{"index", 0}}},
                        {"metallicRoughnessTexture", {{"index", 0}}},
                        {"baseColorFactor", {0.9, 0.8, 0.7, 1}}}},
                      {"alphaMode", "BLEND"},
                      {"doubleSided", true}});
    json second = file.json["meshes"][0];
    second["primitives"][0].erase("material");
    second["primitives"][0]["attributes"].erase("NORMAL");
    file.json["meshes"].push_back(second);
    file.json["nodes"] = {{{"mesh", 0}, {"scale", {-1, 1, 1}}},
                          {{"mesh", 1}, {"rotation", {0.6, 0, 0, 0.8}}, {"translation", {0.5, -0.5, -0.5}}}};
    const LitScene scene = sceneOf(file);
    for (const int threads : {1, 3}) {
        Expected<Framebuffer> target = Framebuffer::create(160, 90, Format::rgba32f);
        REQUIRE(target.has_value());
        Frame frame(*target, {.threads = threads});
        REQUIRE(scene.record(frame, 160, 90, samples::usualSurroundings()).has_value());
        frame.run();
        CHECK(hexadecimal(hashOf(*target)) == "3d0e2e555fa21555");
    }
}

// --- shadows and surroundings ---

namespace {

// A matte square, and a small one before it whose shadow falls to the lower right of who looks along -z.
LitScene twoSquares(const char* alphaMode)
{
    GltfFile file = GltfFile::square();
    file.setMaterial({{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {1, 1, 1, 0.75}}}},
                      {"alphaMode", alphaMode}});
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 0.5}}, {"scale", {0.2, 0.2, 0.2}}});
    LitScene scene = sceneOf(file);
    scene.lookFrom({.position = {0, 0, 3}});
    return scene;
}

}  // namespace

TEST_CASE("lit scene: what the sun does not see is in shadow, and everything else is as bright as before")
{
    for (const char* alphaMode : {"OPAQUE", "MASK", "BLEND"}) {
        CAPTURE(alphaMode);
        const LitScene scene = twoSquares(alphaMode);
        samples::Surroundings light = samples::usualSurroundings();
        const std::vector<glm::vec4> without = drawn(scene, 1, light);
        const Expected<samples::SunShadow> shadow = scene.shadowOf(light.sun.dir, 1);
        REQUIRE(shadow.has_value());
        light.shadow = &*shadow;
        const std::vector<glm::vec4> with = drawn(scene, 1, light), again = drawn(scene, 2, light);
        CHECK(with == again);
        // The middle of the shadow: the small square's middle, moved by 0.5 / 0.55 of the sun's direction.
        const bool casts = std::string(alphaMode) != "BLEND";
        CHECK((at(with, 25, 29).x < 0.6f * at(without, 25, 29).x) == casts);
        int darker = 0, brighter = 0;
        for (std::size_t i = 0; i < with.size(); ++i) {
            darker += with[i].x < without[i].x;
            brighter += with[i].x > without[i].x;
        }
        CHECK(brighter == 0);
        if (casts) CHECK((darker > 9 && darker < 60));  // 0.4 of 2.4 units each way, and soft edges
        if (!casts) CHECK(darker == 0);
    }
}

TEST_CASE("lit scene: surroundings that are the same everywhere light a mirror and a matte surface alike")
{
    const TemporaryFolder folder;
    const std::string path = (folder / "grey.png").string();
    const std::vector<std::uint8_t> pixels(std::size_t{64} * 32 * 4, 188);
    REQUIRE(writePng(path, 64, 32, pixels).has_value());
    const Expected<samples::Environment> grey = samples::readEnvironment(path, 1);
    REQUIRE_MESSAGE(grey.has_value(), grey.error().message);
    CHECK(grey->mirrored.levelCount() > 3);
    samples::Surroundings light = samples::usualSurroundings();
    light.sun.color = float3(0.0f);
    light.sky = grey->irradiance;
    light.mirrored = &grey->mirrored;
    const float radiance = srgbToLinear(std::uint8_t{188});
    for (const float metallic : {0.0f, 1.0f}) {
        GltfFile file = GltfFile::square();
        file.setMaterial({{"pbrMetallicRoughness", {{"metallicFactor", metallic}, {"roughnessFactor", 0.0f}}}});
        LitScene scene = sceneOf(file);
        scene.lookFrom({.position = {0, 0, 3}});
        CHECK(middle(drawn(scene, 1, light)).x == doctest::Approx(radiance).epsilon(0.01));
    }
    CHECK_FALSE(samples::readEnvironment((folder / "none.hdr").string(), 1).has_value());
    REQUIRE(writePng(path, 50, 32, std::vector<std::uint8_t>(std::size_t{50} * 32 * 4, 1)).has_value());
    const Expected<samples::Environment> odd = samples::readEnvironment(path, 1);
    REQUIRE_FALSE(odd.has_value());
    CHECK(odd.error().message.starts_with(path));
    CHECK(odd.error().message.find('\n') == std::string::npos);
}

// --- the file's own lights ---

namespace {

// A rough white square that faces +z, and one light over it; how bright the middle is without any sky.
struct LitSquare
{
    GltfFile file = GltfFile::square();

    explicit LitSquare(const json& light, const json& node = json::object())
    {
        file.setMaterial({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
        file.json["extensions"]["KHR_lights_punctual"]["lights"] = json::array({light});
        file.json["nodes"].push_back(node);
        file.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    }
    std::vector<glm::vec4> picture(float sky = 0.0f) const
    {
        LitScene scene = sceneOf(file);
        scene.lookFrom({.position = {0, 0, 3}});
        samples::Surroundings day = samples::usualSurroundings();
        day.sky = samples::clearSky(sky);
        return drawn(scene, 1, scene.lightOf(day));
    }
    glm::vec4 middle() const { return ::middle(picture()); }
};

json at(double x, double y, double z)
{
    return {{"translation", {x, y, z}}};
}

// The same square under a sun of this strength, straight from the front.
glm::vec4 underSun(float strength)
{
    GltfFile file = GltfFile::square();
    file.setMaterial({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    LitScene scene = sceneOf(file);
    scene.lookFrom({.position = {0, 0, 3}});
    return middle(drawn(scene, 1, {.sun = {float3(strength), float3(0, 0, 1)}, .sky = samples::clearSky(0.0f)}));
}

}  // namespace

TEST_CASE("lit scene: pi lux from the front are a sun of 1, and so are 4 pi candela from 2 metres")
{
    const glm::vec4 one = underSun(1.0f);
    CHECK(one.x > 0.9f);
    const auto isOne = [&](const glm::vec4& color) {
        for (int i = 0; i < 3; ++i) CHECK(color[i] == doctest::Approx(one[i]).epsilon(1e-5));
    };
    isOne(LitSquare({{"type", "directional"}, {"intensity", kPi}}, at(5, 6, 7)).middle());
    isOne(LitSquare({{"type", "point"}, {"intensity", kPi}}, at(0, 0, 1)).middle());
    isOne(LitSquare({{"type", "point"}, {"intensity", 4 * kPi}}, at(0, 0, 2)).middle());
    isOne(LitSquare({{"type", "spot"}, {"intensity", 4 * kPi}, {"spot", json::object()}}, at(0, 0, 2)).middle());
    // Distances are the file's, however large its scene is.
    LitSquare large({{"type", "point"}, {"intensity", 400 * kPi}}, at(0, 0, 20));
    large.file.json["nodes"][0]["scale"] = {50, 50, 50};
    isOne(large.middle());
    const glm::vec4 half =
        LitSquare({{"type", "point"}, {"color", {0.5, 1, 0}}, {"intensity", kPi}}, at(0, 0, 1)).middle();
    CHECK(half.x == doctest::Approx(one.x / 2).epsilon(1e-5));
    CHECK(half.y == doctest::Approx(one.y).epsilon(1e-5));
    CHECK(half.z == 0.0f);
    // Light from behind, or turned round, is none.
    CHECK(LitSquare({{"type", "point"}, {"intensity", kPi}}, at(0, 0, -1)).middle().x == 0.0f);
    json turned = at(0, 0, 2);
    turned["rotation"] = {0, 1, 0, 0};
    CHECK(LitSquare({{"type", "spot"}, {"spot", json::object()}}, turned).middle().x == 0.0f);
    CHECK(LitSquare({{"type", "directional"}}, turned).middle().x == 0.0f);
}

TEST_CASE("lit scene: a light's range fades it out by 1 - (d / range)^4")
{
    const float one = underSun(1.0f).x;
    const auto atRange = [&](double range) {
        return LitSquare({{"type", "point"}, {"intensity", kPi}, {"range", range}}, at(0, 0, 1)).middle().x / one;
    };
    CHECK(atRange(2.0) == doctest::Approx(15.0 / 16.0).epsilon(1e-5));
    CHECK(atRange(1.25) == doctest::Approx(1.0 - std::pow(0.8, 4)).epsilon(1e-5));
    CHECK(atRange(1.0) == 0.0f);
    CHECK(atRange(0.5) == 0.0f);
    CHECK(atRange(1e30) == doctest::Approx(1.0).epsilon(1e-5));
}

TEST_CASE("lit scene: a spot is as bright as a point within its inner angle, dark beyond the outer, squared between")
{
    const auto part = [](double angle, double inner, double outer) {
        const json node = at(std::sin(angle), 0, std::cos(angle));
        const json cone = {{"innerConeAngle", inner}, {"outerConeAngle", outer}};
        return LitSquare({{"type", "spot"}, {"spot", cone}}, node).middle().x /
               LitSquare({{"type", "point"}}, node).middle().x;
    };
    CHECK(part(0.1, 0.2, 0.6) == doctest::Approx(1.0).epsilon(1e-5));
    CHECK(part(0.7, 0.2, 0.6) == 0.0f);
    for (const double angle : {0.3, 0.4, 0.5}) {
        const double t = (std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
        CHECK(part(angle, 0.2, 0.6) == doctest::Approx(t * t).epsilon(1e-4));
    }
}

TEST_CASE("lit scene: a file's lights stand where they are in the file, and the sky stays")
{
    const LitSquare right({{"type", "point"}, {"intensity", 1}}, at(0.8, 0, 0.3));
    const std::vector<glm::vec4> picture = right.picture();
    CHECK(at(picture, 22, 16).x > 4.0f * at(picture, 10, 16).x);
    CHECK(at(right.picture(1.0f), 10, 16).x > at(picture, 10, 16).x + 0.1f);
    // The first directional light is the sun, and casts the shadow; the others are added to it.
    LitSquare two({{"type", "directional"}, {"intensity", kPi}}, at(0, 0, 0));
    const float one = two.middle().x;
    two.file.json["nodes"].push_back(two.file.json["nodes"][1]);
    CHECK(two.middle().x == doctest::Approx(2.0f * one).epsilon(1e-5));
    const LitScene scene = sceneOf(two.file);
    const samples::Surroundings light = scene.lightOf(samples::usualSurroundings());
    CHECK(light.lamps.size() == 1);
    CHECK(light.sun.dir.z[0] == 1.0f);
}

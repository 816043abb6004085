#include "common/uniforms.h"

#include <doctest/doctest.h>

#include "common/render.h"
#include "pipeline_fixture.h"
#include "relief/shading/environment.h"
#include "relief/texture/image.h"
#include "temporary_folder.h"

namespace {

using namespace relief;
using namespace fixture;
using namespace relief::samples;

struct Material : Uniforms
{
    float4 tint = rgba("tint", {1.0f, 0.5f, 0.25f, 1.0f}, "a colour");
    Float size = number("size", 2.0f, {0, 4}, "a number");
    sampler2D mainTex = albedo(kNone);
};

struct Program : Material
{
    float size = number("size", 3.0f, {1, 8}, "another number");
    bool on = toggle("on", true, "a toggle");
    int which = choice("which", 1, {"first", "second"}, "a choice");
    glm::vec3 direction = vector("direction", glm::vec3(0, 1, 0), {-1, 1}, "a vector");
    sampler2D mainTex = albedo("marble-albedo.png");
    sampler2D bumps = normals("marble-heights.png", normalMapSettings(0.2f));
};

Stage stageOf(void (*draw)(const Scene&))
{
    Stage stage{.title = "test", .uniforms = declared<Program>(), .mesh = "quad", .draw = draw};
    stage.id = "9.99";
    return stage;
}

std::string problemOf(const Stage& stage, const std::vector<std::string>& settings = {})
{
    const Expected<PreparedStage> prepared = PreparedStage::prepare(stage, settings);
    if (!prepared) return prepared.error().message;
    Framebuffer target = makeTarget(8, 8);
    Frame frame(target, {1, kDefaultTileSize});
    prepared->record(frame, 8, 8);
    return prepared->problem(frame);
}

}  // namespace

TEST_CASE("uniforms: what fields declare is a list, in their order, and a struct can change its base's")
{
    const Declared all = declared<Material, Program>().list();
    REQUIRE(all.properties.size() == 5);
    CHECK(all.properties[0].name == "tint");
    CHECK(all.properties[0].kind == Property::Kind::color);
    CHECK(all.properties[0].components == 4);
    CHECK(all.properties[0].value == glm::vec4(1.0f, 0.5f, 0.25f, 1.0f));
    CHECK(all.properties[1].name == "size");
    CHECK(all.properties[1].value.x == 3.0f);
    CHECK(all.properties[1].minimum == 1.0f);
    CHECK(all.properties[1].maximum == 8.0f);
    CHECK(all.properties[1].meaning == "another number");
    CHECK(all.properties[2].kind == Property::Kind::toggle);
    CHECK(all.properties[3].choices == std::vector<std::string>{"first", "second"});
    CHECK(all.properties[3].maximum == 1.0f);
    CHECK(all.properties[4].components == 3);

    const auto& textures = all.inputs.textures;
    CHECK(textures[TextureSlot::albedo].file == "marble-albedo.png");
    CHECK(textures[TextureSlot::height].file.empty());
    CHECK(textures[TextureSlot::normal].settings == normalMapSettings(0.2f));
}

TEST_CASE("uniforms: a program's fields have the values that the user gives")
{
    static int drawn = 0;
    const Stage stage = stageOf([](const Scene& s) {
        const Program p = s.uniforms(translation({1, 2, 3}));
        CHECK(p.size == 4.5f);
        CHECK(!p.on);
        CHECK(p.which == 0);
        CHECK(p.direction == glm::vec3(0, 0.5f, 1));
        CHECK(p.tint.y[0] == 0.5f);
        CHECK(p.mainTex.texture != &Texture::white());
        CHECK(p.Material::mainTex.texture == p.mainTex.texture);
        CHECK(p.object.worldFromObject.columns[3].y[0] == 2.0f);
        CHECK(p.worldSpaceCameraPos.z[0] == -1.5f);
        ++drawn;
    });
    CHECK(problemOf(stage, {"size=4.5", "on=0", "which=0", "direction=0,0.5,1"}) == "");
    CHECK(drawn == 1);
}

TEST_CASE("uniforms: a toggle and a choice are whole numbers, and the error names what there is")
{
    const Stage stage = stageOf([](const Scene&) {});
    CHECK(problemOf(stage, {"on=0.5"}) == "--set on=0.5: on is one of 0 (off), 1 (on)");
    CHECK(problemOf(stage, {"which=0.5"}) == "--set which=0.5: which is one of 0 (first), 1 (second)");
    CHECK(problemOf(stage, {"which=2"}) == "--set which=2: 2 is outside the range of which, 0 to 1");
}

TEST_CASE("uniforms: a struct that the stage does not list is an error")
{
    struct Forgotten : Uniforms
    {
        float left = number("left", 1.0f, {0, 1}, "out");
    };
    const Stage stage = stageOf([](const Scene& s) { CHECK(Forgotten(s.uniforms()).left == 1.0f); });
    CHECK(problemOf(stage) ==
          "uniform 'left' is of a struct that the stage does not list: add it to .uniforms = declared<...>()");
}

TEST_CASE("uniforms: every stage lists what its programs declare")
{
    for (const Stage& stage : allStages()) {
        CAPTURE(stage.id);
        CHECK(problemOf(stage) == "");
    }
}

TEST_CASE("uniforms: surroundings, masks and emission are inputs like others")
{
    struct Mirror : Uniforms
    {
        samplerCUBE sharp = radiance();
        samplerCUBE rough = reflections();
        SphericalHarmonics matte = irradiance();
        sampler2D maskMap = mask(kNone);
        sampler2D emissionMap = emission(kNone);
    };
    Stage stage{.title = "test", .uniforms = declared<Mirror>(), .mesh = "quad", .draw = [](const Scene&) {}};
    CHECK(stage.inputs().textures[TextureSlot::environment].file == "courtyard");
    CHECK(stage.inputs().textures[TextureSlot::mask].file == kNone);

    stage.draw = [](const Scene& s) {
        const Mirror mirror = s.uniforms();
        CHECK(mirror.sharp.texture->side() == 256);
        CHECK(mirror.rough.texture->levelCount() == prefilteredLevelCount(mirror.rough.texture->side()));
        CHECK(mirror.emissionMap.texture == &Texture::black());
        CHECK(mirror.maskMap.texture == &Texture::white());
        // The sky is blue above, and matte light comes from there.
        const float4 above = texCUBElod(mirror.sharp, {Float(0.0f), Float(1.0f), Float(0.0f), Float(0.0f)});
        CHECK(above.z[0] > above.x[0]);
        CHECK(ShadeSH9(mirror.matte, float3(0, 1, 0)).z[0] > ShadeSH9(mirror.matte, float3(0, -1, 0)).z[0]);
    };
    CHECK(problemOf(stage) == "");

    const auto drawn = [&stage](const std::string& environment) {
        InputFiles files;
        files.textures[TextureSlot::environment] = environment;
        const Expected<PreparedStage> prepared = PreparedStage::prepare(stage, {}, files);
        if (!prepared) return prepared.error().message;
        Framebuffer target = makeTarget(8, 8);
        Frame frame(target, {1, kDefaultTileSize});
        prepared->record(frame, 8, 8);
        return prepared->problem(frame);
    };
    stage.draw = [](const Scene& s) {
        const Mirror mirror = s.uniforms();
        CHECK(mirror.sharp.texture == nullptr);
        CHECK(ShadeSH9(mirror.matte, float3(0, 1, 0)).z[0] == 1.0f);
    };
    CHECK(drawn(kNone) == "");

    const TemporaryFolder folder;
    const std::string path = (folder.path / "sky.pfm").string();
    REQUIRE(writePfm(path, 32, 16, std::vector<float>(32 * 16 * 3, 0.25f)));
    stage.draw = [](const Scene& s) {
        const Mirror mirror = s.uniforms();
        CHECK(mirror.sharp.texture->side() == 8);
        CHECK(mirror.rough.texture->texel(1, 2, 3, 3).y == 0.25f);
    };
    CHECK(drawn(path) == "");
    CHECK(drawn(path + "x").find("sky.pfmx") != std::string::npos);

    Stage plain{.title = "test", .uniforms = declared<Program>(), .mesh = "quad", .draw = [](const Scene&) {}};
    InputFiles files;
    files.textures[TextureSlot::environment] = path;
    CHECK(PreparedStage::prepare(plain, {}, files).error().message.find("reads no environment") != std::string::npos);
}

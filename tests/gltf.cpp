// glTF files: conversion to the left-handed world, every kind of data and material, and one clear line for every bad
// file.
#include "relief/scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "contents.h"
#include "gltf_file.h"
#include "png16.h"
#include "relief/texture/image.h"
#include "temporary_folder.h"

using namespace relief;
using nlohmann::json;

namespace {

SceneFile read(const std::string& bytes)
{
    const TemporaryFolder folder;
    const Expected<SceneFile> scene = readGltf(folder.write("scene.glb", bytes).string());
    REQUIRE_MESSAGE(scene.has_value(), scene.error().message);
    for (const Mesh& mesh : scene->meshes) CHECK(validate(mesh).has_value());
    return *scene;
}
SceneFile read(const GltfFile& file)
{
    return read(file.glb());
}

// The message without the file's name; empty where there is none.
std::string errorOf(const std::string& bytes)
{
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("scene.glb", bytes);
    const Expected<SceneFile> scene = readGltf(path.string());
    if (scene) return "";
    const std::string& message = scene.error().message;
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.find(path.string() + ": ") == 0);
    return message.substr(path.string().size() + 2);
}
std::string errorOf(const GltfFile& file)
{
    return errorOf(file.glb());
}

// What the error is after something of a sound file has been changed.
template <class Change>
std::string errorAfter(const Change& change)
{
    GltfFile file = GltfFile::square();
    change(file);
    return errorOf(file);
}

// The vector that is out of the front of a mesh's triangle.
glm::vec3 frontOf(const Mesh& mesh, std::size_t triangle = 0)
{
    const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[3 * triangle + i]]; };
    return glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

glm::vec3 moved(const SceneInstance& instance, const glm::vec3& p)
{
    return glm::vec3(instance.worldFromObject * glm::vec4(p, 1.0f));
}

// A picture of one pixel, and of one row of 16-bit samples.
std::string png1x1(std::uint8_t r, std::uint8_t g, std::uint8_t b)
{
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> rgba = {r, g, b, 255};
    REQUIRE(writePng((folder / "a.png").string(), 1, 1, rgba).has_value());
    return contents(folder / "a.png");
}

}  // namespace

TEST_CASE("gltf: a square becomes left-handed, keeps its front and has its picture upright")
{
    const SceneFile scene = read(GltfFile::square());
    REQUIRE(scene.meshes.size() == 1);
    REQUIRE(scene.instances.size() == 1);
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.positions == std::vector<glm::vec3>{{1, -1, 0}, {-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    CHECK(mesh.uvs == std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}, {1, 1}});
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 2, 1, 2, 3, 1});
    CHECK(mesh.normals == std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
    CHECK(frontOf(mesh) == glm::vec3(0, 0, 1));
    CHECK(mesh.colors == std::vector<glm::vec4>(4, glm::vec4(1)));
    CHECK(mesh.tangents.empty());
    CHECK(!scene.instances[0].mirrored);
    CHECK(scene.bounds.low == glm::vec3(-1, -1, 0));
    CHECK(scene.bounds.high == glm::vec3(1, 1, 0));
    CHECK(scene.materials[0].metallic == 1.0f);
    CHECK(scene.notes.empty());
}

TEST_CASE("gltf: the same file as .glb, with a buffer beside it, and with a data URI")
{
    const GltfFile file = GltfFile::square();
    const std::vector<glm::vec3> expected = read(file).meshes[0].positions;
    CHECK(read(file.gltf("data:application/octet-stream;base64," + GltfFile::base64(file.bytes))).meshes[0].positions ==
          expected);
    const TemporaryFolder folder;
    folder.write("my data.bin", file.bytes);
    const Expected<SceneFile> beside = readGltf(folder.write("a.gltf", file.gltf("my%20data.bin")).string());
    REQUIRE(beside.has_value());
    CHECK(beside->meshes[0].positions == expected);
    // A file may be longer than the buffer, and not shorter.
    folder.write("long.bin", file.bytes + "more");
    const Expected<SceneFile> longer = readGltf(folder.write("a.gltf", file.gltf("long.bin")).string());
    REQUIRE(longer.has_value());
    CHECK(longer->meshes[0].positions == expected);
    folder.write("short.bin", file.bytes.substr(1));
    const Expected<SceneFile> shorter = readGltf(folder.write("a.gltf", file.gltf("short.bin")).string());
    REQUIRE(!shorter.has_value());
    CHECK(contains(shorter.error().message, "short.bin: has "));
    CHECK(contains(shorter.error().message, "buffers[0].byteLength is "));
    CHECK(contains(errorOf(file.gltf("other.bin")), "other.bin: cannot open"));
    CHECK(contains(errorOf(file.gltf("data:text/html,x")), "a data URI"));
}

TEST_CASE("gltf: strips and fans become the same triangles as a list, and what is left over is passed over")
{
    GltfFile list = GltfFile::square(), strip = list, fan = list, more = list;
    strip.primitive()["indices"] = strip.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 3});
    strip.primitive()["mode"] = 5;
    CHECK(read(list).meshes[0].indices == std::vector<std::uint32_t>{0, 2, 1, 2, 3, 1});
    CHECK(read(strip).meshes[0].indices == std::vector<std::uint32_t>{0, 2, 1, 1, 2, 3});
    fan.primitive()["indices"] = fan.accessor<std::uint32_t>("SCALAR", {1, 3, 2, 0});
    fan.primitive()["mode"] = 6;
    const Mesh mesh = read(fan).meshes[0];
    CHECK(mesh.indices == std::vector<std::uint32_t>{3, 1, 2, 2, 1, 0});
    CHECK(frontOf(mesh, 0) == glm::vec3(0, 0, 1));
    CHECK(frontOf(mesh, 1) == glm::vec3(0, 0, 1));
    more.primitive()["indices"] = more.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 2, 1});
    CHECK(read(more).meshes[0].indices.size() == 3);
    GltfFile none = GltfFile::square();
    none.primitive().erase("indices");
    CHECK(read(none).meshes[0].indices == std::vector<std::uint32_t>{0, 2, 1});
}

TEST_CASE("gltf: points and lines are left out, and said to be")
{
    GltfFile file = GltfFile::square();
    json lines = file.primitive();
    lines["mode"] = 1;
    file.json["meshes"][0]["primitives"].push_back(lines);
    const SceneFile scene = read(file);
    CHECK(scene.instances.size() == 1);
    CHECK(scene.notes == std::vector<std::string>{"points and lines are left out"});
    file.primitive()["mode"] = 0;
    CHECK(contains(errorOf(file), "has points and lines, but no triangles"));
}

TEST_CASE("gltf: without normals every triangle is flat, and normals of length zero are smooth")
{
    GltfFile file = GltfFile::square(false);
    file.primitive()["attributes"]["POSITION"] =
        file.accessor<float>("VEC3", {-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, -2});
    const Mesh mesh = read(file).meshes[0];
    REQUIRE(mesh.positions.size() == 6);
    for (std::size_t corner = 0; corner < 6; ++corner) {
        CHECK(glm::length(mesh.normals[mesh.indices[corner]] - frontOf(mesh, corner / 3)) < 1e-6f);
    }
    GltfFile zero = GltfFile::square();
    zero.primitive()["attributes"]["NORMAL"] = zero.accessor<float>("VEC3", {0, 0, 0, 0, 3, 4, 0, 0, 1, 0, 0, 1});
    CHECK(read(zero).meshes[0].normals == std::vector<glm::vec3>{{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}, {0, 0, 1}});
}

TEST_CASE("gltf: of vertices that primitives share each has those that it uses")
{
    GltfFile file = GltfFile::square();
    file.primitive()["indices"] = file.accessor<std::uint8_t>("SCALAR", {3, 2, 1});
    const Mesh mesh = read(file).meshes[0];
    CHECK(mesh.positions == std::vector<glm::vec3>{{-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    CHECK(mesh.uvs == std::vector<glm::vec2>{{1, 0}, {0, 1}, {1, 1}});
    CHECK(mesh.indices == std::vector<std::uint32_t>{2, 0, 1});
    CHECK(mesh.streams[0].floats.size() == 6);
}

TEST_CASE("gltf: tangents that a file gives are those that are made of its uvs")
{
    for (const bool mirrored : {false, true}) {
        GltfFile file = GltfFile::square();
        const std::string png = png1x1(128, 128, 255);
        file.json["images"] = {{{"bufferView", file.view(png)}, {"mimeType", "image/png"}}};
        file.json["textures"] = {{{"source", 0}}};
        file.setMaterial({{"normalTexture", {{"index", 0}, {"scale", 0.5}}}});
        // u runs along +x or -x, and up in the picture is +y: glTF's binormal, cross(+z, t) w, is +y.
        const float x = mirrored ? -1.0f : 1.0f;
        if (mirrored) {
            file.primitive()["attributes"]["TEXCOORD_0"] = file.accessor<float>("VEC2", {1, 1, 0, 1, 1, 0, 0, 0});
        }
        const Mesh made = read(file).meshes[0];
        file.primitive()["attributes"]["TANGENT"] =
            file.accessor<float>("VEC4", {x, 0, 0, x, 2 * x, 0, 0, x, x, 0, 0, x, x, 0, 0, x});
        const SceneFile scene = read(file);
        const Mesh given = scene.meshes[0];
        REQUIRE(given.tangents.size() == 4);
        CHECK(given.tangents == made.tangents);
        CHECK(given.tangents[0] == glm::vec4(-x, 0, 0, -x));
        // Our binormal points up, along +v.
        const glm::vec4 t = given.tangents[0];
        CHECK(glm::cross(given.normals[0], glm::vec3(t)) * t.w == glm::vec3(0, 1, 0));
        CHECK(scene.materials[0].hasNormalMap());
        CHECK(scene.materials[0].normalScale == 0.5f);
    }
}

TEST_CASE("gltf: tangents are made of the uv set that the normal map has")
{
    GltfFile file = GltfFile::square();
    const std::string png = png1x1(128, 128, 255);
    file.json["images"] = {{{"bufferView", file.view(png)}}};
    file.json["textures"] = {{{"source", 0}}};
    file.setMaterial({{"normalTexture", {{"index", 0}, {"texCoord", 1}}}});
    // Turned by 90 degrees: u up.
    file.primitive()["attributes"]["TEXCOORD_1"] = file.accessor<float>("VEC2", {0, 0, 0, 1, 1, 0, 1, 1});
    const Mesh mesh = read(file).meshes[0];
    CHECK(mesh.uvs[3] == glm::vec2(1, 1));
    CHECK(mesh.streams[0].floats[6] == 1.0f);
    CHECK(glm::vec3(mesh.tangents[0]) == glm::vec3(0, 1, 0));
    file.json["materials"][0]["normalTexture"]["texCoord"] = 2;
    CHECK(contains(errorOf(file), "materials[0].normalTexture.texCoord: TEXCOORD_2 is not read"));
}

TEST_CASE("gltf: nodes are multiplied from the root on, in left-handed numbers")
{
    GltfFile file = GltfFile::square();
    const double half = std::sqrt(0.5);
    file.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                          {{"mesh", 0}, {"rotation", {0, half, 0, half}}, {"scale", {2, 3, 4}}},
                          {{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}};
    const SceneFile scene = read(file);
    REQUIRE(scene.instances.size() == 2);
    CHECK(scene.meshes.size() == 1);
    // The file's corner (1, 1, 0) is ours (-1, 1, 0). Scaled: (2, 3, 0); turned by 90 degrees about y, x goes to -z:
    // (0, 3, -2); moved: (10, 3, -2); ours: (-10, 3, -2).
    CHECK(glm::length(moved(scene.instances[0], {-1, 1, 0}) - glm::vec3(-10, 3, -2)) < 1e-5f);
    // (1, 1, 0) -> (-1, 1, 0) + (5, 6, 7).
    CHECK(glm::length(moved(scene.instances[1], {-1, 1, 0}) - glm::vec3(-4, 7, 7)) < 1e-5f);
    CHECK(scene.bounds.high.y == 7.0f);
}

TEST_CASE("gltf: a node that mirrors says so")
{
    GltfFile file = GltfFile::square();
    file.json["nodes"] = {{{"mesh", 0}, {"scale", {-1, 1, 1}}},
                          {{"mesh", 0}, {"scale", {-1, -1, 1}}},
                          {{"children", {3}}, {"scale", {1, -2, 1}}},
                          {{"mesh", 0}, {"scale", {1, 1, -1}}},
                          {{"mesh", 0}, {"scale", {0, 1, 1}}}};
    const SceneFile scene = read(file);
    REQUIRE(scene.instances.size() == 4);
    const bool expected[] = {true, false, false, false};
    for (std::size_t i = 0; i < 4; ++i) CHECK(scene.instances[i].mirrored == expected[i]);
}

TEST_CASE("gltf: of several scenes the default one is read, and without any all nodes")
{
    GltfFile file = GltfFile::square();
    file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {1, 0, 0}}}};
    CHECK(read(file).instances.size() == 2);
    file.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1, 0}}}};
    CHECK(read(file).instances.size() == 1);
    file.json["scene"] = 1;
    const SceneFile scene = read(file);
    REQUIRE(scene.instances.size() == 2);
    CHECK(scene.instances[0].worldFromObject[3][0] == -1.0f);
}

TEST_CASE("gltf: numbers of every type, with a stride, and sparse")
{
    GltfFile file = GltfFile::square();
    json& attributes = file.primitive()["attributes"];
    attributes["TEXCOORD_0"] = file.accessor<std::uint8_t>("VEC2", {0, 255, 255, 255, 0, 0, 51, 0}, true);
    attributes["TEXCOORD_1"] = file.accessor<std::uint16_t>("VEC2", {0, 65535, 1, 2, 3, 4, 5, 6}, true);
    attributes["COLOR_0"] = file.accessor<std::uint8_t>("VEC3", {255, 0, 0, 0, 255, 0, 0, 0, 255, 51, 51, 51}, true);
    attributes["NORMAL"] = file.accessor<std::int8_t>("VEC3", {0, 0, 127, 0, 127, 0, -127, 0, 0, -128, 0, 0}, true);
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    // Positions between other numbers: 16 bytes a vertex; the third is replaced.
    const std::vector<float> wide = {-1, -1, 0, 9, 1, -1, 0, 9, 7, 7, 7, 9, 1, 1, 0};
    const std::vector<std::uint16_t> place = {2};
    const std::vector<float> value = {-1, 1, 0};
    const int positions = file.view(wide.data(), wide.size() * 4);
    file.json["bufferViews"][static_cast<std::size_t>(positions)]["byteStride"] = 16;
    const int places = file.view(place.data(), 2), values = file.view(value.data(), 12);
    file.json["accessors"].push_back({{"bufferView", positions},
                                      {"componentType", 5126},
                                      {"count", 4},
                                      {"type", "VEC3"},
                                      {"sparse",
                                       {{"count", 1},
                                        {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", values}}}}}});
    attributes["POSITION"] = static_cast<int>(file.json["accessors"].size()) - 1;
    const Mesh mesh = read(file).meshes[0];
    CHECK(mesh.positions == read(GltfFile::square()).meshes[0].positions);
    CHECK(mesh.uvs[3] == glm::vec2(0.2f, 1.0f));
    CHECK(mesh.streams[0].floats[1] == 0.0f);
    CHECK(mesh.streams[0].floats[2] == 1.0f / 65535.0f);
    CHECK(mesh.colors[1] == glm::vec4(0, 1, 0, 1));
    CHECK(mesh.colors[3] == glm::vec4(0.2f, 0.2f, 0.2f, 1));
    CHECK(mesh.normals[2] == glm::vec3(1, 0, 0));
    CHECK(mesh.normals[3] == glm::vec3(1, 0, 0));

    // Sparse numbers that stand among zeros.
    json& sparse = file.json["accessors"].back();
    sparse.erase("bufferView");
    CHECK(read(file).meshes[0].positions[0] == glm::vec3(0));
    CHECK(read(file).meshes[0].positions[2] == glm::vec3(1, 1, 0));
}

TEST_CASE("gltf: materials")
{
    GltfFile file = GltfFile::square();
    const std::string png = png1x1(255, 0, 0), wide = png16(2, 1, {1, 65535});
    file.json["images"] = {{{"bufferView", file.view(png)}},
                           {{"uri", "data:image/png;base64," + GltfFile::base64(wide)}}};
    file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"minFilter", 9729}, {"magFilter", 9729}},
                             {{"magFilter", 9728}}};
    file.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}, {"sampler", 1}}, {{"source", 0}}};
    file.json["extensionsUsed"] = {"KHR_materials_emissive_strength", "KHR_texture_transform", "KHR_materials_ior"};
    file.setMaterial({{"pbrMetallicRoughness",
                       {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}},
                        {"metallicFactor", 0.25},
                        {"roughnessFactor", 0.5},
                        {"baseColorTexture", {{"index", 0}}},
                        {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}}}},
                      {"occlusionTexture", {{"index", 2}, {"strength", 0.5}}},
                      {"emissiveTexture", {{"index", 2}}},
                      {"emissiveFactor", {1, 0.5, 0}},
                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}},
                      {"alphaMode", "MASK"},
                      {"alphaCutoff", 0.25},
                      {"doubleSided", true}});
    const SceneFile scene = read(file);
    REQUIRE(scene.materials.size() == 1);
    const SceneMaterial& m = scene.materials[0];
    CHECK(m.baseColor == glm::vec4(0.5f, 0.25f, 0.125f, 0.75f));
    CHECK(m.metallic == 0.25f);
    CHECK(m.roughness == 0.5f);
    CHECK(m.emissive == glm::vec3(4, 2, 0));
    CHECK(m.occlusionStrength == 0.5f);
    CHECK(m.alpha == SceneMaterial::Alpha::mask);
    CHECK(m.alphaCutoff == 0.25f);
    CHECK(m.twoSided);
    CHECK(!m.unlit);
    CHECK(!m.hasNormalMap());
    CHECK(m.metallicRoughnessTexture.uvSet == 1);
    CHECK(scene.notes == std::vector<std::string>{"the extension KHR_materials_ior is left out"});

    const sampler2D& base = m.baseColorTexture.sampler;
    CHECK(base.u == AddressMode::clamp);
    CHECK(base.v == AddressMode::mirror);
    CHECK(base.filter == Filter::bilinear);
    CHECK(!base.mipmaps);
    CHECK(m.metallicRoughnessTexture.sampler.filter == Filter::nearest);
    CHECK(m.metallicRoughnessTexture.sampler.mipmaps);
    CHECK(m.emissiveTexture.sampler.filter == Filter::trilinear);

    // One texture for each picture and meaning: sRGB for colours, 16 bits as they are.
    CHECK(scene.textures.size() == 3);
    CHECK(base.texture == m.emissiveTexture.sampler.texture);
    CHECK(base.texture != m.occlusionTexture.sampler.texture);
    CHECK(base.texture->texel(0, 0) == glm::vec4(1, 0, 0, 1));
    CHECK(m.metallicRoughnessTexture.sampler.texture->format() == TexelFormat::rgba16);
    CHECK(m.metallicRoughnessTexture.sampler.texture->texel(0, 0).x == 1.0f / 65535.0f);

    file.json["materials"][0]["alphaMode"] = "BLEND";
    file.json["materials"][0]["extensions"] = {{"KHR_materials_unlit", json::object()}};
    CHECK(read(file).materials[0].alpha == SceneMaterial::Alpha::blend);
    CHECK(read(file).materials[0].unlit);
}

TEST_CASE("gltf: a picture beside the file, and one that is not there")
{
    GltfFile file = GltfFile::square();
    file.json["images"] = {{{"uri", "a%20b.png"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.setMaterial({{"emissiveTexture", {{"index", 0}}}});
    const TemporaryFolder folder;
    folder.write("a b.png", png1x1(1, 2, 3));
    const std::string path = folder.write("scene.glb", file.glb()).string();
    REQUIRE(readGltf(path).has_value());
    std::filesystem::remove(folder / "a b.png");
    const Expected<SceneFile> missing = readGltf(path);
    REQUIRE(!missing.has_value());
    CHECK(contains(missing.error().message, path + ": images[0].uri: "));
    CHECK(contains(missing.error().message, "a b.png: cannot open"));
    // One that no material uses is not looked for.
    file.json["materials"][0].erase("emissiveTexture");
    CHECK(read(file).textures.empty());
}

TEST_CASE("gltf: a texture's transform, in our uv")
{
    GltfFile file = GltfFile::square();
    file.json["images"] = {{{"bufferView", file.view(png1x1(1, 2, 3))}}};
    file.json["textures"] = {{{"source", 0}}};
    const json transform = {{"offset", {0.5, 0.25}}, {"rotation", 1.5707963267948966}, {"scale", {2, 3}}};
    file.setMaterial({{"emissiveTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}});
    const MaterialTexture texture = read(file).materials[0].emissiveTexture;
    // The specification's matrices for a quarter turn: u' = 3 v + 0.5 and v' = -2 u + 0.25. Ours have 1 - v.
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0.25f, 0.75f)}) {
        const glm::vec3 ours(uv, 1);
        const glm::vec2 expected(3 * (1 - uv.y) + 0.5f, 1 - (-2 * uv.x + 0.25f));
        CHECK(glm::dot(texture.u, ours) == doctest::Approx(expected.x));
        CHECK(glm::dot(texture.v, ours) == doctest::Approx(expected.y));
    }
}

TEST_CASE("gltf: the first camera with perspective")
{
    GltfFile file = GltfFile::square();
    file.json["cameras"] = {
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 1}, {"zfar", 2}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.5707963267948966}, {"znear", 0.5}}}}};
    file.json["nodes"] = {{{"mesh", 0}}, {{"camera", 0}}, {{"camera", 1}, {"translation", {1, 2, 3}}}};
    const SceneFile scene = read(file);
    REQUIRE(scene.camera.has_value());
    CHECK(scene.camera->position == glm::vec3(-1, 2, 3));
    CHECK(scene.camera->forward == glm::vec3(0, 0, -1));
    CHECK(scene.camera->up == glm::vec3(0, 1, 0));
    CHECK(scene.camera->fieldOfView == doctest::Approx(90.0f));
    CHECK(scene.camera->nearPlane == 0.5f);
    CHECK(std::isinf(scene.camera->farPlane));
    CHECK(scene.notes == std::vector<std::string>{"orthographic cameras are left out"});

    const auto error = [&file](const char* name, const json& value) {
        GltfFile other = file;
        other.json["cameras"][1]["perspective"][name] = value;
        return errorOf(other);
    };
    CHECK(contains(error("yfov", 4), "cameras[1].perspective.yfov: is not 0.0018 to 3.12 radians; correct it"));
    CHECK(contains(error("yfov", 0), "cameras[1].perspective.yfov: is not"));
    CHECK(contains(error("znear", 0), "cameras[1].perspective.znear: is not"));
    CHECK(contains(error("zfar", 0.5), "cameras[1].perspective.zfar: is not more than znear"));
    CHECK(contains(error("znear", "1"), "cameras[1].perspective.znear is not a number"));
    file.json["nodes"][2]["scale"] = {1, 1, 0};
    CHECK(contains(errorOf(file), "nodes[2]: its matrix leaves its camera no direction"));
}

namespace {

// The square with these lights, each at a node of its own.
GltfFile withLights(const json& lights)
{
    GltfFile file = GltfFile::square();
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    return file;
}

}  // namespace

TEST_CASE("gltf: lights, where their nodes are, with the numbers that the extension gives to what is left out")
{
    GltfFile file =
        withLights({{{"type", "point"}},
                    {{"type", "directional"}, {"intensity", 1000}, {"color", {1, 0.5, 0}}},
                    {{"type", "spot"}, {"range", 8}, {"spot", json::object()}},
                    {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 1.5707964}}}}});
    file.json["extensionsRequired"] = {"KHR_lights_punctual"};
    file.json["nodes"][1]["translation"] = {1, 2, 3};
    file.json["nodes"][2]["rotation"] = {0, 0.7071067811865476, 0, 0.7071067811865476};  // -z becomes -x, ours +x
    file.json["nodes"][3]["scale"] = {7, 7, 7};
    const SceneFile scene = read(file);
    CHECK(scene.notes.empty());
    REQUIRE(scene.lights.size() == 4);
    const SceneLight &point = scene.lights[0], &sun = scene.lights[1], &spot = scene.lights[2];
    CHECK(point.kind == SceneLight::Kind::point);
    CHECK(point.position == glm::vec3(-1, 2, 3));
    CHECK(point.color == glm::vec3(1));
    CHECK(point.intensity == 1.0f);
    CHECK(std::isinf(point.range));
    CHECK(sun.kind == SceneLight::Kind::directional);
    CHECK(sun.intensity == 1000.0f);
    CHECK(sun.color == glm::vec3(1, 0.5f, 0));
    CHECK(glm::distance(sun.forward, glm::vec3(1, 0, 0)) < 1e-6f);
    CHECK(spot.kind == SceneLight::Kind::spot);
    CHECK(spot.forward == glm::vec3(0, 0, -1));
    CHECK(spot.range == 8.0f);
    CHECK(spot.cosInner == 1.0f);
    CHECK(spot.cosOuter == doctest::Approx(std::sqrt(0.5f)));
    CHECK(scene.lights[3].cosInner == doctest::Approx(std::cos(0.5f)));
    CHECK(scene.lights[3].cosOuter == doctest::Approx(0.0f));
    CHECK(read(GltfFile::square()).lights.empty());
}

TEST_CASE("gltf: lights with wrong values, and lights that are not there")
{
    const auto error = [](const json& light) { return errorOf(withLights(json::array({light}))); };
    const std::string light = "extensions.KHR_lights_punctual.lights[0]";
    CHECK(error({{"type", "point"}, {"intensity", 0}}).empty());
    CHECK(contains(error({{"type", "sun"}}), light + ".type: is not directional, point or spot"));
    CHECK(!error(json::object()).empty());
    CHECK(contains(error({{"type", "point"}, {"intensity", -1}}), light + ".intensity: is not a number of at least 0"));
    CHECK(contains(error({{"type", "point"}, {"intensity", 1e300}}), ".intensity"));
    CHECK(!error({{"type", "point"}, {"intensity", "bright"}}).empty());
    CHECK(contains(error({{"type", "point"}, {"range", 0}}), light + ".range: is not a number above 0"));
    CHECK(contains(error({{"type", "point"}, {"color", {1, 1}}}), light + ".color: is not three numbers of 0 to 1"));
    CHECK(contains(error({{"type", "point"}, {"color", {1, 1, 2}}}), ".color"));
    CHECK(!error({{"type", "spot"}}).empty());
    const auto cone = [&](double inner, double outer) {
        return error({{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}});
    };
    CHECK(cone(0.2, 0.4).empty());
    CHECK(contains(cone(0.4, 0.4), light + ".spot.innerConeAngle: is not less than outerConeAngle"));
    CHECK(contains(cone(-0.1, 0.4), light + ".spot.innerConeAngle: is not an angle"));
    CHECK(contains(cone(0.1, 1.6), light + ".spot.outerConeAngle: is not an angle"));

    GltfFile file = withLights(json::array({{{"type", "directional"}}}));
    for (const json& index : {json(1), json(-1), json(0.5), json("0"), json()}) {
        CAPTURE(index.dump());
        file.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = index;
        CHECK(contains(errorOf(file), "nodes[1].extensions.KHR_lights_punctual.light: "));
    }
    file.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    file.json["nodes"][1]["scale"] = {1, 1, 0};
    CHECK(contains(errorOf(file), "nodes[1]: its matrix leaves its light no direction"));
    file.json.erase("extensions");
    CHECK(!errorOf(file).empty());
    file = withLights(json::array({{{"type", "point"}}}));
    for (std::size_t i = 0; i < kMaxSceneLights; ++i) file.json["nodes"].push_back(file.json["nodes"][1]);
    CHECK(contains(errorOf(file), "more than 256 lights"));
}

TEST_CASE("gltf: names of what is not there")
{
    using File = GltfFile;
    const auto error = [](const auto& change) { return errorAfter(change); };
    CHECK(
        contains(error([](File& f) { f.json["nodes"][0]["mesh"] = 1; }), "nodes[0].mesh: there is no mesh 1 among 1"));
    CHECK(contains(error([](File& f) { f.json["nodes"][0]["camera"] = 7; }),
                   "nodes[0].camera: there is no camera 7 among 0"));
    CHECK(
        contains(error([](File& f) { f.json["nodes"][0]["skin"] = 7; }), "nodes[0].skin: there is no skin 7 among 0"));
    CHECK(contains(error([](File& f) { f.json["nodes"][0]["children"] = {7}; }),
                   "nodes[0].children: there is no node 7 among 1"));
    CHECK(contains(error([](File& f) {
                       f.json["scene"] = 0;
                       f.json["scenes"] = {{{"nodes", {3}}}};
                   }),
                   "scenes[0].nodes: there is no node 3 among 1"));
    CHECK(contains(error([](File& f) {
                       f.json["scene"] = 2;
                       f.json["scenes"] = {{{"nodes", {0}}}};
                   }),
                   "scene: there is no scene 2 among 1"));
    CHECK(contains(error([](File& f) { f.primitive()["material"] = 5; }),
                   "meshes[0].primitives[0].material: there is no material 5 among 0"));
    CHECK(contains(error([](File& f) { f.primitive()["attributes"]["NORMAL"] = 50; }),
                   "meshes[0].primitives[0].attributes.NORMAL: there is no accessor 50 among 4"));
    CHECK(contains(error([](File& f) { f.json["accessors"][0]["bufferView"] = 9; }),
                   "accessors[0].bufferView: there is no buffer view 9 among 4"));
    CHECK(contains(error([](File& f) { f.json["bufferViews"][0]["buffer"] = 1; }),
                   "bufferViews[0].buffer: there is no buffer 1 among 1"));
    const auto withTexture = [&](const char* what, const json& value) {
        return error([&](File& f) {
            f.json["images"] = {{{"bufferView", 0}}};
            f.json["samplers"] = json::array();
            f.json["textures"] = {{{"source", 0}}};
            f.json["textures"][0][what] = value;
            f.setMaterial({{"emissiveTexture", {{"index", 0}}}});
        });
    };
    CHECK(contains(withTexture("source", 4), "textures[0].source: there is no image 4 among 1"));
    CHECK(contains(withTexture("sampler", 4), "textures[0].sampler: there is no sampler 4 among 0"));
    CHECK(contains(withTexture("name", "x"), "images[0]: is not a PNG, JPEG"));
    CHECK(contains(error([](File& f) {
                       f.setMaterial({{"emissiveTexture", {{"index", 3}}}});
                   }),
                   "materials[0].emissiveTexture.index: there is no texture 3 among 0"));
}

TEST_CASE("gltf: data that is out of its bounds, or not what it should be")
{
    using File = GltfFile;
    const auto error = [](const auto& change) { return errorAfter(change); };
    const auto accessor = [&](std::size_t i, const char* what, const json& value) {
        return error([&](File& f) { f.json["accessors"][i][what] = value; });
    };
    CHECK(contains(accessor(0, "count", 5), "accessors[0]: 5 elements from byte 0 take 60 bytes"));
    CHECK(contains(accessor(0, "count", 2147483647), "POSITION: the scene has more than"));
    CHECK(contains(accessor(0, "count", 4294967296), "accessors[0].count is larger than 2147483647"));
    CHECK(contains(accessor(0, "byteOffset", 4), "accessors[0]: 4 elements from byte 4"));
    CHECK(contains(accessor(0, "byteOffset", -4), "accessors[0].byteOffset is negative"));
    CHECK(contains(accessor(0, "byteOffset", 0.5), "accessors[0].byteOffset is not an integer"));
    CHECK(contains(accessor(0, "count", "4"), "accessors[0].count is not an integer"));
    CHECK(contains(accessor(0, "type", "VEC2"), "accessors[0].type: meshes[0].primitives[0].attributes.POSITION"));
    CHECK(contains(accessor(0, "componentType", 5124), "accessors[0].componentType: there is no type 5124"));
    CHECK(contains(accessor(3, "componentType", 5122), "accessors[3].componentType: "));
    CHECK(contains(accessor(1, "count", 3), "attributes.NORMAL: has 3 elements for 4 positions"));
    CHECK(contains(accessor(3, "count", 2147483647), "indices: the scene has more than"));
    CHECK(contains(error([](File& f) { f.json["bufferViews"][0]["byteLength"] = 1000; }),
                   "bufferViews[0]: bytes 0 to 1000"));
    CHECK(
        contains(error([](File& f) { f.json["bufferViews"][1]["byteOffset"] = 2000000000; }), "bufferViews[1]: bytes"));
    CHECK(contains(error([](File& f) { f.json["bufferViews"][0]["byteStride"] = 8; }),
                   "bufferViews[0].byteStride: 8 is less than the 12 bytes"));
    CHECK(contains(error([](File& f) {
                       f.primitive()["indices"] = f.accessor<std::uint8_t>("SCALAR", {0, 1, 4});
                   }),
                   "meshes[0].primitives[0].indices: there is no vertex 4 among 4"));
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        CHECK(contains(error([&](File& f) {
                           f.primitive()["attributes"]["POSITION"] =
                               f.accessor<float>("VEC3", {-1, -1, 0, 1, bad, 0, -1, 1, 0, 1, 1, 0});
                       }),
                       "element 1 (meshes[0].primitives[0].attributes.POSITION) is not finite"));
    }
    const auto sparse = [&](int componentType) {
        return error([=](File& f) {
            const std::vector<std::uint16_t> place = {4};
            const std::vector<float> value = {0, 0, 0};
            const int p = f.view(place.data(), 2), v = f.view(value.data(), 12);
            f.json["accessors"][0]["sparse"] = {{"count", 1},
                                                {"indices", {{"bufferView", p}, {"componentType", componentType}}},
                                                {"values", {{"bufferView", v}}}};
        });
    };
    CHECK(contains(sparse(5123), "accessors[0].sparse.indices: there is no element 4 among 4"));
    for (const int other : {5120, 5122, 5126}) {
        CHECK(contains(sparse(other), "accessors[0].sparse.indices.componentType: is no unsigned integer"));
    }
    CHECK(contains(error([](File& f) { f.primitive()["mode"] = 7; }), "primitives[0].mode: there is no mode 7"));
    CHECK(contains(error([](File& f) {
                       f.json["nodes"][0]["matrix"] = {1, 2, 3};
                   }),
                   "nodes[0].matrix is not a list of 16 numbers"));
    for (const json& wrong : {json("x"), json(1), json({1, 2}), json({1, 2, "3"}), json({1, 2, {3}}), json(nullptr)}) {
        CHECK(contains(error([&](File& f) { f.json["nodes"][0]["translation"] = wrong; }), "nodes[0].translation"));
        CHECK(contains(error([&](File& f) {
                           f.setMaterial({{"pbrMetallicRoughness", {{"baseColorFactor", wrong}}}});
                       }),
                       "materials[0].pbrMetallicRoughness.baseColorFactor"));
    }
    for (const json& wrong : {json("x"), json(true), json({1}), json::object()}) {
        CHECK(contains(error([&](File& f) {
                           f.setMaterial({{"pbrMetallicRoughness", {{"metallicFactor", wrong}}}});
                       }),
                       "materials[0].pbrMetallicRoughness.metallicFactor is not a number"));
    }
    CHECK(contains(error([](File& f) {
                       f.setMaterial({{"alphaMode", "FOO"}});
                   }),
                   "materials[0].alphaMode is not OPAQUE, MASK or BLEND"));
    CHECK(contains(error([](File& f) { f.json["nodes"][0]["scale"] = {1e200, 1, 1}; }), "nodes[0]: its matrix"));
    CHECK(contains(error([](File& f) {
                       f.json["nodes"][0]["scale"] = {1e30, 1, 1};
                       f.primitive()["attributes"]["POSITION"] =
                           f.accessor<float>("VEC3", {-1e30f, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0});
                   }),
                   "nodes[0]: its mesh is moved out of the range"));
    CHECK(contains(error([](File& f) { f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
                   "extensionsRequired[0] requires KHR_draco_mesh_compression, which is not supported"));
    CHECK(contains(error([](File& f) { f.json["asset"]["version"] = "1.0"; }), "asset.version: is '1.0'"));
    CHECK(contains(error([](File& f) { f.json["nodes"] = {{"a", 1}}; }), "nodes is no list, as in glTF 1.0"));
    CHECK(contains(error([](File& f) { f.json["nodes"] = json::array(); }), "has no triangles to draw"));
}

TEST_CASE("gltf: nodes that form a cycle or have two parents")
{
    const auto error = [](const json& nodes, const json& roots) {
        return errorAfter([&](GltfFile& f) {
            f.json["nodes"] = nodes;
            f.json["scenes"] = {{{"nodes", roots}}};
        });
    };
    CHECK(contains(error({{{"children", {0}}, {"mesh", 0}}}, {0}), "node 0 is a child of another node, or of itself"));
    CHECK(contains(error({{{"children", {1}}}, {{"children", {0}}}}, {0}), "scenes[0].nodes: node 0 is a child"));
    CHECK(contains(error({{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}}, {0}),
                   "nodes[2].children: node 1 has two parents"));
    CHECK(contains(error({{{"mesh", 0}}}, {0, 0}), "node 0 stands there twice"));
    // Without scenes: none of a cycle's nodes is a root.
    CHECK(contains(errorAfter([](GltfFile& f) {
                       f.json["nodes"] = {{{"children", {0}}, {"mesh", 0}}};
                   }),
                   "has no triangles"));
    // Ten thousand generations are no problem.
    json chain = json::array();
    for (int i = 0; i < 10000; ++i) chain.push_back({{"children", {i + 1}}});
    chain.push_back({{"mesh", 0}});
    CHECK(error(chain, {0}).empty());
}

TEST_CASE("gltf: small files that ask for too much")
{
    // One mesh of a few numbers, two million times.
    GltfFile many = GltfFile::square();
    for (int i = 0; i < 2000; ++i) many.json["meshes"][0]["primitives"].push_back(many.primitive());
    for (int i = 0; i < 100; ++i) many.json["nodes"].push_back({{"mesh", 0}});
    CHECK(contains(errorOf(many), "the scene has more than 131072 primitives"));
    // Zeros that no file holds, and the triangles that strips of them make: three vertices each, for they are flat.
    constexpr std::uint32_t kMost = 5592407;  // as a strip, one vertex less than a scene may have
    const auto withStrip = [](GltfFile& f, std::uint32_t count) {
        f.json["accessors"].push_back({{"componentType", 5126}, {"count", count}, {"type", "VEC3"}});
        f.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 4}}}, {"mode", 5}});
    };
    const char* const tooLarge = "meshes[0].primitives[1]: the scene has more than 16777216 vertices";
    CHECK(contains(errorAfter([&](GltfFile& f) { withStrip(f, kMost + 1); }), tooLarge));
    CHECK(contains(errorAfter([&](GltfFile& f) {  // together with the square's four
                       withStrip(f, kMost);
                   }),
                   tooLarge));
    // Many roots.
    GltfFile roots = GltfFile::square();
    json all = json::array();
    for (int i = 0; i < 200000; ++i) {
        roots.json["nodes"].push_back(json::object());
        all.push_back(i);
    }
    roots.json["scenes"] = {{{"nodes", all}}};
    CHECK(errorOf(roots).empty());
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    CHECK(
        contains(errorOf("{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + deep + "}"), "nested more than 64 deep"));
    const std::string buffers =
        R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 1073741824}, {"byteLength": 1}]})";
    CHECK(contains(errorOf(buffers), "buffers[1].byteLength makes the buffers larger than 1 GiB"));
}

TEST_CASE("gltf: whatever is in extras and in names is no problem")
{
    GltfFile file = GltfFile::square();
    file.json["extras"] = {{"count", -1.5}, {"nodes", {{"mesh", "x"}}}, {"byteOffset", 1e300}};
    file.json["nodes"][0]["extras"] = {{"mesh", nullptr}};
    file.json["nodes"][0]["name"] = "a\nb";
    CHECK(errorOf(file).empty());
    file.json["extensionsRequired"] = {"a\nb" + std::string(10000, 'x')};
    CHECK(errorOf(file).size() < 600);
}

TEST_CASE("gltf: a .glb that is cut off anywhere, and files that are none")
{
    const std::string whole = GltfFile::square().glb();
    for (std::size_t length = 1; length < whole.size(); ++length) {
        CAPTURE(length);
        CHECK(!errorOf(whole.substr(0, length)).empty());
    }
    CHECK(contains(errorOf(whole.substr(0, whole.size() - 1)), "is truncated ("));
    CHECK(contains(errorOf("glTF" + GltfFile::word(1) + whole.substr(8)), "is a .glb of version 1"));
    CHECK(contains(errorOf("hello"), "is no JSON from byte"));
    CHECK(contains(errorOf("{\"a\": 1}"), "\"asset\" object not found"));
    CHECK(contains(errorOf("[1, 2]"), "not a JSON object; export it again"));
    const TemporaryFolder folder;
    CHECK(!readGltf((folder / "none.glb").string()).has_value());
    CHECK(!readGltf(folder.path.string()).has_value());
}

TEST_CASE("gltf: no random damage crashes the reader")
{
    const std::string square = GltfFile::square().glb();
    const json spot = {
        {"type", "spot"}, {"intensity", 9}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.7}}}};
    const json point = {{"type", "point"}, {"color", {1, 0.5, 0}}, {"range", 10}};
    const std::string lit = withLights({spot, point}).glb();
    std::uint32_t state = 1;
    const auto random = [&state](std::size_t below) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::size_t>((std::uint64_t{state} * below) >> 32);
    };
    int read = 0;
    const TemporaryFolder folder;
    for (int trial = 0; trial < 1500; ++trial) {
        std::string damaged = trial % 2 == 0 ? square : lit;
        for (std::size_t i = 0; i <= random(3); ++i) {
            damaged[random(damaged.size())] = "0129-,:\"[]{}ex\xff"[random(15)];
        }
        const Expected<SceneFile> scene = readGltf(folder.write("a.glb", damaged).string());
        if (!scene) CHECK(scene.error().message.find('\n') == std::string::npos);
        for (std::size_t i = 0; scene && i < scene->lights.size(); ++i) {
            CHECK((scene->lights[i].intensity >= 0.0f && std::isfinite(scene->lights[i].intensity)));
            CHECK(scene->lights[i].range > 0.0f);
        }
        read += scene.has_value() ? 1 : 0;
    }
    CHECK(read > 50);
}

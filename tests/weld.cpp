// Welding: equal records are found, -0 is 0; vertices split where their corners disagree, and nowhere else.
#include "relief/mesh/weld.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <doctest/doctest.h>

#include "relief/mesh/primitives.h"

using namespace relief;

TEST_CASE("weld: each record gets the first that is equal to it")
{
    const std::vector<std::array<std::uint32_t, 2>> records = {{1, 2}, {2, 1}, {1, 2}, {0, 0}, {2, 1}, {1, 2}};
    CHECK(firstEqual(records) == std::vector<std::uint32_t>{0, 1, 0, 3, 1, 0});
    CHECK(firstEqual(std::vector<std::array<std::uint32_t, 3>>{}).empty());
    CHECK(weldWord(-0.0f) == weldWord(0.0f));
    CHECK(weldWord(-1.0f) != weldWord(1.0f));
}

TEST_CASE("weld: many records give what a map gives")
{
    std::vector<std::array<std::uint32_t, 3>> records;
    for (std::uint32_t i = 0; i < 20000; ++i) records.push_back({i * i % 97, i % 31, i * 0x9e3779b1u >> 29});
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < records.size(); ++i)
        expected.push_back(known.try_emplace(records[i], i).first->second);
    CHECK(firstEqual(records) == expected);
}

TEST_CASE("weld: vertices are the same if position, normal and uv are")
{
    Mesh mesh = makeQuad();
    for (std::size_t i = 1; i < 4; ++i) {
        mesh.positions[i] = mesh.positions[0];
        mesh.uvs[i] = -mesh.uvs[0];  // -0 is 0
    }
    CHECK(firstEqualVertices(mesh) == std::vector<std::uint32_t>{0, 0, 0, 0});
    mesh.uvs[1].y = 1;
    mesh.normals[2] = {0, 0, 1};
    CHECK(firstEqualVertices(mesh) == std::vector<std::uint32_t>{0, 1, 2, 0});
}

TEST_CASE("weld: a vertex whose corners agree stays one, others are split in the order of use")
{
    Mesh mesh = makeQuad();  // indices 0 3 1 3 0 2
    mesh.colors = {glm::vec4(0.5f), glm::vec4(1), glm::vec4(1), glm::vec4(1)};
    const Mesh quad = mesh;
    const glm::vec2 a(1, 2);
    const glm::vec2 b(3, 4);
    setPerCorner(mesh, &Mesh::uvs, {a, b, a, b, b, a});
    CHECK(mesh.indices == std::vector<std::uint32_t>{0, 3, 1, 3, 4, 2});
    CHECK(mesh.uvs == std::vector<glm::vec2>{a, a, a, b, b});
    REQUIRE(mesh.positions.size() == 5);
    CHECK(mesh.positions[4] == quad.positions[0]);
    CHECK(mesh.normals[4] == quad.normals[0]);
    CHECK(mesh.tangents[4] == quad.tangents[0]);
    CHECK(mesh.colors[4] == quad.colors[0]);
}

TEST_CASE("weld: a vertex that is split takes its other streams along, and leaves those of instances alone")
{
    Mesh mesh = makeQuad();
    mesh.streams = {{"TEXCOORD", 1, 2, {0, 1, 2, 3, 4, 5, 6, 7}, {}, false},
                    {"TEXCOORD", 2, 1, {}, {10, 11, 12, 13}, false},
                    {"TEXCOORD", 3, 4, {1, 2, 3, 4}, {}, true}};
    const glm::vec2 a(1, 2), b(3, 4);
    setPerCorner(mesh, &Mesh::uvs, {a, b, a, b, b, a});  // vertex 0 is split
    CHECK(mesh.streams[0].floats == std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 0, 1});
    CHECK(mesh.streams[1].integers == std::vector<std::int32_t>{10, 11, 12, 13, 10});
    CHECK(mesh.streams[2].floats.size() == 4);
    CHECK(validate(mesh).has_value());
}

TEST_CASE("weld: vertices without a corner keep what they have, and empty streams stay empty")
{
    Mesh mesh = makeQuad();
    mesh.indices = {1, 2, 3};
    mesh.tangents.clear();
    setPerCorner(mesh, &Mesh::uvs, {{5, 5}, {6, 6}, {7, 7}});
    CHECK(mesh.uvs == std::vector<glm::vec2>{{0, 0}, {5, 5}, {6, 6}, {7, 7}});
    CHECK(mesh.tangents.empty());
    CHECK(mesh.colors.empty());
}

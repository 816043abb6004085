// Normal maps baked from geometry: vectors that are known by algebra, and what happens where nothing is to be baked.
#include "relief/mesh/bake.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "relief/mesh/primitives.h"
#include "relief/mesh/tangents.h"

using namespace relief;

namespace {

BakeOptions sized(int width, int height, float distance = 0.1f)
{
    BakeOptions options;
    options.width = width;
    options.height = height;
    options.distance = distance;
    return options;
}

// The plane z = 0.75 x over the quad: its front looks along (0.6, 0, -0.8), in the quad's frame (0.6, 0, 0.8).
Mesh tiltedQuad()
{
    Mesh mesh = makeQuad();
    for (glm::vec3& position : mesh.positions) position.z = 0.75f * position.x;
    mesh.normals.assign(4, {0.6f, 0, -0.8f});
    return mesh;
}

// Two quads side by side, which share the picture: u runs from the middle to both sides.
Mesh mirroredQuads()
{
    Mesh mesh;
    mesh.name = "mirrored";
    mesh.positions = {{-1, 0, 0}, {0, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    mesh.normals.assign(8, {0, 0, -1});
    mesh.uvs = {{1, 0}, {0, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 1}, {1, 1}};
    mesh.indices = {0, 3, 1, 3, 0, 2, 4, 7, 5, 7, 4, 6};
    return *withTangents(mesh);
}

std::size_t count(const BakedNormalMap& map, TexelState state)
{
    std::size_t found = 0;
    for (const TexelState s : map.states) found += s == state;
    return found;
}

// Vectors of unit length, as many as texels, and the counts those of the states.
void checkSound(const BakedNormalMap& map)
{
    const std::size_t texels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    REQUIRE(map.normals.size() == texels);
    REQUIRE(map.states.size() == texels);
    REQUIRE(map.triangles.size() == texels);
    REQUIRE(map.detailNormals.size() == texels);
    std::size_t bad = 0;
    for (std::size_t i = 0; i < texels; ++i) {
        bad += !(std::fabs(glm::length(map.normals[i]) - 1.0f) < 1e-6f);
        const bool isCovered = map.states[i] == TexelState::hit || map.states[i] == TexelState::missed;
        bad += isCovered != (map.triangles[i] != BakedNormalMap::kNoTriangle);
        bad += (map.states[i] == TexelState::hit) != (map.detailNormals[i] != glm::vec3(0));
        const bool isFlat = map.states[i] == TexelState::missed || map.states[i] == TexelState::background;
        bad += isFlat && map.normals[i] != glm::vec3(0, 0, 1);
    }
    CHECK(bad == 0);
    CHECK(count(map, TexelState::hit) == map.hits);
    CHECK(count(map, TexelState::missed) == map.misses);
}

std::string errorOf(const Mesh& low, const Mesh& high, const BakeOptions& options)
{
    const Expected<BakedNormalMap> map = bakeNormalMap(low, high, options);
    return map ? "" : map.error().message;
}

}  // namespace

TEST_CASE("bake: a quad under a tilted quad gets the tilt, in every texel")
{
    for (const BinormalAt at : {BinormalAt::vertex, BinormalAt::fragment}) {
        BakeOptions options = sized(16, 8, 0.5f);
        options.binormal = at;
        const Expected<BakedNormalMap> map = bakeNormalMap(makeQuad(), tiltedQuad(), options);
        REQUIRE(map.has_value());
        checkSound(*map);
        CHECK(map->hits == 16 * 8);
        float largest = 0;
        for (const glm::vec3& n : map->normals) largest = std::max(largest, glm::distance(n, {0.6f, 0, 0.8f}));
        CHECK(largest < 1e-7f);
    }
}

TEST_CASE("bake: what lies beyond the distance, on either side, is missed and counted")
{
    // |0.75 x| <= 0.1 for the 18 of 64 columns whose centres are within 8.5 of the middle.
    const Expected<BakedNormalMap> map = bakeNormalMap(makeQuad(), tiltedQuad(), sized(64, 4, 0.1f));
    REQUIRE(map.has_value());
    checkSound(*map);
    CHECK(map->hits == 18 * 4);
    CHECK(map->misses == 46 * 4);
    CHECK(map->states[22] == TexelState::missed);
    CHECK(map->states[23] == TexelState::hit);
    CHECK(map->states[40] == TexelState::hit);
    CHECK(map->states[41] == TexelState::missed);
}

TEST_CASE("bake: of several surfaces the outermost counts, and backs do not")
{
    Mesh layers = makeQuad();
    const auto add = [&](Mesh mesh, float z, glm::vec3 normal, bool turnedOver) {
        const auto first = static_cast<std::uint32_t>(layers.positions.size());
        for (glm::vec3 position : mesh.positions) {
            position.z = z;
            layers.positions.push_back(position);
            layers.normals.push_back(normal);
        }
        if (turnedOver) std::swap(mesh.indices[1], mesh.indices[2]), std::swap(mesh.indices[4], mesh.indices[5]);
        for (const std::uint32_t index : mesh.indices) layers.indices.push_back(first + index);
    };
    layers.uvs.clear();
    layers.tangents.clear();
    add(makeQuad(), -0.05f, {0, 0.6f, -0.8f}, false);
    add(makeQuad(), -0.08f, {0, -0.6f, 0.8f}, true);
    add(makeQuad(), -0.2f, {0.6f, 0, -0.8f}, false);  // too far away
    const Expected<BakedNormalMap> map = bakeNormalMap(makeQuad(), layers, sized(4, 4, 0.1f));
    REQUIRE(map.has_value());
    CHECK(map->hits == 16);
    for (const glm::vec3& n : map->normals) CHECK(glm::distance(n, {0, 0.6f, 0.8f}) < 1e-7f);
}

TEST_CASE("bake: a mesh baked from itself is flat")
{
    for (const Mesh& mesh : {*withTangents(makeSphere(24, 12)), makeCubeSphere(5)}) {
        CAPTURE(mesh.name);
        const Expected<BakedNormalMap> map = bakeNormalMap(mesh, mesh, sized(100, 60));
        REQUIRE(map.has_value());
        checkSound(*map);
        CHECK(map->misses == 0);
        CHECK(map->hits > 5000);
        float largest = 0;
        for (const glm::vec3& n : map->normals) largest = std::max(largest, glm::distance(n, {0, 0, 1}));
        CHECK(largest < 1e-6f);
    }
}

TEST_CASE("bake: mirrored halves that share the picture get the same map, whichever comes first")
{
    // A roof over the seam: both halves lean outwards, so that in each the vector leans along +u.
    const Mesh low = mirroredQuads();
    Mesh roof = low;
    for (std::size_t i = 0; i < 8; ++i) {
        roof.positions[i].z = 0.75f * std::fabs(roof.positions[i].x) - 0.3f;
        roof.normals[i] = {i < 4 ? -0.6f : 0.6f, 0, -0.8f};
    }
    Mesh reversed = low;
    reversed.indices = {4, 7, 5, 7, 4, 6, 0, 3, 1, 3, 0, 2};
    CHECK(low.tangents[0].w == -reversed.tangents[4].w);
    for (const Mesh& mesh : {low, reversed}) {
        const Expected<BakedNormalMap> map = bakeNormalMap(mesh, roof, sized(8, 8, 1.0f));
        REQUIRE(map.has_value());
        checkSound(*map);
        CHECK(map->hits == 64);
        for (const std::uint32_t triangle : map->triangles) CHECK(triangle < 2);
        for (const glm::vec3& n : map->normals) CHECK(glm::distance(n, {0.6f, 0, 0.8f}) < 1e-6f);
    }
}

TEST_CASE("bake: islands are continued by the padding, and no further")
{
    // The island covers the columns 8..11 and the rows 4..11 of 24 x 16, from the top.
    Mesh low = makeQuad();
    for (glm::vec2& uv : low.uvs) uv = {(8 + 4 * uv.x) / 24, (4 + 8 * uv.y) / 16};
    for (const int padding : {0, 1, 3}) {
        CAPTURE(padding);
        BakeOptions options = sized(24, 16, 0.5f);
        options.padding = padding;
        const Expected<BakedNormalMap> map = bakeNormalMap(low, tiltedQuad(), options);
        REQUIRE(map.has_value());
        checkSound(*map);
        CHECK(map->hits == 32);
        CHECK(count(*map, TexelState::padding) == static_cast<std::size_t>((4 + 2 * padding) * (8 + 2 * padding) - 32));
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 24; ++x) {
                const bool isNear = x >= 8 - padding && x < 12 + padding && y >= 4 - padding && y < 12 + padding;
                const glm::vec3 expected = isNear ? glm::vec3(0.6f, 0, 0.8f) : glm::vec3(0, 0, 1);
                CHECK(glm::distance(map->normals[static_cast<std::size_t>(y * 24 + x)], expected) < 1e-6f);
            }
        }
    }
}

TEST_CASE("bake: the padding wraps around the picture")
{
    Mesh low = makeQuad();
    for (glm::vec2& uv : low.uvs) uv = uv / 8.0f;  // one texel, lower left
    BakeOptions options = sized(8, 8, 0.5f);
    options.padding = 1;
    const Expected<BakedNormalMap> map = bakeNormalMap(low, tiltedQuad(), options);
    REQUIRE(map.has_value());
    CHECK(map->states[7 * 8] == TexelState::hit);
    CHECK(map->states[7 * 8 + 7] == TexelState::padding);
    CHECK(map->states[0] == TexelState::padding);
    CHECK(map->states[7] == TexelState::padding);
    CHECK(count(*map, TexelState::padding) == 8);
}

TEST_CASE("bake: triangles, frames and normals without direction give no NaN")
{
    Mesh low = makeQuad();
    low.normals[0] = {0, 0, 0};
    low.normals[1] = -low.normals[2];
    low.tangents[2] = {0, 0, 0, 0};
    low.tangents[3] = {0, 0, -1, 1};
    low.indices.insert(low.indices.end(), {0, 0, 1, 2, 2, 2});
    Mesh high = tiltedQuad();
    high.normals[0] = {0, 0, 0};
    const Expected<BakedNormalMap> map = bakeNormalMap(low, high, sized(32, 32, 0.5f));
    REQUIRE(map.has_value());
    checkSound(*map);
    CHECK(map->hits + map->misses == 32 * 32);

    Mesh flat = makeQuad();
    flat.uvs.assign(4, {0.5f, 0.5f});
    CHECK(bakeNormalMap(flat, high, sized(4, 4))->hits == 0);
    CHECK(bakeNormalMap(Mesh{}, high, sized(4, 4))->hits == 0);
    CHECK(bakeNormalMap(makeQuad(), Mesh{}, sized(4, 4))->misses == 16);
}

TEST_CASE("bake: what cannot be baked is an error of one line")
{
    const Mesh quad = makeQuad();
    const BakeOptions good = sized(4, 4);
    Mesh bad = quad;
    bad.uvs.clear();
    CHECK(errorOf(bad, quad, good) == "mesh 'quad': baking needs uvs; give every vertex one (withSphericalUvs)");
    bad = quad;
    bad.tangents.clear();
    CHECK(errorOf(bad, quad, good) == "mesh 'quad': baking needs tangents; give every vertex one (withTangents)");
    CHECK(errorOf(quad, bad, good).empty());
    bad = quad;
    bad.uvs[2].y = -17;
    CHECK(errorOf(bad, quad, good) == "mesh 'quad': the uv of vertex 2 is beyond +-16; move the islands into 0..1");
    bad = quad;
    bad.indices.pop_back();
    CHECK(errorOf(bad, quad, good).find("5 indices") != std::string::npos);
    CHECK(errorOf(quad, bad, good).find("5 indices") != std::string::npos);

    CHECK(errorOf(quad, quad, sized(0, 4)) == "bake: width is 0; give it a value in 1..16384");
    CHECK(errorOf(quad, quad, sized(4, 16385)) == "bake: height is 16385; give it a value in 1..16384");
    for (const float distance :
         {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const std::string error = errorOf(quad, quad, sized(4, 4, distance));
        CHECK(error.starts_with("bake: distance is "));
        CHECK(error.ends_with("; give a length above 0, in the meshes' units"));
    }
    BakeOptions padded = good;
    padded.padding = -1;
    CHECK(errorOf(quad, quad, padded) == "bake: padding is -1; give it a value in 0..64");
}

TEST_CASE("bake: a map as 8 bits, and as the texels of a texture")
{
    BakedNormalMap map = *bakeNormalMap(makeQuad(), tiltedQuad(), sized(2, 1, 0.5f));
    const std::vector<float> rgba = rgbaOf(map);
    REQUIRE(rgba.size() == 8);
    CHECK(rgba[0] == doctest::Approx(0.8));
    CHECK(rgba[1] == doctest::Approx(0.5));
    CHECK(rgba[2] == doctest::Approx(0.9));
    CHECK(rgba[3] == 1.0f);
    // 0.8, 0.5 and 0.9 times 255: 204, 127.5 up to 128, 229.5 with float rounding to 229 or 230.
    map.normals[1] = {-1, 0, 1};
    map = roundedTo8Bits(map);
    CHECK(map.normals[0].x == static_cast<float>(204.0 / 255 * 2 - 1));
    CHECK(map.normals[1] == glm::vec3(-1, static_cast<float>(128.0 / 255 * 2 - 1), 1));
}

// Tangents: MikkTSpace's reference corner by corner (tests/fixtures/mikktspace), the primitives' own tangents, and unit
// vectors for whatever a mesh may hold.
#include "relief/mesh/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "fixtures/mikktspace/inputs.h"
#include "fixtures/mikktspace/reference.h"

using namespace relief;
using mikktspace_inputs::Input;
using mikktspace_inputs::readReference;
using mikktspace_inputs::Reference;

namespace {

bool isUnitAndPerpendicular(glm::vec4 tangent, glm::vec3 normal)
{
    const glm::vec3 t(tangent);
    return std::fabs(glm::length(t) - 1.0f) < 1e-6f && std::fabs(glm::dot(t, normal)) < 1e-6f;
}

// The corners that differ, of two kinds: those without direction, for which the reference says (1, 0, 0, -1) and we a
// vector perpendicular to the normal; and all others.
struct Differences
{
    int withoutDirection = 0;
    int others = 0;
    bool operator==(const Differences&) const = default;
};

Differences compare(const Input& input)
{
    const Mesh& mesh = input.mesh;
    const Reference reference = readReference(RELIEF_SOURCE_FOLDER "/tests/fixtures/mikktspace", input.mesh.name);
    REQUIRE(reference.hash == mikktspace_inputs::hashOf(mikktspace_inputs::arraysOf(mesh)));
    REQUIRE(reference.corners == mesh.indices.size());
    REQUIRE(reference.stride == input.stride);
    const Expected<std::vector<glm::vec4>> tangents = cornerTangents(mesh);
    REQUIRE(tangents.has_value());
    REQUIRE(tangents->size() == mesh.indices.size());

    Differences differences;
    for (std::size_t i = 0; i < reference.tangents.size(); ++i) {
        const std::size_t corner = i / 3 * reference.stride * 3 + i % 3;
        const glm::vec4 ours = (*tangents)[corner];
        const glm::vec4 theirs = reference.tangents[i];
        float largest = 0;
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::fabs(ours[axis] - theirs[axis]));
        if (largest <= 1e-6f && ours.w == theirs.w) continue;
        const bool isOurs = ours.w == -1.0f && isUnitAndPerpendicular(ours, mesh.normals[mesh.indices[corner]]);
        ++(theirs == glm::vec4(1, 0, 0, -1) && isOurs ? differences.withoutDirection : differences.others);
    }
    return differences;
}

std::uint64_t hashOf(const std::vector<glm::vec4>& tangents)
{
    mikktspace_inputs::Arrays numbers;
    for (const glm::vec4& t : tangents) numbers.positions.insert(numbers.positions.end(), {t.x, t.y, t.z, t.w});
    return mikktspace_inputs::hashOf(numbers);
}

// How many are no unit vector with a sign; NaN counts.
int countBad(const std::vector<glm::vec4>& tangents)
{
    return static_cast<int>(std::count_if(tangents.begin(), tangents.end(), [](glm::vec4 tangent) {
        const float length = glm::length(glm::vec3(tangent));
        return !(std::fabs(length - 1.0f) < 1e-4f) || (tangent.w != 1.0f && tangent.w != -1.0f);
    }));
}

}  // namespace

TEST_CASE("tangents: every corner is within 1e-6 of the reference, but for those that are counted")
{
    // The reasons are in tests/fixtures/mikktspace/README.md.
    const std::map<std::string, Differences> expected = {
        {"soup-0", {43, 0}}, {"soup-1", {2, 6}},  {"soup-2", {11, 0}}, {"soup-3", {22, 0}}, {"soup-4", {37, 0}},
        {"soup-5", {29, 0}}, {"soup-6", {20, 0}}, {"soup-7", {7, 0}},  {"soup-8", {42, 0}}, {"soup-9", {35, 0}}};
    for (const Input& input : mikktspace_inputs::makeInputs()) {
        CAPTURE(input.mesh.name);
        const auto found = expected.find(input.mesh.name);
        const Differences wanted = found == expected.end() ? Differences{} : found->second;
        const Differences differences = compare(input);
        CHECK(differences.withoutDirection == wanted.withoutDirection);
        CHECK(differences.others == wanted.others);
    }
}

TEST_CASE("tangents: the bunny's are within 1e-6 of the reference, every 37th triangle")
{
    const Expected<Input> bunny = mikktspace_inputs::readBunny();
    if (!bunny) {
        MESSAGE("not compared, for want of Debian's package glmark2-data: " << bunny.error().message);
        return;
    }
    CHECK(compare(*bunny) == Differences{});
}

TEST_CASE("tangents: quad, cube and terrain get the tangents that they are made with")
{
    for (const Mesh& mesh : {makeQuad(), makeCube()}) {
        const Expected<Mesh> result = withTangents(mesh);
        REQUIRE(result.has_value());
        CHECK(result->tangents == mesh.tangents);
        CHECK(result->indices == mesh.indices);
        CHECK(result->positions == mesh.positions);
    }
    CHECK(withTangents(makeQuad())->tangents == std::vector<glm::vec4>(4, {1, 0, 0, -1}));
    // A sum over triangles, against the exact derivative of the same hills.
    const Mesh hills = makeTerrain(200, 200);
    const Expected<Mesh> result = withTangents(hills);
    REQUIRE(result->tangents.size() == hills.tangents.size());
    float smallest = 1;
    for (std::size_t i = 0; i < hills.tangents.size(); ++i) {
        CHECK(result->tangents[i].w == hills.tangents[i].w);
        smallest = std::min(smallest, glm::dot(glm::vec3(result->tangents[i]), glm::vec3(hills.tangents[i])));
    }
    CHECK(smallest > 0.999f);
}

TEST_CASE("tangents: where a picture is mirrored the vertices of the seam are split, and each half has its sign")
{
    const Mesh mirrored = mikktspace_inputs::makeMirrored();
    const Expected<Mesh> mesh = withTangents(mirrored);
    REQUIRE(mesh.has_value());
    CHECK(validate(*mesh).has_value());
    CHECK(mesh->positions.size() == mirrored.positions.size() + 13);
    for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
        float x = 0;
        for (std::size_t k = 0; k < 3; ++k) x += mesh->positions[mesh->indices[i + k]].x;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec4 tangent = mesh->tangents[mesh->indices[i + k]];
            CHECK(tangent.w == (x < 0 ? 1.0f : -1.0f));
            CHECK((tangent.x < 0) == (x < 0));
        }
    }
}

TEST_CASE("tangents: opposite directions around a vertex are not added to one another")
{
    // Four triangles around the origin in the plane; the picture turns with them, so that left and right are opposite.
    Mesh fan;
    fan.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    fan.normals.assign(5, {0, 0, -1});
    fan.uvs = {{0, 0}, {0, 1}, {1, 1}, {2, 1}, {3, 1}};
    // Along +u: (-1, 1, 0), (-1, -1, 0) and (1, -1, 0), divided by their lengths. The first and the third are opposite.
    const float h = std::sqrt(0.5f);
    const glm::vec3 expected[] = {{-1, 0, 0}, {-h, -h, 0}, {0, -1, 0}};
    for (const auto& order : {std::array<std::uint32_t, 3>{0, 1, 2}, {1, 0, 2}, {2, 1, 0}}) {
        fan.indices.clear();
        for (const std::uint32_t i : order) fan.indices.insert(fan.indices.end(), {0, i + 2, i + 1});
        const std::vector<glm::vec4> tangents = *cornerTangents(fan);
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(glm::distance(glm::vec3(tangents[3 * i]), expected[order[i]]) < 1e-6f);
    }
}

TEST_CASE("tangents: vertices that are the same are one, whatever their indices")
{
    const Mesh welded = makeTerrain(9, 9);
    Mesh loose;
    for (const std::uint32_t index : welded.indices) {
        loose.indices.push_back(static_cast<std::uint32_t>(loose.positions.size()));
        loose.positions.push_back(welded.positions[index]);
        loose.normals.push_back(welded.normals[index]);
        loose.uvs.push_back(welded.uvs[index]);
    }
    CHECK(*cornerTangents(loose) == *cornerTangents(welded));
}

TEST_CASE("tangents: neither the mesh's size nor the picture's matters")
{
    const Mesh hills = makeTerrain(9, 9);
    const std::vector<glm::vec4> expected = *cornerTangents(hills);
    for (const auto& [positionScale, uvScale] :
         {std::pair(0x1p-100f, 1.0f), {0x1p120f, 1.0f}, {1.0f, 0x1p-100f}, {1.0f, 0x1p120f}, {0x1p-90f, 0x1p110f}}) {
        Mesh mesh = hills;
        for (glm::vec3& position : mesh.positions) position *= positionScale;
        for (glm::vec2& uv : mesh.uvs) uv *= uvScale;
        CHECK(*cornerTangents(mesh) == expected);
    }
}

TEST_CASE("tangents: S-654 whatever has no direction gets a unit vector perpendicular to the normal")
{
    Mesh mesh = makeCube();
    for (glm::vec2& uv : mesh.uvs) uv = {0.25f, 0.75f};
    const Expected<Mesh> flat = withTangents(mesh);
    REQUIRE(flat.has_value());
    for (std::size_t i = 0; i < flat->positions.size(); ++i) {
        CHECK(isUnitAndPerpendicular(flat->tangents[i], flat->normals[i]));
    }
    mesh = makeQuad();
    mesh.indices.clear();
    CHECK(withTangents(mesh)->tangents == std::vector<glm::vec4>(4, {1, 0, 0, -1}));
    mesh.normals.assign(4, {0, 0, 0});  // no normal either
    CHECK(countBad(withTangents(mesh)->tangents) == 0);
    mesh = makeQuad();
    for (const float sign : {-1.0f, 1.0f}) {
        for (glm::vec3& normal : mesh.normals) normal = {1, 0, 0};  // along u: nothing is left of it but its sign
        const std::vector<glm::vec4> tangents = *cornerTangents(mesh);
        for (const glm::vec4& tangent : tangents) {
            CHECK(isUnitAndPerpendicular(tangent, {1, 0, 0}));
            CHECK(tangent.w == sign);
        }
        for (glm::vec2& uv : mesh.uvs) uv.x = -uv.x;
    }
}

TEST_CASE("tangents: unit vectors and signs for numbers of all sizes")
{
    constexpr float kLargest = std::numeric_limits<float>::max();
    const std::vector<float> sizes = {0.0f,  -0.0f, 1e-45f, -1e-38f,  1e-20f,   0.5f,
                                      -1.0f, 3e4f,  1e20f,  kLargest, -kLargest};
    mikktspace_inputs::Numbers numbers(3);
    const auto any = [&] { return sizes[numbers.below(static_cast<std::uint32_t>(sizes.size()))]; };
    Mesh mesh;
    for (int i = 0; i < 600; ++i) {
        mesh.positions.push_back(glm::vec3{any(), any(), any()});
        mesh.normals.push_back(glm::vec3{any(), any(), any()});
        mesh.uvs.push_back(glm::vec2{any(), any()});
    }
    for (int i = 0; i < 3000; ++i) mesh.indices.push_back(numbers.below(600));
    CHECK(countBad(*cornerTangents(mesh)) == 0);
    const Expected<Mesh> result = withTangents(mesh);
    REQUIRE(result.has_value());
    CHECK(validate(*result).has_value());
    CHECK(countBad(result->tangents) == 0);
}

TEST_CASE("tangents: a vector of any length has a direction, unless all of it is zero or as good as zero")
{
    for (const float size : {1e-37f, 1e-25f, 1e-22f, 1e-16f, 1.0f, 1e16f, 1e20f, 1e38f}) {
        CAPTURE(size);
        const glm::vec3 unit = normalizedOrZero(glm::vec3(0.3f, -0.4f, 1.2f) * size);
        CHECK(glm::length(unit - glm::vec3(0.3f, -0.4f, 1.2f) / 1.3f) < 1e-6f);
    }
    CHECK(normalizedOrZero({0.0f, -0.0f, 1e-40f}) == glm::vec3(0.0f, -0.0f, 1e-40f));
}

TEST_CASE("tangents: each corner of the mesh keeps its position, normal, uv and tangent")
{
    const Mesh mesh = mikktspace_inputs::makeSoup(4);
    const std::vector<glm::vec4> tangents = *cornerTangents(mesh);
    const Expected<Mesh> result = withTangents(mesh);
    REQUIRE(result.has_value());
    int different = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t before = mesh.indices[i];
        const std::uint32_t after = result->indices[i];
        different += result->positions[after] != mesh.positions[before] ||
                     result->normals[after] != mesh.normals[before] || result->uvs[after] != mesh.uvs[before] ||
                     result->tangents[after] != tangents[i];
    }
    CHECK(different == 0);
    CHECK(result->positions.size() > mesh.positions.size());
}

TEST_CASE("tangents: a mesh without uvs or with wrong numbers is an error, one without triangles is not")
{
    Mesh mesh = makeQuad();
    mesh.uvs.clear();
    CHECK(withTangents(mesh).error().message.find("mesh 'quad': tangents need uvs") != std::string::npos);
    mesh = makeQuad();
    mesh.normals.clear();
    CHECK(withTangents(mesh).error().message.find("0 normals for 4 positions") != std::string::npos);
    mesh = makeQuad();
    mesh.uvs[2].y = std::numeric_limits<float>::quiet_NaN();
    CHECK(withTangents(mesh).error().message.find("the uv of vertex 2 is not finite") != std::string::npos);
    CHECK_FALSE(cornerTangents(mesh).has_value());
    CHECK(withTangents(Mesh{})->tangents.empty());
    CHECK(cornerTangents(Mesh{})->empty());
}

TEST_CASE("tangents: the results have the bits that they have in every other build")
{
    std::uint64_t hash = 0;
    for (const Input& input : mikktspace_inputs::makeInputs()) hash = hash * 31 + hashOf(*cornerTangents(input.mesh));
    CHECK(hash == 0x4ffc8cf43812ebfbu);
}

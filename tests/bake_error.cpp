// What a shader makes of baked maps: nothing lost where it decodes as was baked, and how much is where it does not.
#include "relief/mesh/bake_error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "relief/lanes/math.h"
#include "relief/mesh/displace.h"
#include "relief/mesh/primitives.h"
#include "relief/mesh/tangents.h"

using namespace relief;

namespace {

// Bumps that meet at u = 0 and 1, and vanish at the poles.
float bumps(float u, float v)
{
    constexpr float kTwoPi = 6.283185307f;
    return relief::sin(8 * kTwoPi * u) * relief::sin(6 * kTwoPi * v) * 4 * v * (1 - v);
}

// Tangents as many exporters make them: each triangle's own, added up by vertex index, without weights; then made
// perpendicular to the normal (Lengyel, "Foundations of Game Engine Development", volume 2, 7.5, without its weights).
Mesh withNaiveTangents(Mesh mesh)
{
    std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* const of = &mesh.indices[i];
        const glm::vec3 ab = mesh.positions[of[1]] - mesh.positions[of[0]];
        const glm::vec3 ac = mesh.positions[of[2]] - mesh.positions[of[0]];
        const glm::vec2 uvAb = mesh.uvs[of[1]] - mesh.uvs[of[0]], uvAc = mesh.uvs[of[2]] - mesh.uvs[of[0]];
        const float sign = uvAb.x * uvAc.y - uvAb.y * uvAc.x < 0 ? -1.0f : 1.0f;
        const glm::vec3 alongU = (ab * uvAc.y - ac * uvAb.y) * sign;
        for (int k = 0; k < 3; ++k) sums[of[k]] += glm::normalize(alongU);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const glm::vec3 n = mesh.normals[i];
        mesh.tangents[i] = glm::vec4(glm::normalize(sums[i] - n * glm::dot(n, sums[i])), mesh.tangents[i].w);
    }
    return mesh;
}

struct Case
{
    Mesh low = *withTangents(makeSphere(12, 6));
    BakedNormalMap map;

    explicit Case(BinormalAt binormal = BinormalAt::vertex, int size = 64)
    {
        const Mesh high = *displaced(makeSphere(256, 128), bumps, 0.02f);
        BakeOptions options;
        options.width = options.height = size;
        options.binormal = binormal;
        map = *bakeNormalMap(low, high, options);
    }
};

AngleError errorOf(const BakedNormalMap& map, const Mesh& mesh, DecodeOptions options = {})
{
    const Expected<AngleError> error = bakeError(map, mesh, options);
    REQUIRE(error.has_value());
    CHECK(error->texels == map.hits);
    CHECK(error->max >= error->mean);
    return *error;
}

constexpr DecodeOptions kPerFragment = {BinormalAt::fragment, false};
constexpr DecodeOptions kOrthonormal = {BinormalAt::vertex, true};

}  // namespace

TEST_CASE("bake_error: angles are in degrees, and small and large ones are right")
{
    BakeOptions options;
    options.width = options.height = 4;
    BakedNormalMap map = *bakeNormalMap(makeQuad(), makeQuad(), options);
    const auto expect = [&](glm::vec3 normal, double degrees) {
        map.normals.assign(16, normal);
        const AngleError error = errorOf(map, makeQuad());
        CHECK(error.mean == doctest::Approx(degrees).epsilon(1e-6));
        CHECK(error.max == doctest::Approx(degrees).epsilon(1e-6));
    };
    expect({0, 0, 1}, 0);
    expect({1, 0, 0}, 90);
    expect({0, 1, 1}, 45);
    expect({0, 0, -1}, 180);
    expect({1e-6f, 0, 1}, 5.7295780e-5);
    map.normals[3] = {0, 0, 1};
    CHECK(errorOf(map, makeQuad()).mean == doctest::Approx(5.7295780e-5 * 15 / 16).epsilon(1e-6));
}

TEST_CASE("bake_error: synched, nothing is lost but what floats round off")
{
    const Mesh smooth = *withTangents(makeSphere(24, 12));
    CHECK(errorOf(*bakeNormalMap(smooth, smooth, {}), smooth).max < 2e-5);
    CHECK(errorOf(Case(BinormalAt::vertex).map, Case().low).max < 2e-5);
    const Case perFragment(BinormalAt::fragment);
    CHECK(errorOf(perFragment.map, perFragment.low, kPerFragment).max < 2e-5);
    CHECK(errorOf(perFragment.map, perFragment.low).max > 0.1);
}

TEST_CASE("bake_error: other tangents, other binormals and other lengths all show")
{
    const Case bumpy(BinormalAt::vertex, 256);
    CHECK(bumpy.map.misses == 0);
    const BakedNormalMap rounded = roundedTo8Bits(bumpy.map);
    const Mesh naive = withNaiveTangents(bumpy.low);
    const Mesh analytic = makeSphere(12, 6);
    const auto print = [&](const std::string& what, const Mesh& mesh, DecodeOptions options) {
        const AngleError exact = errorOf(bumpy.map, mesh, options), coarse = errorOf(rounded, mesh, options);
        MESSAGE(what << ": mean " << exact.mean << " max " << exact.max << " degrees; of 8 bits: mean " << coarse.mean
                     << " max " << coarse.max);
        return exact;
    };
    const AngleError synched = print("synched", bumpy.low, {});
    const AngleError fragment = print("binormal per fragment", bumpy.low, kPerFragment);
    const AngleError cleaned = print("orthonormalised", bumpy.low, kOrthonormal);
    const AngleError unsynched = print("naive tangents", naive, {});
    const AngleError exactTangents = print("analytic tangents", analytic, {});
    CHECK(synched.mean < 1e-5);
    CHECK(errorOf(rounded, bumpy.low).mean < 0.3);
    CHECK(fragment.mean > 0.01);
    CHECK(cleaned.mean > 0.1);
    CHECK(unsynched.mean > 0.1);
    CHECK(exactTangents.mean > 0.1);
}

TEST_CASE("bake_error: a picture that repeats within one triangle is measured once")
{
    Mesh quad = makeQuad();
    for (glm::vec2& uv : quad.uvs) uv = uv * 3.0f;
    BakeOptions options;
    options.width = options.height = 8;
    const BakedNormalMap map = *bakeNormalMap(quad, makeQuad(), options);
    CHECK(map.hits == 64);
    CHECK(errorOf(map, quad).max == 0.0);
}

TEST_CASE("bake_error: a mesh with its vertices in another order is the same mesh, one with other uvs is not")
{
    const Case bumpy;
    Mesh loose;
    for (const std::uint32_t index : bumpy.low.indices) {
        loose.indices.push_back(static_cast<std::uint32_t>(loose.positions.size()));
        loose.positions.push_back(bumpy.low.positions[index]);
        loose.normals.push_back(bumpy.low.normals[index]);
        loose.uvs.push_back(bumpy.low.uvs[index]);
        loose.tangents.push_back(bumpy.low.tangents[index]);
    }
    CHECK(errorOf(bumpy.map, loose).mean == errorOf(bumpy.map, bumpy.low).mean);

    const auto messageOf = [&](const Mesh& mesh) {
        const Expected<AngleError> error = bakeError(bumpy.map, mesh, {});
        return error ? std::string() : error.error().message;
    };
    Mesh other = bumpy.low;
    for (glm::vec2& uv : other.uvs) uv = uv * 0.5f;
    CHECK(messageOf(other).starts_with("mesh 'sphere': covers "));
    other.uvs[0].x = 1e30f;
    CHECK(messageOf(other).starts_with("mesh 'sphere': no map was baked for it"));
    other.uvs.clear();
    CHECK(messageOf(other).starts_with("mesh 'sphere': no map was baked for it"));
    other.indices.pop_back();
    CHECK(messageOf(other).find("no whole number of triangles") != std::string::npos);
    CHECK(bakeError(BakedNormalMap{}, Mesh{}, {})->texels == 0);
}

// The tangent frame, ordinary and extreme (stability cases S-620, S-651 to S-653, S-659, S-660).
#include "relief/shading/tangent_space.h"

#include <array>
#include <bit>
#include <limits>

#include "relief/mesh/primitives.h"
#include "relief/shading/object_transform.h"
#include "shading_fixture.h"

using namespace fixture;

namespace {

float3 of(const glm::vec3& v)
{
    return broadcast(v);
}

double dotOf(const Vector& a, const Vector& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

}  // namespace

TEST_CASE("tangent space: S-620 on all faces of the cube x leans to the right and y up, mirrored uv or not")
{
    const Mesh plain = makeCube(), mirrored = withMirroredUv(makeCube());
    for (const Mesh* mesh : {&plain, &mirrored}) {
        for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
            // The directions of +u and +v on the triangle, from its corners alone.
            const auto p = [&](std::size_t k) { return mesh->positions[mesh->indices[i + k]]; };
            const auto uv = [&](std::size_t k) { return mesh->uvs[mesh->indices[i + k]]; };
            const glm::vec3 e1 = p(1) - p(0), e2 = p(2) - p(0);
            const glm::vec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
            const float determinant = d1.x * d2.y - d1.y * d2.x;
            const glm::vec3 alongU = (e1 * d2.y - e2 * d1.y) / determinant;
            const glm::vec3 alongV = (e2 * d1.x - e1 * d2.x) / determinant;
            const std::uint32_t vertex = mesh->indices[i];
            const glm::vec4 t = mesh->tangents[vertex];
            const float3 normal = of(mesh->normals[vertex]), tangent = of(glm::vec3(t));
            const float3 binormal = CreateBinormal(normal, tangent, t.w, 1.0f);
            measured("degrees off", angle(lane(tangent), lane(of(alongU))), 1e-4);
            measured("degrees off", angle(lane(binormal), lane(of(alongV))), 1e-4);
            CHECK(sameBits(TangentSpaceToWorld({0, 0, 1}, tangent, binormal, normal), normal));
            const Vector leaning = lane(TangentSpaceToWorld({0.6f, 0.0f, 0.8f}, tangent, binormal, normal));
            CHECK(dotOf(leaning, lane(tangent)) == doctest::Approx(0.6).epsilon(1e-6));
            const Vector rising = lane(TangentSpaceToWorld({0.0f, 0.6f, 0.8f}, tangent, binormal, normal));
            CHECK(dotOf(rising, lane(binormal)) == doctest::Approx(0.6).epsilon(1e-6));
        }
    }
}

TEST_CASE("tangent space: a mirrored object keeps its binormal along +v in the world")
{
    // Mirrored by its scale: positions, normals and tangents move, and +v must move with the positions.
    for (const glm::vec3& scale : {glm::vec3(-1, 1, 1), glm::vec3(1, -1, 1), glm::vec3(-1, -1, -1),
                                   glm::vec3(-2, -3, 1), glm::vec3(-0.5f, 2, 3)}) {
        const glm::mat4 matrix = {{scale.x, 0, 0, 0}, {0, scale.y, 0, 0}, {0, 0, scale.z, 0}, {0, 0, 0, 1}};
        const ObjectTransform object(glm::mat4(1.0f), matrix);
        const Mesh quad = makeQuad();
        const float3 normal = UnityObjectToWorldNormal(object, of(quad.normals[0]));
        const float3 tangent = UnityObjectToWorldDir(object, of(glm::vec3(quad.tangents[0])));
        const float3 binormal =
            CreateBinormal(normal, tangent, quad.tangents[0].w, object.unity_WorldTransformParams.w);
        CHECK(angle(lane(binormal), lane(UnityObjectToWorldDir(object, {0, 1, 0}))) <= 1e-4);
    }
}

TEST_CASE("tangent space: S-653 only the sign of tangent.w counts, and 0 counts as +1")
{
    const float3 normal = {0, 0, 1}, tangent = {1, 0, 0};
    const float3 plus = CreateBinormal(normal, tangent, 1.0f, 1.0f),
                 minus = CreateBinormal(normal, tangent, -1.0f, 1.0f);
    CHECK(sameBits(CreateBinormal(normal, tangent, 0.5f, 1.0f), plus));
    CHECK(sameBits(CreateBinormal(normal, tangent, 0.0f, 1.0f), plus));
    CHECK(sameBits(CreateBinormal(normal, tangent, std::numeric_limits<float>::quiet_NaN(), 1.0f), plus));
    CHECK(sameBits(CreateBinormal(normal, tangent, -0.01f, 1.0f), minus));
    CHECK(sameBits(CreateBinormal(normal, tangent, -1.0f, -1.0f), plus));
}

TEST_CASE("tangent space: S-651 S-652 a tangent of no use is replaced by one that is perpendicular")
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::array<glm::vec3, 7> normals = {{{0, 0, 1},
                                               {0, 0, -1},
                                               {1, 0, 0},
                                               {0, -1, 0},
                                               {0.6f, 0.0f, -0.8f},
                                               {0.48f, 0.64f, 0.6f},
                                               {0.0f, 0.0001f, -0.99999999f}}};
    for (const glm::vec3& n : normals) {
        const std::array<glm::vec3, 7> tangents = {{n,
                                                    -n,
                                                    glm::vec3(0.0f),
                                                    {nan, 0, 0},
                                                    {1e-30f, 0, 0},
                                                    n + glm::vec3(1e-4f, 0, 0),
                                                    n + glm::vec3(0, 1e-6f, 0)}};
        for (const glm::vec3& t : tangents) {
            const Vector tangent = lane(SafeTangent(of(n), of(t)));
            REQUIRE(isFinite(tangent));
            measured("length off 1", std::abs(length(tangent) - 1.0), 8e-7);
            measured("cosine of tangent and normal", std::abs(dotOf(tangent, lane(of(n)))), 1e-6);
        }
    }
    CHECK(angle(lane(SafeTangent({0, 0, 1}, {0.6f, 0.0f, 0.8f})), {1, 0, 0}) <= 1e-5);
}

TEST_CASE("tangent space: S-660 nothing is made unit length before the sum")
{
    // Interpolated vectors are shorter than 1; MikkTSpace sums them as they are.
    const float3 normal = {0.0f, 0.1f, 0.8f}, tangent = {0.7f, 0.0f, 0.1f};
    const float3 binormal = CreateBinormal(normal, tangent, -1.0f, 1.0f);
    const Vector n = lane(normal), t = lane(tangent);
    const Vector b = {-(n.y * t.z - n.z * t.y), -(n.z * t.x - n.x * t.z), -(n.x * t.y - n.y * t.x)};
    const Vector expected = {0.3 * t.x + 0.4 * b.x + 0.87 * n.x, 0.3 * t.y + 0.4 * b.y + 0.87 * n.y,
                             0.3 * t.z + 0.4 * b.z + 0.87 * n.z};
    measured("degrees off", angle(lane(TangentSpaceToWorld({0.3f, 0.4f, 0.87f}, tangent, binormal, normal)), expected),
             1e-5);
}

TEST_CASE("tangent space: per vertex and per fragment differ as T-07 says, and not at all for a twist")
{
    // An edge bent about B by alpha: two frames, half way between them. The detail leans by phi towards B.
    const double degree = 3.14159265358979 / 180.0;
    for (const auto& [alpha, phi, difference] :
         {std::array{30.0, 30.0, 1.72005}, std::array{60.0, 45.0, 8.21321}, std::array{90.0, 10.0, 6.89487}}) {
        const auto c = static_cast<float>(std::cos(alpha * degree / 2)),
                   s = static_cast<float>(std::sin(alpha * degree / 2));
        const float3 n0 = {s, 0, c}, n1 = {-s, 0, c}, t0 = {c, 0, -s}, t1 = {c, 0, s};
        const float3 normal = (n0 + n1) * 0.5f, tangent = (t0 + t1) * 0.5f;
        const float3 perVertex = (CreateBinormal(n0, t0, 1.0f, 1.0f) + CreateBinormal(n1, t1, 1.0f, 1.0f)) * 0.5f;
        const float3 perFragment = CreateBinormal(normal, tangent, 1.0f, 1.0f);
        const float3 detail = {0.0f, static_cast<float>(std::sin(phi * degree)),
                               static_cast<float>(std::cos(phi * degree))};
        const Vector a = lane(TangentSpaceToWorld(detail, tangent, perVertex, normal));
        const Vector b = lane(TangentSpaceToWorld(detail, tangent, perFragment, normal));
        CHECK(angle(a, b) == doctest::Approx(difference).epsilon(1e-4));
    }
}

TEST_CASE("tangent space: S-661 where an edge bends by almost half a turn, the frame stays finite")
{
    const double degree = 3.14159265358979 / 180.0;
    for (const double alpha : {90.0, 170.0, 179.9, 180.0}) {
        const auto c = static_cast<float>(std::cos(alpha * degree / 2)),
                   s = static_cast<float>(std::sin(alpha * degree / 2));
        const float3 normal = {0, 0, c}, tangent = {c, 0, 0};  // half way between (s, 0, c) and (-s, 0, c)
        for (const float sign : {-1.0f, 1.0f}) {
            const float3 binormal = CreateBinormal(normal, tangent, sign, 1.0f);
            const Vector v = lane(TangentSpaceToWorld({s * 0.5f, 0.3f, 0.8f}, tangent, binormal, normal));
            REQUIRE(isFinite(v));
            measured("length off 1", std::abs(length(v) - 1.0), 1e-6);
        }
    }
    // Opposite normals and tangents cancel altogether: no direction, and no NaN.
    const float3 nothing = {0, 0, 0};
    CHECK(length(lane(TangentSpaceToWorld({0.1f, 0.2f, 0.9f}, nothing, nothing, nothing))) == 0.0);
}

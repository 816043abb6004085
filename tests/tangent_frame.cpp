// The frame that normal maps are decoded in: against the shader's own functions, and its inverse.
#include "relief/mesh/tangent_frame.h"

#include <array>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "relief/mesh/primitives.h"
#include "relief/mesh/tangents.h"
#include "relief/shading/tangent_space.h"

using namespace relief;

namespace {

// What a shader makes of v: binormals per vertex, everything interpolated in floats.
glm::vec3 shaded(const Mesh& mesh, std::size_t triangle, const std::array<double, 3>& weights, glm::vec3 v,
                 BinormalAt binormalAt)
{
    float3 normal(0.0f), tangent(0.0f), binormal(0.0f);
    Float sign = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = mesh.indices[3 * triangle + k];
        const Float weight = static_cast<float>(weights[k]);
        const float3 n = normalize(float3(mesh.normals[i].x, mesh.normals[i].y, mesh.normals[i].z));
        const float3 t = normalize(float3(mesh.tangents[i].x, mesh.tangents[i].y, mesh.tangents[i].z));
        normal = normal + n * weight;
        tangent = tangent + t * weight;
        binormal = binormal + CreateBinormal(n, t, mesh.tangents[i].w, 1.0f) * weight;
        sign = sign + Float(mesh.tangents[i].w) * weight;
    }
    if (binormalAt == BinormalAt::fragment) binormal = CreateBinormal(normal, tangent, sign, 1.0f);
    return firstLane(TangentSpaceToWorld(float3(v.x, v.y, v.z), tangent, binormal, normal));
}

}  // namespace

TEST_CASE("tangent_frame: decodes as the shader does")
{
    const Mesh mesh = *withTangents(makeSphere(7, 4));
    const std::array<double, 3> weights = {0.5, 0.2, 0.3};
    const glm::vec3 v = {0.48f, -0.6f, 0.64f};
    for (std::size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
        for (const BinormalAt at : {BinormalAt::vertex, BinormalAt::fragment}) {
            const TangentFrame frame = frameAt(frameCorners(mesh, triangle), weights, at);
            CHECK(glm::distance(glm::vec3(decoded(glm::dvec3(v), frame)), shaded(mesh, triangle, weights, v, at)) <
                  1e-6f);
        }
    }
}

TEST_CASE("tangent_frame: binormals of vertices and of fragments agree in the corners and nowhere else")
{
    const std::array<FrameCorner, 3> corners = frameCorners(*withTangents(makeSphere(7, 4)), 20);
    const auto difference = [&](const std::array<double, 3>& weights) {
        return glm::distance(frameAt(corners, weights, BinormalAt::vertex).binormal,
                             frameAt(corners, weights, BinormalAt::fragment).binormal);
    };
    CHECK(difference({1, 0, 0}) == 0.0);
    CHECK(difference({0, 0, 1}) == 0.0);
    CHECK(difference({0.25, 0.25, 0.5}) > 0.01);
}

TEST_CASE("tangent_frame: encoded is the inverse of decoded, in frames of either hand that are skewed and scaled")
{
    TangentFrame frame{{0.9, 0.2, -0.1}, {0.3, 0.7, 0.1}, {0.1, 0.2, 0.4}};
    for (const double hand : {1.0, -1.0}) {
        frame.binormal *= hand;
        for (const glm::dvec3 direction : {glm::dvec3(0, 0, 1), {0.6, 0, -0.8}, {-0.36, 0.48, 0.8}}) {
            const glm::dvec3 v = encoded(direction, frame);
            CHECK(std::fabs(glm::dot(v, v) - 1) < 1e-12);
            CHECK(glm::distance(decoded(v, frame), direction) < 1e-12);
        }
    }
    // By hand: z halved, so that the vector needs twice as much of it.
    const TangentFrame flatter{{1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}};
    CHECK(glm::distance(encoded({1, 0, 1}, flatter), glm::dvec3(1, 0, 2) / std::sqrt(5.0)) < 1e-15);
}

TEST_CASE("tangent_frame: frames without volume, and directions without length, give the flat vector")
{
    const glm::dvec3 up(0, 0, 1);
    CHECK(encoded(up, TangentFrame{}) == up);
    CHECK(encoded(up, TangentFrame{{1, 0, 0}, {1, 0, 0}, {0, 0, 1}}) == up);
    CHECK(encoded(up, TangentFrame{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}) == up);
    CHECK(encoded({0, 1, 0}, TangentFrame{{1, 0, 0}, {1, 1e-12, 0}, {0, 0, 1}}) == up);  // flat but for rounding
    CHECK(encoded({0, 1, 0}, TangentFrame{{1e-9, 0, 0}, {0, 1e-9, 0}, {0, 0, 1}}) == glm::dvec3(0, 1, 0));  // small
    CHECK(encoded(glm::dvec3(0), TangentFrame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) == up);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(encoded(up, TangentFrame{{nan, 0, 0}, {0, 1, 0}, {0, 0, 1}}) == up);
    CHECK(decoded(up, TangentFrame{}) == glm::dvec3(0));
    CHECK(decoded({1, 0, 0}, TangentFrame{{0, 0, 0}, {0, 0, 0}, {0, 2, 0}}) == glm::dvec3(0, 1, 0));
}

TEST_CASE("tangent_frame: orthonormal keeps the normal's direction and the binormal's side")
{
    for (const double hand : {1.0, -1.0}) {
        const TangentFrame frame = orthonormal({{0.9, 0.2, -0.1}, glm::dvec3(0.3, 0.7, 0.1) * hand, {0, 0, 0.4}});
        CHECK(frame.normal == glm::dvec3(0, 0, 1));
        CHECK(std::fabs(glm::dot(frame.tangent, frame.normal)) < 1e-15);
        CHECK(frame.tangent.x > 0.9);
        CHECK(frame.binormal.y * hand > 0.9);
        CHECK(std::fabs(glm::dot(frame.binormal, frame.tangent)) < 1e-15);
    }
}

// What makes a mesh safe to draw, and normals for meshes that come without.
#include "relief/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <glm/geometric.hpp>

#include "relief/lanes/environment.h"

namespace relief {
namespace {

Expected<void> checkLength(const Mesh& mesh, const char* what, std::size_t length, bool optional)
{
    const std::size_t expected = mesh.positions.size();
    if (length == expected || (optional && length == 0)) return {};
    return fail("mesh '" + mesh.name + "': " + std::to_string(length) + " " + what + " for " +
                std::to_string(expected) + " positions; give every vertex one" + (optional ? " or none at all" : ""));
}

template <class Vector>
Expected<void> checkFinite(const Mesh& mesh, const char* what, std::span<const Vector> vectors)
{
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (int axis = 0; axis < Vector::length(); ++axis) {
            if (std::isfinite(vectors[i][axis])) continue;
            return fail("mesh '" + mesh.name + "': the " + what + " of vertex " + std::to_string(i) +
                        " is not finite; repair or rescale the mesh");
        }
    }
    return {};
}

Expected<void> checkStream(const Mesh& mesh, const VertexStream& stream)
{
    const std::string name = "mesh '" + mesh.name + "': the stream " + stream.semantic + std::to_string(stream.index);
    if (stream.components < 1 || stream.components > 4) {
        return fail(name + " has " + std::to_string(stream.components) + " components; give it 1 to 4");
    }
    const std::size_t numbers = stream.floats.size() + stream.integers.size();
    if (!stream.floats.empty() && !stream.integers.empty()) {
        return fail(name + " holds floats and integers; leave one of the two out");
    }
    if (!stream.perInstance && numbers != mesh.positions.size() * static_cast<std::size_t>(stream.components)) {
        return fail(name + " holds " + std::to_string(numbers) + " numbers for " +
                    std::to_string(mesh.positions.size()) + " positions; give every vertex " +
                    std::to_string(stream.components));
    }
    for (const float number : stream.floats) {
        if (!std::isfinite(number))
            return fail(name + " holds a number that is not finite; repair or rescale the mesh");
    }
    return {};
}

Expected<void> checkIndices(const Mesh& mesh, int indicesPerPrimitive)
{
    const auto perPrimitive = static_cast<std::size_t>(indicesPerPrimitive);
    const std::string primitive = indicesPerPrimitive == 2 ? "line" : "triangle";
    if (mesh.indices.size() % perPrimitive != 0) {
        return fail("mesh '" + mesh.name + "': " + std::to_string(mesh.indices.size()) +
                    " indices are no whole number of " + primitive + "s; give " +
                    (indicesPerPrimitive == 2 ? "two" : "three") + " per " + primitive);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        if (mesh.indices[i] < mesh.positions.size()) continue;
        return fail("mesh '" + mesh.name + "': " + primitive + " " + std::to_string(i / perPrimitive) +
                    " uses vertex " + std::to_string(mesh.indices[i]) + " of " + std::to_string(mesh.positions.size()) +
                    "; vertices are counted from 0");
    }
    return {};
}

}  // namespace

std::vector<StreamView> streamsOf(const Mesh& mesh)
{
    std::vector<StreamView> streams;
    const auto add = [&streams]<class Vector>(const char* semantic, const std::vector<Vector>& data) {
        if (data.empty()) return;
        streams.push_back({semantic, 0, Vector::length(), false, false,
                           reinterpret_cast<const std::uint32_t*>(data.data()), data.size()});
    };
    add("POSITION", mesh.positions);
    add("NORMAL", mesh.normals);
    add("TEXCOORD", mesh.uvs);
    add("TANGENT", mesh.tangents);
    add("COLOR", mesh.colors);
    for (const VertexStream& stream : mesh.streams) {
        const bool isInteger = !stream.integers.empty();
        const void* data = isInteger ? static_cast<const void*>(stream.integers.data()) : stream.floats.data();
        const std::size_t numbers = isInteger ? stream.integers.size() : stream.floats.size();
        const int components = std::clamp(stream.components, 1, 4);
        streams.push_back({stream.semantic.c_str(), stream.index, components, isInteger, stream.perInstance,
                           static_cast<const std::uint32_t*>(data), numbers / static_cast<std::size_t>(components)});
    }
    return streams;
}

Expected<void> validate(const Mesh& mesh, int indicesPerPrimitive)
{
    for (const VertexStream& stream : mesh.streams) {
        if (Expected<void> checked = checkStream(mesh, stream); !checked) return checked;
    }
    return checkLength(mesh, "normals", mesh.normals.size(), false)
        .and_then([&] { return checkLength(mesh, "uvs", mesh.uvs.size(), true); })
        .and_then([&] { return checkLength(mesh, "tangents", mesh.tangents.size(), true); })
        .and_then([&] { return checkLength(mesh, "colours", mesh.colors.size(), true); })
        .and_then([&] { return checkIndices(mesh, indicesPerPrimitive); })
        .and_then([&] { return checkFinite<glm::vec3>(mesh, "position", mesh.positions); })
        .and_then([&] { return checkFinite<glm::vec3>(mesh, "normal", mesh.normals); })
        .and_then([&] { return checkFinite<glm::vec2>(mesh, "uv", mesh.uvs); })
        .and_then([&] { return checkFinite<glm::vec4>(mesh, "tangent", mesh.tangents); })
        .and_then([&] { return checkFinite<glm::vec4>(mesh, "colour", mesh.colors); });
}

void computeNormals(Mesh& mesh)
{
    const DefaultFloatingPoint environment;
    // In double, no finite float position is so large or so small that a cross product or its square leaves the range.
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t corners[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        const glm::dvec3 a = mesh.positions[corners[0]];
        const glm::dvec3 b = mesh.positions[corners[1]];
        const glm::dvec3 c = mesh.positions[corners[2]];
        const glm::dvec3 twiceArea = glm::cross(b - a, c - a);  // its length is twice the triangle's area
        for (const std::uint32_t corner : corners) sums[corner] += twiceArea;
    }
    mesh.normals.resize(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double length = std::sqrt(glm::dot(sums[i], sums[i]));
        mesh.normals[i] = length > 0 ? glm::vec3(sums[i] / length) : glm::vec3(0, 1, 0);
    }
}

Mesh withMirroredUv(const Mesh& mesh)
{
    const DefaultFloatingPoint environment;
    Mesh mirrored = mesh;
    for (glm::vec2& uv : mirrored.uvs) uv.x = 1.0f - uv.x;
    for (glm::vec4& tangent : mirrored.tangents) tangent = -tangent;
    return mirrored;
}

}  // namespace relief
